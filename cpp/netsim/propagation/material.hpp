// The loss of a wave that enters a material and passes through it. Used by Obstacles.
//
// All materials are non-magnetic. Only the first reflection at each face counts, and waves go
// straight on. So the loss is less accurate than its digits suggest.
#pragma once

#include <complex>
#include <string_view>

#include "netsim/config/obstacle_config.hpp"

namespace netsim {

// A material at one frequency.
class Material {
public:
    // `relative_permittivity` ≥ 1, `conductivity_spm` ≥ 0 in S/m.
    Material(double relative_permittivity, double conductivity_spm, double carrier_hz);

    // The share of the power left after `length_m` inside.
    double gain_through(double length_m) const;

    // The share of the power that passes a face between air and the material; the same in both
    // directions. `cosine`, 0 … 1: of the angle between the normal and the direction in air. The
    // mean of both polarizations.
    double gain_at_face(double cosine) const;

private:
    double power_attenuation_per_m_;
    std::complex<double> permittivity_;  // relative, complex
};

// The obstacle's material by ITU-R Recommendation P.2040-3, 2023, "Effects of building materials
// and structures on radiowave propagation above about 100 MHz", (28), (29) and table 3, unless the
// obstacle overrides it.
Material make_material(const ObstacleConfig& config, double carrier_hz);

}  // namespace netsim
