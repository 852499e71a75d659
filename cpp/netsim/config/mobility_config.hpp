// Mobility of one node: settings `*.<node>.mobility.…` of an .ini file. Used by the mobility models. Each field has a row below the struct.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/geometry/orientation.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

inline constexpr Model mobility_models[] = {
    {"MasslessMobility", {"speed_mps", "command_delay_s", "face_forward"}},
    {"StationaryMobility"},
    {"LinearMobility",
     {"speed_mps", "face_forward", "area_min_x_m", "area_min_y_m", "area_min_z_m", "area_max_x_m",
      "area_max_y_m", "area_max_z_m", "movement_heading_rad", "movement_elevation_rad"}},
    {"CircleMobility",
     {"speed_mps", "face_forward", "center_x_m", "center_y_m", "center_z_m", "radius_m", "start_angle_rad"}},
    {"RectangleMobility",
     {"speed_mps", "face_forward", "area_min_x_m", "area_min_y_m", "area_min_z_m", "area_max_x_m",
      "area_max_y_m", "area_max_z_m", "start_pos"}},
    {"QuadcopterMobility",
     {"speed_mps", "command_delay_s", "acceleration_mps2", "drag_kgps", "face_forward"}},
    // Flown by an autopilot, outside of the engine.
    {"ArdupilotMobility", {"speed_mps", "drag_kgps", "face_forward"}},
};
inline constexpr auto mobility_names = names_of(mobility_models);
static_assert(mobility_names.back() == "ArdupilotMobility");
inline constexpr auto mobility_type_names = std::span(mobility_names).first<mobility_names.size() - 1>();
inline constexpr ReadBy by_mobility{"mobility.typename", mobility_models};

struct MobilityConfig {
    std::string type_name = "MasslessMobility";  // `typename` in Python
    double speed_mps = 10;
    double command_delay_s = 0;
    double telemetry_interval_s = 0.01;  // 0: no telemetry

    double position_error_m = 0;
    double position_error_time_s = 175;
    double position_error_ratio = 2.3;

    // Of vehicles with inertia.
    double acceleration_mps2 = 2.5;
    double drag_kgps = 0.3;

    EulerAngles initial_orientation{};
    bool face_forward = false;

    // Of LinearMobility and RectangleMobility: by default the whole scene.
    Position area_min{-largest_coordinate_m, -largest_coordinate_m, -largest_coordinate_m};
    Position area_max{largest_coordinate_m, largest_coordinate_m, largest_coordinate_m};
    // Of LinearMobility.
    double movement_heading_rad = 0;
    double movement_elevation_rad = 0;
    // Of CircleMobility.
    Position center{};
    double radius_m = 0;  // 0: not set
    double start_angle_rad = 0;
    // Of RectangleMobility, in sides.
    double start_pos = 0;

    static const Schema schema;

    // Throws ConfigError for the first field out of its range: "mobility.speed_mps = -1 mps: expected …".
    void validate() const { check_fields(*this); }
};

namespace mobility_values {
inline constexpr ValueType coordinate =
    quantity("m").at_least(-largest_coordinate_m).at_most(largest_coordinate_m);
}  // namespace mobility_values

