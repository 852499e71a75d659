// The air of one network: what `*.radioMedium.…` sets in an .ini file. Used by the medium.
//
// Defaults are those of INET 4.5's medium of the same name; the three media differ in defaults and, for the
// unit disk, in how a reception is decided.
#pragma once

#include <array>
#include <span>
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
// What each of them is: medium/path_loss.hpp, two_ray.hpp, fading.hpp. The last four are free space, and chance (Fading).
inline constexpr std::array<std::string_view, 8> path_loss_names{
    "FreeSpacePathLoss",  "BreakpointPathLoss", "TwoRayGroundReflection", "TwoRayInterference",
    "LogNormalShadowing", "RayleighFading",     "RicianFading",           "NakagamiFading"};
inline constexpr std::span<const std::string_view> fading_names = std::span(path_loss_names).last(4);
static_assert(fading_names.front() == "LogNormalShadowing",
              "a path loss without chance goes before those with it");
inline constexpr std::array<std::string_view, 2> polarization_names{"horizontal", "vertical"};
inline constexpr std::array<std::string_view, 3> obstacle_loss_names{"", "IdealObstacleLoss",
                                                                     "DielectricObstacleLoss"};
inline constexpr std::string_view thermal_noise = "ThermalNoise";
inline constexpr std::array<std::string_view, 2> background_noise_names{"IsotropicScalarBackgroundNoise",
                                                                        thermal_noise};
inline constexpr std::array<std::string_view, 1> propagation_names{"ConstantSpeedPropagation"};

struct MediumConfig {
    // Sets the defaults of that medium. Throws ConfigError if it is none of medium_type_names.
    explicit MediumConfig(std::string medium_type_name = std::string(ieee80211_scalar_medium));

    std::string type_name;  // `typename` in Python; one of medium_type_names

    std::string path_loss = "FreeSpacePathLoss";  // one of path_loss_names; 802.15.4: BreakpointPathLoss
    double alpha = 2;                             // free space, and what is built on it: exponent, > 0
    double breakpoint_distance_m = 8;             // breakpoint: > 0
    double l01_db = 40.2;                         // breakpoint: loss at 1 m, any
    double l02_db = 58.5;                         // breakpoint: loss at the breakpoint, any
    double alpha1 = 2;                            // breakpoint: exponent below it, > 0
    double alpha2 = 3.3;                          // breakpoint: exponent above it, > 0
    double epsilon_r = 1.02;                      // two-ray interference: permittivity of the ground, ≥ 1
    std::string polarization = "horizontal";      // two-ray interference: one of polarization_names
    double sigma_db = 1;                          // shadowing: standard deviation, 0 … 40
    double k_db = 8;                              // Rician: line of sight over scattered power, -100 … 100
    double shape_factor = 1;                      // Nakagami: m, 0.5 … 1000

    // Shadowing and fading: time from one independent state of a link to the next; 0: each transmission has one of its
    // own, as in INET; -1: that of the model; else 1e-6 … 1e6 s.
    double coherence_time_s = -1;

    std::string background_noise = "IsotropicScalarBackgroundNoise";  // one of background_noise_names
    double temperature_k = 290;                                       // thermal noise: ≥ 0
    double background_noise_w =
        1e-14;  // isotropic: -110 dBm; ≥ 0; 802.15.4: -96.616 dBm; in every band, not scaled

    std::string propagation = "ConstantSpeedPropagation";  // one of propagation_names; at the speed of light

    std::string obstacle_loss;           // one of obstacle_loss_names; none: obstacles are as nothing
    bool enable_dielectric_loss = true;  // dielectric: by the length inside
    bool enable_reflection_loss = true;  // dielectric: by the faces
    std::vector<ObstacleConfig> obstacles;

    // In s, the model's for -1: 5 ms for fading, what Clarke's model gives for 10 m/s at 2.4 GHz (0.423 λ / v; Rappaport,
    // "Wireless Communications", 2nd ed. 2002, 5.4.3); 1 s for shadowing, 10 m at that speed (M. Gudmundson,
    // "Correlation model for shadow fading in mobile radio systems", Electronics Letters 27, 1991: 8 m in a city).
    double coherence_time() const;

    // Throws ConfigError for the first field out of its range: "medium.alpha = -1: expected …".
    void validate() const;
};

}  // namespace netsim
