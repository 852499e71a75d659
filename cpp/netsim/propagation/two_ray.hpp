// Path loss with a ground: the direct ray and the one that a flat ground at z = 0 reflects.
//
// d is the distance of the ends, h and h' their heights |z|, λ the wavelength, all in m.
//   TwoRayGroundReflection: free space, λ² / (16 π² d^α), below the crossover distance 4 π h h' / λ, and from there on
//     h² h'² / d⁴. Source: T. S. Rappaport, "Wireless Communications: Principles and Practice", 2nd ed. 2002, 4.6.
//   TwoRayInterference: λ² / (16 π² d²) · |1 + Γ e^(iφ)|², where φ = 2 π (d' − d) / λ is by how much the reflected ray,
//     of length d', lags behind, and Γ is Fresnel's coefficient for a ground of relative permittivity ε. With θ the
//     angle between ray and ground and q = √(ε − cos² θ), Γ is (sin θ − q) / (sin θ + q) for horizontal polarization
//     and (ε sin θ − q) / (ε sin θ + q) for vertical. Source: C. Sommer, F. Dressler, "Using the right two-ray model? A
//     measurement-based evaluation of PHY models in VANETs", MobiCom 2011 poster; Rappaport, 4.5. Rappaport's vertical
//     coefficient has the opposite sign, since it counts the field along another axis. INET uses it as it is, and so
//     does inet_vertical_sign. With the signs above, both are −1 along the ground, as far away as h² h'² / d⁴ holds.
// If an end is on the ground, nothing is received far away: the rays cancel. Set heights for these
// models.
#pragma once

#include "netsim/config/medium_config.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

class TwoRay {
public:
    // None, if config.path_loss names a model without a ground.
    explicit TwoRay(const MediumConfig& config);

    bool is_none() const { return kind_ == Kind::none; }

    // Received over transmitted power between isotropic antennas, at most 1; the same in both
    // directions. `distance_m`: between the positions. Not for is_none().
    double gain(const Position& a, const Position& b, double distance_m, double carrier_hz) const;
    // The same of the direct ray alone.
    double direct_gain(double distance_m, double carrier_hz) const;

private:
    enum class Kind { none, ground_reflection, interference };

    // |1 + Γ e^(iφ)|², from 0 to 4.
    double interference_factor(const Position& a, const Position& b, double distance_m,
                               double wavelength_m) const;

    Kind kind_ = Kind::none;
    double alpha_;
    double epsilon_r_;
    bool is_vertical_;
    double sign_;  // of the reflected ray
};

}  // namespace netsim
