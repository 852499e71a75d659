// The medium of one network: settings `*.radioMedium.…` of an .ini file. Each field has a row below
// the struct, with its key, range and meaning.
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

inline constexpr Model medium_models[] = {
    {ieee80211_scalar_medium, {"interface", "radio", "antenna", "medium"}},
    {ieee802154_scalar_medium, {"interface", "radio", "antenna", "medium"}},
    {unit_disk_medium},
};
inline constexpr auto medium_type_names = names_of(medium_models);
inline constexpr ReadBy with_radios{"medium.typename", medium_models};

// MediumConfig::timing: what takes time. With all but the first, mac/ideal_interface.hpp replaces the MAC.
inline constexpr std::string_view mac_timing = "mac";
inline constexpr std::string_view instant_timing = "instant";
inline constexpr std::string_view aloha_timing = "aloha";
inline constexpr std::string_view channel_access_timing = "channelAccess";
inline constexpr std::array timing_names{mac_timing, instant_timing, std::string_view("airtime"),
                                         aloha_timing, channel_access_timing};

// See path_loss.hpp, two_ray.hpp and fading.hpp. Those with shadowing or fading are free space with random gains.
inline constexpr Model path_losses[] = {
    {"FreeSpacePathLoss", {"alpha", "system_loss"}},
    {"BreakpointPathLoss", {"breakpoint_distance_m", "l01_db", "l02_db", "alpha1", "alpha2"}},
    {"TwoRayGroundReflection", {"alpha"}, Model::Effect::ground},
    {"TwoRayInterference", {"epsilon_r", "polarization", "inet_vertical_sign"}, Model::Effect::ground},
    {"LogNormalShadowing",
     {"alpha", "system_loss", "sigma_db", "coherence_time_s"},
     Model::Effect::shadowing},
    {"RayleighFading", {"alpha", "system_loss", "coherence_time_s"}, Model::Effect::fading},
    {"RicianFading", {"alpha", "system_loss", "k_db", "coherence_time_s"}, Model::Effect::fading},
    {"NakagamiFading", {"alpha", "system_loss", "shape_factor", "coherence_time_s"}, Model::Effect::fading},
};
inline constexpr auto path_loss_names = names_of(path_losses);
inline constexpr ReadBy by_path_loss{"medium.path_loss", path_losses};
// Of a name that is in the table.
constexpr Model::Effect effect_of(std::string_view path_loss) {
    return model_named(path_loss, path_losses).effect;
}
constexpr bool has_ground(const Model& path_loss) {
    return path_loss.effect == Model::Effect::ground;
}
constexpr bool is_random(const Model& path_loss) {
    return path_loss.effect == Model::Effect::shadowing || path_loss.effect == Model::Effect::fading;
}

inline constexpr std::array<std::string_view, 2> polarization_names{"horizontal", "vertical"};

inline constexpr std::string_view thermal_noise = "ThermalNoise";
inline constexpr Model background_noises[] = {
    {"IsotropicScalarBackgroundNoise", {"background_noise_w"}},
    {thermal_noise, {"temperature_k", "radio.noise_figure"}},
};
inline constexpr auto background_noise_names = names_of(background_noises);
inline constexpr ReadBy by_background_noise{"medium.background_noise", background_noises};

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