inline constexpr Field mobility_fields[] = {
    // Scenario files have further types, so its key is not declared here.
    {"typename", NETSIM_MEMBER(MobilityConfig, type_name), "", one_of(mobility_type_names), ""},
    {NETSIM_FIELD(MobilityConfig, speed_mps), "speed", quantity("mps").at_least(0),
     "speed; with MasslessMobility, QuadcopterMobility and autopilots until the protocol sets another one, "
     "as "
     "every mission of the plugin does",
     by_mobility},
    {NETSIM_FIELD(MobilityConfig, command_delay_s), "commandDelay", quantity("s").at_least(0).at_most(1e6),
     "Time from a command of the protocol until the vehicle obeys it", by_mobility},
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
     by_mobility},
    {NETSIM_FIELD(MobilityConfig, drag_kgps), "drag", number().at_least(0).at_most(10),
     "Force of the air in N per m/s of airspeed, on a vehicle of 2 kg", by_mobility},
    {"initial_heading_rad", NETSIM_MEMBER(MobilityConfig, initial_orientation.heading_rad), "initialHeading",
     angle(), "How the node is turned at the start: from the x axis to the y axis"},
    {"initial_elevation_rad", NETSIM_MEMBER(MobilityConfig, initial_orientation.elevation_rad),
     "initialElevation", angle(), "How far the node is turned upward at the start"},
    {"initial_bank_rad", NETSIM_MEMBER(MobilityConfig, initial_orientation.bank_rad), "initialBank", angle(),
     "How the node is turned at the start about its own x axis: from the y axis to the z axis"},
    {NETSIM_FIELD(MobilityConfig, face_forward), "faceForward", boolean(),
     "whether heading and elevation follow the direction of flight", by_mobility},
    {"area_min_x_m", NETSIM_MEMBER(MobilityConfig, area_min.x), "constraintAreaMinX",
     mobility_values::coordinate, "Smallest x of the area", by_mobility},
    {"area_min_y_m", NETSIM_MEMBER(MobilityConfig, area_min.y), "constraintAreaMinY",
     mobility_values::coordinate, "Smallest y of the area", by_mobility},
    {"area_min_z_m", NETSIM_MEMBER(MobilityConfig, area_min.z), "constraintAreaMinZ",
     mobility_values::coordinate, "Smallest z of the area", by_mobility},
    {"area_max_x_m", NETSIM_MEMBER(MobilityConfig, area_max.x), "constraintAreaMaxX",
     mobility_values::coordinate, "Largest x of the area", by_mobility},
    {"area_max_y_m", NETSIM_MEMBER(MobilityConfig, area_max.y), "constraintAreaMaxY",
     mobility_values::coordinate, "Largest y of the area", by_mobility},
    {"area_max_z_m", NETSIM_MEMBER(MobilityConfig, area_max.z), "constraintAreaMaxZ",
     mobility_values::coordinate, "Largest z of the area", by_mobility},
    {NETSIM_FIELD(MobilityConfig, movement_heading_rad), "initialMovementHeading", angle(),
     "Direction of the first leg, from the x axis to the y axis", by_mobility},
    {NETSIM_FIELD(MobilityConfig, movement_elevation_rad), "initialMovementElevation", angle(),
     "How far the first leg leads upward", by_mobility},
    {"center_x_m", NETSIM_MEMBER(MobilityConfig, center.x), "cx", mobility_values::coordinate,
     "x of the center of the circle", by_mobility},
    {"center_y_m", NETSIM_MEMBER(MobilityConfig, center.y), "cy", mobility_values::coordinate,
     "y of the center of the circle", by_mobility},
    {"center_z_m", NETSIM_MEMBER(MobilityConfig, center.z), "cz", mobility_values::coordinate,
     "z of the center of the circle", by_mobility},
    {NETSIM_FIELD(MobilityConfig, radius_m), "r",
     quantity("m").at_least(0.001).at_most(largest_coordinate_m).or_special(0, "not set"),
     "Radius of the circle, which is flown as a polygon at most 1 cm inside of it", by_mobility, true},
    {NETSIM_FIELD(MobilityConfig, start_angle_rad), "startAngle", angle(),
     "Where on the circle the node starts: from the x axis to the y axis", by_mobility},
    {NETSIM_FIELD(MobilityConfig, start_pos), "startPos", number().at_least(0).at_most(4),
     "Where on the border of the area the node starts, in sides: 0 is the corner of the smallest x and y, 1 "
     "that of the largest x and the smallest y, and so on",
     by_mobility},
};

inline constexpr Schema MobilityConfig::schema{"mobility", "mobility", true, mobility_fields};

}  // namespace netsim
