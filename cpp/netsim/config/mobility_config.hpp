// Mobility of one node: settings `*.<node>.mobility.…` of an .ini file. Used by the mobility models. The meaning and
// range of each field are in mobility_config.cpp.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/geometry/orientation.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 6> mobility_type_names{
    "MasslessMobility", "StationaryMobility", "LinearMobility",
    "CircleMobility",   "RectangleMobility",  "QuadcopterMobility"};

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

}  // namespace netsim
