// What a material does to waves that meet it and pass through it. Used by the obstacles of the medium.
//
// All materials are non-magnetic. Of many reflections between the faces of a body only the first at each face counts,
// and waves go straight on: what a body lets through is less certain than the digits show.
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

    // Share of the power that is left after `length_m` inside.
    double gain_through(double length_m) const;

    // Share of the power that gets through a face between air and the material; the same both ways. `cosine`, 0 … 1: of
    // the angle between the normal and the direction in the air. The mean of both polarisations.
    double gain_at_face(double cosine) const;

private:
    double power_attenuation_per_m_;
    std::complex<double> permittivity_;  // relative, complex
};

// Of the obstacle's material by ITU-R Recommendation P.2040-3, 2023, "Effects of building materials and structures on
// radiowave propagation above about 100 MHz", (28), (29) and table 3, unless the obstacle says otherwise.
Material make_material(const ObstacleConfig& config, double carrier_hz);

}  // namespace netsim
