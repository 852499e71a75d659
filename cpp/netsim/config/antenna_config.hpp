// One antenna: settings `*.<node>.wlan[*].radio.antenna.…` of an .ini file. Used by the phy. Each field has a row below the struct.
//
// Names are those of INET 4.5's antennas; INET has no defaults for gains and beam widths. Gains are linear ratios to an
// isotropic antenna, angles are in radians.
#pragma once

#include <array>
#include <numbers>
#include <string>
#include <string_view>

#include "netsim/config/field.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/geometry/orientation.hpp"

namespace netsim {

inline constexpr Model antenna_models[] = {
    {"IsotropicAntenna"},
    {"ConstantGainAntenna", {"gain"}},
    {"DipoleAntenna",
     {"wire_axis", "length_m", "offset_heading_rad", "offset_elevation_rad", "offset_bank_rad"}},
    {"CosineAntenna",
     {"max_gain", "beam_width_rad", "offset_heading_rad", "offset_elevation_rad", "offset_bank_rad"}},
    {"ParabolicAntenna",
     {"max_gain", "min_gain", "beam_width_rad", "offset_heading_rad", "offset_elevation_rad",
      "offset_bank_rad"}},
};
inline constexpr auto antenna_type_names = names_of(antenna_models);
inline constexpr ReadBy by_antenna{"antenna.typename", antenna_models};

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

inline constexpr double widest_beam_rad =
    1.999 * std::numbers::pi;  // at 2π the exponent of the cosine would be 0

inline constexpr Field antenna_fields[] = {
    {"typename", NETSIM_MEMBER(AntennaConfig, type_name), "typename", one_of(antenna_type_names),
     "In which directions the antenna sends and receives"},
    {NETSIM_FIELD(AntennaConfig, gain), "gain", ratio(), "gain in all directions", by_antenna},
    {NETSIM_FIELD(AntennaConfig, max_gain), "maxGain", ratio(), "gain along the boresight, its x axis",
     by_antenna},
    {NETSIM_FIELD(AntennaConfig, min_gain), "minGain", ratio(), "gain outside of the beam", by_antenna},
    {NETSIM_FIELD(AntennaConfig, beam_width_rad), "beamWidth",
     angle().above(0).at_most(widest_beam_rad).or_special(0, "not set"),
     "angle between the directions of half the power", by_antenna, true},
    {NETSIM_FIELD(AntennaConfig, wire_axis), "wireAxis", one_of(wire_axis_names), "axis along which it lies",
     by_antenna},
    {NETSIM_FIELD(AntennaConfig, length_m), "length", quantity("m").at_least(0),
     "from end to end, at most one wavelength; 0m: much shorter than the wave", by_antenna},
    {"offset_heading_rad", NETSIM_MEMBER(AntennaConfig, offset.heading_rad), "offsetHeading", angle(),
     "how the antenna is turned on the node: from the node's x axis to its y axis", by_antenna},
    {"offset_elevation_rad", NETSIM_MEMBER(AntennaConfig, offset.elevation_rad), "offsetElevation", angle(),
     "the same upward: -90deg points down", by_antenna},
    {"offset_bank_rad", NETSIM_MEMBER(AntennaConfig, offset.bank_rad), "offsetBank", angle(),
     "the same about the antenna's own x axis", by_antenna},
};

inline constexpr Schema AntennaConfig::schema{"antenna", "wlan[0].radio.antenna", true, antenna_fields,
                                              with_radios};

}  // namespace netsim
