// The air of one network: what `*.radioMedium.…` sets in an .ini file. Used by the medium.
//
// Defaults are those of INET 4.5's medium of the same name; the three media differ in defaults and, for the
// unit disk, in how a reception is decided.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/config/obstacle_config.hpp"

namespace netsim {

inline constexpr std::string_view ieee80211_scalar_medium = "Ieee80211ScalarRadioMedium";
inline constexpr std::string_view ieee802154_scalar_medium = "Ieee802154NarrowbandScalarRadioMedium";
// Within RadioConfig::communication_range_m everything arrives, beyond it nothing: no noise, no path loss.
inline constexpr std::string_view unit_disk_medium = "UnitDiskRadioMedium";

inline constexpr std::array medium_type_names{ieee80211_scalar_medium, ieee802154_scalar_medium,
                                              unit_disk_medium};
inline constexpr std::array<std::string_view, 2> path_loss_names{"FreeSpacePathLoss", "BreakpointPathLoss"};
inline constexpr std::array<std::string_view, 3> obstacle_loss_names{"", "IdealObstacleLoss",
                                                                     "DielectricObstacleLoss"};
inline constexpr std::array<std::string_view, 1> propagation_names{"ConstantSpeedPropagation"};

struct MediumConfig {
    // Sets the defaults of that medium. Throws ConfigError if it is none of medium_type_names.
    explicit MediumConfig(std::string medium_type_name = std::string(ieee80211_scalar_medium));

    std::string type_name;  // `typename` in Python; one of medium_type_names

    std::string path_loss = "FreeSpacePathLoss";  // one of path_loss_names; 802.15.4: BreakpointPathLoss
    double alpha = 2;                             // free space: exponent, > 0
    double breakpoint_distance_m = 8;             // breakpoint: > 0
    double l01_db = 40.2;                         // breakpoint: loss at 1 m, any
    double l02_db = 58.5;                         // breakpoint: loss at the breakpoint, any
    double alpha1 = 2;                            // breakpoint: exponent below it, > 0
    double alpha2 = 3.3;                          // breakpoint: exponent above it, > 0

    double background_noise_w = 1e-14;  // -110 dBm; ≥ 0; 802.15.4: -96.616 dBm; in every band, not scaled

    std::string propagation = "ConstantSpeedPropagation";  // one of propagation_names; at the speed of light

    std::string obstacle_loss;           // one of obstacle_loss_names; none: obstacles are as nothing
    bool enable_dielectric_loss = true;  // dielectric: by the length inside
    bool enable_reflection_loss = true;  // dielectric: by the faces
    std::vector<ObstacleConfig> obstacles;

    // Throws ConfigError for the first field out of its range: "medium.alpha = -1: expected …".
    void validate() const;
};

}  // namespace netsim
