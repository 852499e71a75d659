#include "netsim/config/mobility_config.hpp"

namespace netsim {
namespace {

// The second name is for vehicles with an autopilot, which only scenario files support.
constexpr std::array<std::string_view, 2> moving{mobility_type_names[0], "ArdupilotMobility"};
constexpr ReadBy with_motion{"mobility.typename", moving, ""};

constexpr Field fields[] = {
    // Scenario files have further types, so its key is not declared here.
    {"typename", &member<&MobilityConfig::type_name>, "", one_of(mobility_type_names), ""},
    {NETSIM_FIELD(MobilityConfig, speed_mps), "speed", quantity("mps").at_least(0),
     "Speed until the protocol sets another one, as every mission of the plugin does", with_motion},
    // Shorter intervals would leave time only for telemetry; longer ones do not fit into simulated time.
    {NETSIM_FIELD(MobilityConfig, telemetry_interval_s), "telemetryInterval",
     quantity("s").shown_in("ms").at_least(1e-6).at_most(1e6).or_special(0),
     "Time between two calls of handle_telemetry, at least 1us; 0s: no calls. In prototype mode the call "
     "comes with"
     " the first update of all positions at or after its time. Positions are updated every 10ms, or as often "
     "as the"
     " shortest interval says; beside autopilots the interval cannot be shorter than that"},
    {"initial_heading_rad", &member<&MobilityConfig::initial_orientation, &EulerAngles::heading_rad>,
     "initialHeading", angle(), "How the node is turned at the start: from the x axis to the y axis"},
    {"initial_elevation_rad", &member<&MobilityConfig::initial_orientation, &EulerAngles::elevation_rad>,
     "initialElevation", angle(), "The same upward"},
    {"initial_bank_rad", &member<&MobilityConfig::initial_orientation, &EulerAngles::bank_rad>, "initialBank",
     angle(), "The same about the node's own x axis, from the y axis to the z axis"},
    {NETSIM_FIELD(MobilityConfig, face_forward), "faceForward", boolean(),
     "Whether heading and elevation follow the direction of flight", with_motion},
};

}  // namespace

const Schema MobilityConfig::schema{"mobility", "mobility", true, fields};

}  // namespace netsim
