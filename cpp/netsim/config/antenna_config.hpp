// One antenna: what `*.<node>.wlan[*].radio.antenna.…` sets in an .ini file. Used by the phy.
//
// Names are those of INET 4.5's antennas; INET has no defaults for gains and beam widths. Gains are linear ratios to an
// isotropic antenna, angles radians.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/geometry/orientation.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 5> antenna_type_names{
    "IsotropicAntenna", "ConstantGainAntenna", "DipoleAntenna", "CosineAntenna", "ParabolicAntenna"};
inline constexpr std::array<std::string_view, 3> wire_axis_names{"x", "y", "z"};

struct AntennaConfig {
    std::string type_name = "IsotropicAntenna";  // `typename` in Python; one of antenna_type_names

    double gain = 1;              // constant gain: in all directions, ≥ 0
    double max_gain = 1;          // cosine, parabolic: along the boresight, x; ≥ 0
    double min_gain = 0.01;       // parabolic: outside of the beam; 0 … max_gain; -20 dB
    double beam_width_rad = 0;    // cosine, parabolic: between the directions at half the power;
                                  // > 0, < 2π; there is no default
    std::string wire_axis = "z";  // dipole: the axis along which it lies; one of wire_axis_names
    double length_m = 0;          // dipole: from end to end, 0 … one wavelength
    EulerAngles offset{};         // how it is turned on the node, each finite

    // Throws ConfigError for the first field out of its range: "antenna.gain = -1: expected …".
    void validate(double carrier_hz) const;

    bool operator==(const AntennaConfig&) const = default;
};

}  // namespace netsim
