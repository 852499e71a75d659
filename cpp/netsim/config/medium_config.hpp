// The medium of one network: settings `*.radioMedium.…` of an .ini file. The meaning and range of each field are in
// medium_config.cpp.
//
// Defaults are those of INET 4.5's medium of the same name. The three media differ in their defaults. The unit disk also
// decides receptions in another way.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/config/field.hpp"
#include "netsim/config/obstacle_config.hpp"

namespace netsim {

inline constexpr std::string_view ieee80211_scalar_medium = "Ieee80211ScalarRadioMedium";
inline constexpr std::string_view ieee802154_scalar_medium = "Ieee802154NarrowbandScalarRadioMedium";
// Everything arrives within RadioConfig::communication_range_m, nothing beyond it: no noise, no path loss.
inline constexpr std::string_view unit_disk_medium = "UnitDiskRadioMedium";

inline constexpr std::array medium_type_names{ieee80211_scalar_medium, ieee802154_scalar_medium,
                                              unit_disk_medium};
// MediumConfig::timing: what takes time. With all but the first, mac/ideal_interface.hpp replaces the MAC.
inline constexpr std::string_view mac_timing = "mac";
inline constexpr std::string_view instant_timing = "instant";
inline constexpr std::string_view aloha_timing = "aloha";
inline constexpr std::string_view channel_access_timing = "channelAccess";
inline constexpr std::array timing_names{mac_timing, instant_timing, std::string_view("airtime"),
                                         aloha_timing, channel_access_timing};
// With other media, nothing reads the keys of radio, MAC and antenna.
inline constexpr ReadBy with_radios{"medium.typename", std::span(medium_type_names).first(2), ""};
// See path_loss.hpp, two_ray.hpp and fading.hpp. The last four are free space with random gains (Fading).
inline constexpr std::array<std::string_view, 8> path_loss_names{
    "FreeSpacePathLoss",  "BreakpointPathLoss", "TwoRayGroundReflection", "TwoRayInterference",
    "LogNormalShadowing", "RayleighFading",     "RicianFading",           "NakagamiFading"};
inline constexpr std::span<const std::string_view> fading_names = std::span(path_loss_names).last(4);
static_assert(fading_names.front() == "LogNormalShadowing",
              "a path loss without chance goes before those with it");
inline constexpr std::array<std::string_view, 2> polarization_names{"horizontal", "vertical"};
inline constexpr std::string_view thermal_noise = "ThermalNoise";
inline constexpr std::array<std::string_view, 2> background_noise_names{"IsotropicScalarBackgroundNoise",
                                                                        thermal_noise};
inline constexpr std::array<std::string_view, 1> propagation_names{"ConstantSpeedPropagation"};

struct MediumConfig {
    // Sets the defaults of that medium. Throws ConfigError if the name is not one of medium_type_names.
    explicit MediumConfig(std::string medium_type_name = std::string(ieee80211_scalar_medium));

    std::string type_name;  // `typename` in Python

    std::string timing{mac_timing};  // "instant" on the unit disk

    std::string path_loss = "FreeSpacePathLoss";
    double alpha = 2;
    double system_loss = 1;  // 0 dB
    double breakpoint_distance_m = 8;
    double l01_db = 40.2;
    double l02_db = 58.5;
    double alpha1 = 2;
    double alpha2 = 3.3;
    double epsilon_r = 1.02;
    std::string polarization = "horizontal";
    bool inet_vertical_sign = false;
    double sigma_db = 1;
    double k_db = 8;
    double shape_factor = 1;
    double coherence_time_s =
        -1;  // 0: each transmission has its own state, as in INET; -1: the default of the model

    // Beside any path loss (Fading::shadowing).
    double shadowing_standard_deviation_db = 0;
    double shadowing_decorrelation_time_s = 1;  // 0: each transmission has its own state

    std::string background_noise = "IsotropicScalarBackgroundNoise";
    double temperature_k = 290;
    double background_noise_w = 1e-14;  // -110 dBm in every band, for any width

    // Power of other systems, beside any background noise (medium/other_systems.hpp). 0: none
    double other_systems_w = 0;
    double other_systems_standard_deviation_db = 0;
    double other_systems_coherence_time_s = 0.1;

    std::string propagation = "ConstantSpeedPropagation";  // at the speed of light

    std::string obstacle_loss;  // "": obstacles have no effect
    bool enable_dielectric_loss = true;
    bool enable_reflection_loss = true;
    std::vector<ObstacleConfig> obstacles;

    static const Schema schema;

    // In s. For -1 the default of the model. Fading: 5 ms, which Clarke's model gives for 10 m/s at 2.4 GHz (0.423 λ / v;
    // Rappaport, "Wireless Communications", 2nd ed. 2002, 5.4.3). Shadowing: 1 s, 10 m at that speed (M. Gudmundson,
    // "Correlation model for shadow fading in mobile radio systems", Electronics Letters 27, 1991: 8 m in a city).
    double coherence_time() const;

    // Throws ConfigError for the first field outside its range: "medium.alpha = -1: expected …".
    void validate() const;
};

}  // namespace netsim