inline constexpr Field medium_fields[] = {
    {"typename", NETSIM_MEMBER(MediumConfig, type_name), "typename", one_of(medium_type_names),
     "Model of the air: path loss and noise, or a circle", ReadBy{}},
    {NETSIM_FIELD(MediumConfig, timing), "timing", one_of(timing_names),
     "What takes time; mac: what the MAC of each interface does, not with UnitDiskRadioMedium. The others "
     "have no MAC,"
     " for comparison (docs/explanation/realism-levels.md); instant: nothing; airtime: frames and their way "
     "at the"
     " speed of light; aloha: the same, and frames that overlap are lost; channelAccess: waiting until the "
     "channel"
     " around the sender is free, too, so that frames never collide"},
    {NETSIM_FIELD(MediumConfig, background_noise), "backgroundNoise.typename", one_of(background_noise_names),
     "Noise in a channel: one power for all, or that of the receiver's bandwidth"},
    {NETSIM_FIELD(MediumConfig, background_noise_w), "backgroundNoise.power", level(), "noise in the channel",
     by_background_noise},
    {NETSIM_FIELD(MediumConfig, temperature_k), "backgroundNoise.temperature", quantity("K").at_least(0),
     "temperature around the receiver", by_background_noise},
    {NETSIM_FIELD(MediumConfig, other_systems_w), "otherSystems.power",
     quantity("W").shown_in("mW").at_least(0).at_most(1),
     "median power of other systems at each receiver, which adds to the background noise of receptions, "
     "not to that of energy detection; 0W: none; prototype mode has no noise"},
    {NETSIM_FIELD(MediumConfig, other_systems_standard_deviation_db), "otherSystems.standardDeviation",
     number_in("dB").at_least(0).at_most(40),
     "standard deviation of that power in dB, which is normally distributed and independent at each "
     "receiver"},
    {NETSIM_FIELD(MediumConfig, other_systems_coherence_time_s), "otherSystems.coherenceTime",
     quantity("s").shown_in("ms").at_least(1e-6).at_most(1e6),
     "time after which that power is drawn again, also within a frame"},
    {NETSIM_FIELD(MediumConfig, path_loss), "pathLoss.typename", one_of(path_loss_names),
     "How power falls with distance, and how it fades; docs/how-to/choose-a-propagation-model.md"},
    {NETSIM_FIELD(MediumConfig, alpha), "pathLoss.alpha", number().above(0), "exponent of the distance",
     by_path_loss},
    {NETSIM_FIELD(MediumConfig, system_loss), "pathLoss.systemLoss", ratio().at_least(1),
     "loss in cables, connectors and filters of sender and receiver together", by_path_loss},
    {NETSIM_FIELD(MediumConfig, breakpoint_distance_m), "pathLoss.breakpointDistance", quantity("m").above(0),
     "distance at which the exponent changes", by_path_loss},
    {NETSIM_FIELD(MediumConfig, l01_db), "pathLoss.l01", number_in("dB"), "loss at 1 m", by_path_loss},
    {NETSIM_FIELD(MediumConfig, l02_db), "pathLoss.l02", number_in("dB"), "loss at the breakpoint",
     by_path_loss},
    {NETSIM_FIELD(MediumConfig, alpha1), "pathLoss.alpha1", number().above(0),
     "exponent before the breakpoint", by_path_loss},
    {NETSIM_FIELD(MediumConfig, alpha2), "pathLoss.alpha2", number().above(0),
     "exponent beyond the breakpoint", by_path_loss},
    {NETSIM_FIELD(MediumConfig, epsilon_r), "pathLoss.epsilon_r", number().at_least(1),
     "relative permittivity of the ground", by_path_loss},
    {NETSIM_FIELD(MediumConfig, polarization), "pathLoss.polarization", one_of(polarization_names),
     "polarization of the antennas", by_path_loss},
    {NETSIM_FIELD(MediumConfig, inet_vertical_sign), "pathLoss.inetVerticalSign", boolean(),
     "whether the ground reflects vertical polarization with the opposite sign, as in INET: far away, the "
     "rays then add up instead of cancelling",
     by_path_loss},
    {NETSIM_FIELD(MediumConfig, sigma_db), "pathLoss.sigma", number().at_least(0).at_most(40),
     "standard deviation in dB, as a plain number", by_path_loss},
    {NETSIM_FIELD(MediumConfig, k_db), "pathLoss.k", quantity("dB").at_least(-100).at_most(100),
     "power of the line of sight over that of all other paths", by_path_loss},
    {NETSIM_FIELD(MediumConfig, shape_factor), "pathLoss.shapeFactor", number().at_least(0.5).at_most(1000),
     "m; the smaller, the deeper the fades", by_path_loss},
    {NETSIM_FIELD(MediumConfig, coherence_time_s), "pathLoss.coherenceTime",
     quantity("s").shown_in("ms").at_least(0).at_most(1e6).or_special(-1, "that of the model"),
     "time from one independent state of a link to the next, at least 1us; 0s: with each frame, as in INET;"
     " -1s: 5 ms, shadowing 1 s",
     by_path_loss},
    {NETSIM_FIELD(MediumConfig, shadowing_standard_deviation_db), "shadowing.standardDeviation",
     number_in("dB").at_least(0).at_most(40),
     "standard deviation of the normally distributed gain of each link in dB, beside any path loss and "
     "fading"},
    {NETSIM_FIELD(MediumConfig, shadowing_decorrelation_time_s), "shadowing.decorrelationTime",
     quantity("s").at_least(0).at_most(1e6),
     "time from one independent value of that gain to the next, at least 1us; 0s: with each frame"},
    {NETSIM_FIELD(MediumConfig, propagation), "propagation.typename", one_of(propagation_names),
     "How frames travel: at the speed of light"},
    {NETSIM_FIELD(MediumConfig, obstacle_loss), "obstacleLoss.typename", one_of(obstacle_loss_names),
     "What obstacles do to frames: nothing, block them, or weaken them; not with UnitDiskRadioMedium"},
    {NETSIM_FIELD(MediumConfig, enable_dielectric_loss), "obstacleLoss.enableDielectricLoss", boolean(),
     "whether the path inside the material weakens a frame", by_obstacle_loss},
    {NETSIM_FIELD(MediumConfig, enable_reflection_loss), "obstacleLoss.enableReflectionLoss", boolean(),
     "whether the reflection at each face weakens a frame", by_obstacle_loss},
};

inline constexpr Schema MediumConfig::schema{"medium", "radioMedium", false, medium_fields, with_radios};

}  // namespace netsim
