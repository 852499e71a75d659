#include "netsim/config/medium_config.hpp"

#include <utility>

#include "netsim/config/check.hpp"

namespace netsim {
namespace {

constexpr std::array power_law{path_loss_names[0], path_loss_names[2], path_loss_names[4],
                               path_loss_names[5], path_loss_names[6], path_loss_names[7]};
constexpr std::array free_space{path_loss_names[0], path_loss_names[4], path_loss_names[5],
                                path_loss_names[6], path_loss_names[7]};
constexpr std::array breakpoint{path_loss_names[1]};
constexpr std::array two_ray{path_loss_names[3]};
constexpr std::array shadowing{path_loss_names[4]};
constexpr std::array rician{path_loss_names[6]};
constexpr std::array nakagami{path_loss_names[7]};
constexpr std::array isotropic{background_noise_names[0]};
constexpr std::array thermal{thermal_noise};
constexpr std::array dielectric{dielectric_obstacle_loss};

constexpr ReadBy with_power_law{"medium.path_loss", power_law,
                                "All but BreakpointPathLoss and TwoRayInterference"};
constexpr ReadBy with_free_space{"medium.path_loss", free_space, "FreeSpacePathLoss, shadowing and fading"};
constexpr ReadBy with_breakpoint{"medium.path_loss", breakpoint, breakpoint[0]};
constexpr ReadBy with_two_ray{"medium.path_loss", two_ray, two_ray[0]};
constexpr ReadBy with_shadowing{"medium.path_loss", shadowing, shadowing[0]};
constexpr ReadBy with_rician{"medium.path_loss", rician, rician[0]};
constexpr ReadBy with_nakagami{"medium.path_loss", nakagami, nakagami[0]};
constexpr ReadBy with_fading{"medium.path_loss", fading_names, "Shadowing and fading"};
constexpr ReadBy with_isotropic_noise{"medium.background_noise", isotropic, isotropic[0]};
constexpr ReadBy with_thermal_noise{"medium.background_noise", thermal, thermal[0]};
constexpr ReadBy with_dielectric{"medium.obstacle_loss", dielectric, dielectric[0]};

constexpr Field fields[] = {
    {"typename", &member<&MediumConfig::type_name>, "typename", one_of(medium_type_names),
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
     with_isotropic_noise},
    {NETSIM_FIELD(MediumConfig, temperature_k), "backgroundNoise.temperature", quantity("K").at_least(0),
     "temperature around the receiver", with_thermal_noise},
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
     with_power_law},
    {NETSIM_FIELD(MediumConfig, system_loss), "pathLoss.systemLoss", ratio().at_least(1),
     "loss in cables, connectors and filters of sender and receiver together", with_free_space},
    {NETSIM_FIELD(MediumConfig, breakpoint_distance_m), "pathLoss.breakpointDistance", quantity("m").above(0),
     "distance at which the exponent changes", with_breakpoint},
    {NETSIM_FIELD(MediumConfig, l01_db), "pathLoss.l01", number_in("dB"), "loss at 1 m", with_breakpoint},
    {NETSIM_FIELD(MediumConfig, l02_db), "pathLoss.l02", number_in("dB"), "loss at the breakpoint",
     with_breakpoint},
    {NETSIM_FIELD(MediumConfig, alpha1), "pathLoss.alpha1", number().above(0),
     "exponent before the breakpoint", with_breakpoint},
    {NETSIM_FIELD(MediumConfig, alpha2), "pathLoss.alpha2", number().above(0),
     "exponent beyond the breakpoint", with_breakpoint},
    {NETSIM_FIELD(MediumConfig, epsilon_r), "pathLoss.epsilon_r", number().at_least(1),
     "relative permittivity of the ground", with_two_ray},
    {NETSIM_FIELD(MediumConfig, polarization), "pathLoss.polarization", one_of(polarization_names),
     "polarization of the antennas", with_two_ray},
    {NETSIM_FIELD(MediumConfig, inet_vertical_sign), "pathLoss.inetVerticalSign", boolean(),
     "whether the ground reflects vertical polarization with the opposite sign, as in INET: far away, the "
     "rays then add up instead of cancelling",
     with_two_ray},
    {NETSIM_FIELD(MediumConfig, sigma_db), "pathLoss.sigma", number().at_least(0).at_most(40),
     "standard deviation in dB, as a plain number", with_shadowing},
    {NETSIM_FIELD(MediumConfig, k_db), "pathLoss.k", quantity("dB").at_least(-100).at_most(100),
     "power of the line of sight over that of all other paths", with_rician},
    {NETSIM_FIELD(MediumConfig, shape_factor), "pathLoss.shapeFactor", number().at_least(0.5).at_most(1000),
     "m; the smaller, the deeper the fades", with_nakagami},
    {NETSIM_FIELD(MediumConfig, coherence_time_s), "pathLoss.coherenceTime",
     quantity("s").shown_in("ms").at_least(0).at_most(1e6).or_special(-1, "that of the model"),
     "time from one independent state of a link to the next, at least 1us; 0s: with each frame, as in INET;"
     " -1s: 5 ms, shadowing 1 s",
     with_fading},
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
     "whether the path inside the material weakens a frame", with_dielectric},
    {NETSIM_FIELD(MediumConfig, enable_reflection_loss), "obstacleLoss.enableReflectionLoss", boolean(),
     "whether the reflection at each face weakens a frame", with_dielectric},
};

}  // namespace

const Schema MediumConfig::schema{"medium", "radioMedium", false, fields, with_radios};

MediumConfig::MediumConfig(std::string medium_type_name) : type_name(std::move(medium_type_name)) {
    check_name("medium.typename", type_name, medium_type_names);
    if (type_name == unit_disk_medium) {
        timing = instant_timing;
    }
    if (type_name == ieee802154_scalar_medium) {
        path_loss = "BreakpointPathLoss";
        background_noise_w = 2.1797164411399055e-13;  // -96.616 dBm
    }
}

double MediumConfig::coherence_time() const {
    if (coherence_time_s != -1) {
        return coherence_time_s;
    }
    return path_loss == "LogNormalShadowing" ? 1 : 0.005;
}

void MediumConfig::validate() const {
    check_fields(*this);
    if (type_name == unit_disk_medium && timing == mac_timing) {
        throw ConfigError(
            {"medium.timing",
             "\"" + timing + "\"",
             {"expected instant, airtime, aloha or channelAccess: " + type_name + " has no MAC"}});
    }
    constexpr double shortest_s = 1e-6;
    const auto check_time = [](const char* field, double time_s) {
        if (time_s > 0 && time_s < shortest_s) {
            throw ConfigError({field,
                               Quantity{time_s, "s"},
                               {"expected at least ", Quantity{shortest_s, "s"}, ", or ", Quantity{0, "s"},
                                " (new for each transmission)"}});
        }
    };
    check_time("medium.coherence_time_s", coherence_time_s);
    check_time("medium.shadowing_decorrelation_time_s", shadowing_decorrelation_time_s);
    for (const ObstacleConfig& obstacle : obstacles) {
        obstacle.validate();
    }
}

}  // namespace netsim
