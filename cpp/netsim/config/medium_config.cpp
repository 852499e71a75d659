#include "netsim/config/medium_config.hpp"

#include <utility>

#include "netsim/config/check.hpp"

namespace netsim {

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
    return effect_of(path_loss) == Model::Effect::shadowing ? 1 : 0.005;
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
