#include "netsim/config/medium_config.hpp"

#include <utility>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

namespace netsim {

MediumConfig::MediumConfig(std::string medium_type_name) : type_name(std::move(medium_type_name)) {
    check_name("medium.typename", type_name, medium_type_names);
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
    check_name("medium.typename", type_name, medium_type_names);
    check_name("medium.path_loss", path_loss, path_loss_names);
    check_greater("medium.alpha", alpha, 0, "");
    check_greater("medium.breakpoint_distance_m", breakpoint_distance_m, 0, "m");
    check_finite("medium.l01_db", l01_db, "dB");
    check_finite("medium.l02_db", l02_db, "dB");
    check_greater("medium.alpha1", alpha1, 0, "");
    check_greater("medium.alpha2", alpha2, 0, "");
    check_at_least("medium.epsilon_r", epsilon_r, 1, "");
    check_name("medium.polarization", polarization, polarization_names);
    check_between("medium.sigma_db", sigma_db, 0, 40, "dB");
    check_between("medium.k_db", k_db, -100, 100, "dB");
    check_between("medium.shape_factor", shape_factor, 0.5, 1000, "");
    const bool is_special = coherence_time_s == -1 || coherence_time_s == 0;
    const bool is_time = coherence_time_s >= 1e-6 && coherence_time_s <= 1e6;  // NaN is not
    if (!is_special && !is_time) {
        throw ConfigError("medium.coherence_time_s = " + text_of(coherence_time_s) +
                          " s: expected from 1e-06 s to 1000000 s, 0 s (new for each transmission) or -1 s "
                          "(that of the model)");
    }
    check_name("medium.background_noise", background_noise, background_noise_names);
    check_at_least("medium.temperature_k", temperature_k, 0, "K");
    check_at_least("medium.background_noise_w", background_noise_w, 0, "W");
    check_name("medium.propagation", propagation, propagation_names);
    check_name("medium.obstacle_loss", obstacle_loss, obstacle_loss_names);
    for (const ObstacleConfig& obstacle : obstacles) {
        obstacle.validate();
    }
}

}  // namespace netsim
