// The noise in a receiver's band when no radio transmits. Radios use it for the SNIR, the medium for
// energy detection.
//
//   IsotropicScalarBackgroundNoise: one power, MediumConfig::background_noise_w, for every receiver whatever its
//     bandwidth.
//   ThermalNoise: N = k T B F, with N in W, k the Boltzmann constant in J/K, T the temperature in K, B the receiver's
//     bandwidth in Hz and F its noise figure, a linear ratio. H. Nyquist, "Thermal Agitation of Electric Charge in
//     Conductors", 1928; H. T. Friis, "Noise Figures of Radio Receivers", 1944.
#pragma once

#include "netsim/config/medium_config.hpp"

namespace netsim {

class BackgroundNoise {
public:
    explicit BackgroundNoise(const MediumConfig& config);

    // In W, at a receiver with that bandwidth. `noise_figure`: a linear ratio ≥ 1, used for thermal
    // noise only.
    double power_w(double bandwidth_hz, double noise_figure) const {
        return power_w_ + density_w_per_hz_ * bandwidth_hz * noise_figure;
    }

private:
    double power_w_ = 0;
    double density_w_per_hz_ = 0;
};

}  // namespace netsim
