// One antenna: settings `*.<node>.wlan[*].radio.antenna.…` of an .ini file. Used by the phy. The meaning and range of
// each field are in antenna_config.cpp.
//
// Names are those of INET 4.5's antennas; INET has no defaults for gains and beam widths. Gains are linear ratios to an
// isotropic antenna, angles are in radians.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/geometry/orientation.hpp"

namespace netsim {

inline constexpr std::array<std::string_view, 5> antenna_type_names{
    "IsotropicAntenna", "ConstantGainAntenna", "DipoleAntenna", "CosineAntenna", "ParabolicAntenna"};
inline constexpr std::array<std::string_view, 3> wire_axis_names{"x", "y", "z"};

struct AntennaConfig {
    std::string type_name = "IsotropicAntenna";  // `typename` in Python

    double gain = 1;
    double max_gain = 1;
    double min_gain = 0.01;     // -20 dB
    double beam_width_rad = 0;  // 0: not set
    std::string wire_axis = "z";
    double length_m = 0;
    EulerAngles offset{};

    static const Schema schema;

    // Throws ConfigError for the first field outside its range; some ranges depend on the type and on the carrier.
    void validate(double carrier_hz) const;

    bool operator==(const AntennaConfig&) const = default;
};

}  // namespace netsim
