// Antenna patterns, by INET's names. Used by the radio, which passes them to the medium.
//
//   IsotropicAntenna: gain 1 in all directions, without a pattern.
//   ConstantGainAntenna: the same gain in all directions, such as the loss of a cable.
//   DipoleAntenna: a thin wire of length l along one axis, fed in the middle, its current a standing wave. With θ the
//     angle from the wire and k = 2π / λ, gain = D · F(θ) / F(π/2) and F = ((cos(½ k l cos θ) - cos(½ k l)) / sin θ)²;
//     D makes the mean over all directions 1. C. A. Balanis, "Antenna Theory", 3rd ed., 2005, (4-62a) and (4-67); a
//     length of 0 is the infinitesimal dipole, 1.5 sin² θ, (4-31), and half a wavelength gives D = 1.643, (4-91).
//   CosineAntenna: gain = max · cos^n(ψ/2), with ψ the angle from the boresight and n such that the gain is half the
//     largest (-3.01 dB) at half the beam width. Li Chunjian, "Efficient Antenna Patterns for Three-Sector WCDMA
//     Systems", 2003, (B.1), the same for field strengths.
//   ParabolicAntenna: gain in dB = max - min(12 (ψ / beam width)², max - min). 3GPP TR 36.814 V9.0.0, table
//     A.2.1.1-2, for all directions around the boresight.
// The dipole is lossless: its mean gain is 1. The others have a given maximum gain; their mean need not be 1.
#pragma once

#include <memory>

#include "netsim/config/antenna_config.hpp"
#include "netsim/propagation/antenna_pattern.hpp"

namespace netsim {

// The pattern of config.type_name; null for the isotropic antenna. The dipole's pattern depends on
// the carrier frequency. Throws ConfigError for an unknown name.
std::unique_ptr<const AntennaPattern> make_antenna(const AntennaConfig& config, double carrier_hz);

}  // namespace netsim
