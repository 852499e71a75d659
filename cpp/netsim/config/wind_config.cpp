#include "netsim/config/wind_config.hpp"

namespace netsim {
namespace {

constexpr Field fields[] = {
    {NETSIM_FIELD(WindConfig, speed_mps), "speed", quantity("mps").at_least(0).at_most(100),
     "Speed of the wind. It acts on vehicles with inertia, QuadcopterMobility and ArdupilotMobility "
     "(docs/how-to/fly-with-inertia.md)"},
    {NETSIM_FIELD(WindConfig, heading_rad), "heading", angle(),
     "Direction in which the air moves, from the x axis to the y axis"},
    {NETSIM_FIELD(WindConfig, gusts_mps), "gusts", quantity("mps").at_least(0).at_most(100),
     "Standard deviation of the gusts on each axis. Each vehicle has gusts of its own"},
    {NETSIM_FIELD(WindConfig, gust_time_s), "gustTime", quantity("s").above(0),
     "Time in which gusts change: after it, their correlation is 1/e"},
};

}  // namespace

const Schema WindConfig::schema{"wind", "wind", false, fields};

}  // namespace netsim
