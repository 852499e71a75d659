#include "netsim/config/mobility_config.hpp"

#include <span>

namespace netsim {
namespace {

// The last name is for vehicles with an autopilot, which only scenario files support.
constexpr std::array<std::string_view, 6> moving{mobility_type_names[0], mobility_type_names[2],
                                                 mobility_type_names[3], mobility_type_names[4],
                                                 mobility_type_names[5], "ArdupilotMobility"};
constexpr std::array<std::string_view, 2> obeying{mobility_type_names[0], mobility_type_names[5]};
constexpr std::array<std::string_view, 2> in_an_area{mobility_type_names[2], mobility_type_names[4]};
constexpr ReadBy with_motion{"mobility.typename", moving, ""};
constexpr ReadBy with_controller{"mobility.typename", std::span(mobility_type_names).subspan(5, 1),
                                 "QuadcopterMobility"};
constexpr ReadBy with_commands{"mobility.typename", obeying, "MasslessMobility, QuadcopterMobility"};
constexpr ReadBy with_drag{"mobility.typename", std::span(moving).subspan(4),
                           "QuadcopterMobility, ArdupilotMobility"};
constexpr ReadBy with_area{"mobility.typename", in_an_area, "LinearMobility, RectangleMobility"};
constexpr ReadBy with_line{"mobility.typename", std::span(mobility_type_names).subspan(2, 1),
                           "LinearMobility"};
constexpr ReadBy with_circle{"mobility.typename", std::span(mobility_type_names).subspan(3, 1),
                             "CircleMobility"};
constexpr ReadBy with_rectangle{"mobility.typename", std::span(mobility_type_names).subspan(4, 1),
                                "RectangleMobility"};

constexpr ValueType coordinate() {
    return quantity("m").at_least(-largest_coordinate_m).at_most(largest_coordinate_m);
}

constexpr Field fields[] = {
    // Scenario files have further types, so its key is not declared here.
    {"typename", &member<&MobilityConfig::type_name>, "", one_of(mobility_type_names), ""},
    {NETSIM_FIELD(MobilityConfig, speed_mps), "speed", quantity("mps").at_least(0),
     "Speed; with MasslessMobility, QuadcopterMobility and autopilots until the protocol sets another one, "
     "as "
     "every mission of the plugin does",
     with_motion},
    {NETSIM_FIELD(MobilityConfig, command_delay_s), "commandDelay", quantity("s").at_least(0).at_most(1e6),
     "Time from a command of the protocol until the vehicle obeys it", with_commands},
    // Shorter intervals would leave time only for telemetry; longer ones do not fit into simulated time.
    {NETSIM_FIELD(MobilityConfig, telemetry_interval_s), "telemetryInterval",
     quantity("s").shown_in("ms").at_least(1e-6).at_most(1e6).or_special(0),
     "Time between two calls of handle_telemetry, at least 1us; 0s: no calls. In prototype mode the call "
     "comes with"
     " the first update of all positions at or after its time. Positions are updated every 10ms, or as often "
     "as the"
     " shortest interval says; beside quadcopters and autopilots the interval cannot be shorter than that"},
    {NETSIM_FIELD(MobilityConfig, position_error_m), "positionError", quantity("m").at_least(0).at_most(1e6),
     "Standard deviation of the error of the position that telemetry reports, on each horizontal axis. "
     "QuadcopterMobility flies by this position; radios are where the node is"},
    {NETSIM_FIELD(MobilityConfig, position_error_time_s), "positionErrorTime", quantity("s").above(0),
     "Time in which the error changes: after it, its correlation is 1/e"},
    {NETSIM_FIELD(MobilityConfig, position_error_ratio), "positionErrorRatio",
     number().at_least(0).at_most(100),
     "Standard deviation of the error of z over that of a horizontal axis"},
    {NETSIM_FIELD(MobilityConfig, acceleration_mps2), "acceleration", number().at_least(0.01).at_most(10),
     "Largest horizontal and vertical acceleration in m/s²; before a target it brakes with 0.8 times as much",
     with_controller},
    {NETSIM_FIELD(MobilityConfig, drag_kgps), "drag", number().at_least(0).at_most(10),
     "Force of the air in N per m/s of airspeed, on a vehicle of 2 kg", with_drag},
    {"initial_heading_rad", &member<&MobilityConfig::initial_orientation, &EulerAngles::heading_rad>,
     "initialHeading", angle(), "How the node is turned at the start: from the x axis to the y axis"},
    {"initial_elevation_rad", &member<&MobilityConfig::initial_orientation, &EulerAngles::elevation_rad>,
     "initialElevation", angle(), "The same upward"},
    {"initial_bank_rad", &member<&MobilityConfig::initial_orientation, &EulerAngles::bank_rad>, "initialBank",
     angle(), "The same about the node's own x axis, from the y axis to the z axis"},
    {NETSIM_FIELD(MobilityConfig, face_forward), "faceForward", boolean(),
     "Whether heading and elevation follow the direction of flight", with_motion},
    {"area_min_x_m", &member<&MobilityConfig::area_min, &Position::x>, "constraintAreaMinX", coordinate(),
     "Smallest x of the area", with_area},
    {"area_min_y_m", &member<&MobilityConfig::area_min, &Position::y>, "constraintAreaMinY", coordinate(),
     "The same for y", with_area},
    {"area_min_z_m", &member<&MobilityConfig::area_min, &Position::z>, "constraintAreaMinZ", coordinate(),
     "The same for z", with_area},
    {"area_max_x_m", &member<&MobilityConfig::area_max, &Position::x>, "constraintAreaMaxX", coordinate(),
     "Largest x of the area", with_area},
    {"area_max_y_m", &member<&MobilityConfig::area_max, &Position::y>, "constraintAreaMaxY", coordinate(),
     "The same for y", with_area},
    {"area_max_z_m", &member<&MobilityConfig::area_max, &Position::z>, "constraintAreaMaxZ", coordinate(),
     "The same for z", with_area},
    {NETSIM_FIELD(MobilityConfig, movement_heading_rad), "initialMovementHeading", angle(),
     "Direction of the first leg, from the x axis to the y axis", with_line},
    {NETSIM_FIELD(MobilityConfig, movement_elevation_rad), "initialMovementElevation", angle(),
     "The same upward", with_line},
    {"center_x_m", &member<&MobilityConfig::center, &Position::x>, "cx", coordinate(),
     "x of the center of the circle", with_circle},
    {"center_y_m", &member<&MobilityConfig::center, &Position::y>, "cy", coordinate(), "The same for y",
     with_circle},
    {"center_z_m", &member<&MobilityConfig::center, &Position::z>, "cz", coordinate(), "The same for z",
     with_circle},
    {NETSIM_FIELD(MobilityConfig, radius_m), "r",
     quantity("m").at_least(0.001).at_most(largest_coordinate_m).or_special(0, "not set"),
     "Radius of the circle, which is flown as a polygon at most 1 cm inside of it", with_circle, true},
    {NETSIM_FIELD(MobilityConfig, start_angle_rad), "startAngle", angle(),
     "Where on the circle the node starts: from the x axis to the y axis", with_circle},
    {NETSIM_FIELD(MobilityConfig, start_pos), "startPos", number().at_least(0).at_most(4),
     "Where on the border of the area the node starts, in sides: 0 is the corner of the smallest x and y, 1 "
     "that of the largest x and the smallest y, and so on",
     with_rectangle},
};

}  // namespace

const Schema MobilityConfig::schema{"mobility", "mobility", true, fields};

}  // namespace netsim
