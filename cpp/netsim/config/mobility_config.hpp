// How one node moves: what `*.<node>.mobility.…` sets in an .ini file. Used by the mobility models.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/geometry/orientation.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 2> mobility_type_names{"MasslessMobility",
                                                                     "StationaryMobility"};

struct MobilityConfig {
    std::string type_name = "MasslessMobility";  // `typename` in Python; one of mobility_type_names
    double speed_mps = 10;                       // until a protocol sets another; ≥ 0
    double telemetry_interval_s = 0.01;          // 0: no telemetry; otherwise 1e-6 … 1e6

    EulerAngles initial_orientation{};  // rad, each finite
    bool face_forward = false;          // whether it is turned to where it flies

    // Throws ConfigError for the first field out of its range: "mobility.speed_mps = -1 m/s: expected …".
    void validate() const;
};

}  // namespace netsim
