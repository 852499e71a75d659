#include "netsim/medium/background_noise.hpp"

namespace netsim {

BackgroundNoise::BackgroundNoise(const MediumConfig& config) {
    constexpr double boltzmann_j_per_k = 1.380649e-23;  // exact since 2019
    if (config.background_noise == thermal_noise) {
        density_w_per_hz_ = boltzmann_j_per_k * config.temperature_k;
    } else {
        power_w_ = config.background_noise_w;
    }
}

}  // namespace netsim
