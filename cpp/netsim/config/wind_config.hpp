// The wind: settings `*.wind.…` of an .ini file. It acts on vehicles with inertia. Each field has a row below the struct.
#pragma once

#include "netsim/config/field.hpp"

namespace netsim {

struct WindConfig {
    double speed_mps = 0;
    double heading_rad = 0;
    double gusts_mps = 0;
    double gust_time_s = 10;

    static const Schema schema;

    // Throws ConfigError for the first field out of its range: "wind.speed_mps = -1 mps: expected …".
    void validate() const { check_fields(*this); }
};

inline constexpr Field wind_fields[] = {
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

inline constexpr Schema WindConfig::schema{"wind", "wind", false, wind_fields};

}  // namespace netsim
