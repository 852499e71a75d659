#include "netsim/config/antenna_config.hpp"

#include <numbers>

#include "netsim/config/check.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

constexpr std::array constant_gain{antenna_type_names[1]};
constexpr std::array dipole{antenna_type_names[2]};
constexpr std::array beams{antenna_type_names[3], antenna_type_names[4]};
constexpr std::array parabolic{antenna_type_names[4]};
constexpr std::array directed{antenna_type_names[2], antenna_type_names[3], antenna_type_names[4]};

constexpr ReadBy with_constant_gain{"antenna.typename", constant_gain, constant_gain[0]};
constexpr ReadBy with_dipole{"antenna.typename", dipole, dipole[0]};
constexpr ReadBy with_beam{"antenna.typename", beams, "CosineAntenna, ParabolicAntenna"};
constexpr ReadBy with_parabolic{"antenna.typename", parabolic, parabolic[0]};
constexpr ReadBy with_direction{"antenna.typename", directed, ""};

constexpr double widest_beam_rad = 1.999 * std::numbers::pi;  // at 2π the exponent of the cosine would be 0

constexpr Field fields[] = {
    {"typename", &member<&AntennaConfig::type_name>, "typename", one_of(antenna_type_names),
     "In which directions the antenna sends and receives"},
    {NETSIM_FIELD(AntennaConfig, gain), "gain", ratio(), "gain in all directions", with_constant_gain},
    {NETSIM_FIELD(AntennaConfig, max_gain), "maxGain", ratio(), "gain along the boresight, its x axis",
     with_beam},
    {NETSIM_FIELD(AntennaConfig, min_gain), "minGain", ratio(), "gain outside of the beam", with_parabolic},
    {NETSIM_FIELD(AntennaConfig, beam_width_rad), "beamWidth",
     angle().above(0).at_most(widest_beam_rad).or_special(0, "not set"),
     "angle between the directions of half the power", with_beam, true},
    {NETSIM_FIELD(AntennaConfig, wire_axis), "wireAxis", one_of(wire_axis_names), "axis along which it lies",
     with_dipole},
    {NETSIM_FIELD(AntennaConfig, length_m), "length", quantity("m").at_least(0),
     "from end to end, at most one wavelength; 0m: much shorter than the wave", with_dipole},
    {"offset_heading_rad", &member<&AntennaConfig::offset, &EulerAngles::heading_rad>, "offsetHeading",
     angle(), "How the antenna is turned on the node: from the node's x axis to its y axis", with_direction},
    {"offset_elevation_rad", &member<&AntennaConfig::offset, &EulerAngles::elevation_rad>, "offsetElevation",
     angle(), "The same upward: -90deg points down", with_direction},
    {"offset_bank_rad", &member<&AntennaConfig::offset, &EulerAngles::bank_rad>, "offsetBank", angle(),
     "The same about the antenna's own x axis", with_direction},
};

}  // namespace

const Schema AntennaConfig::schema{"antenna", "wlan[0].radio.antenna", true, fields, with_radios};

void AntennaConfig::validate(double carrier_hz) const {
    check_fields(*this);
    if (type_name == "ParabolicAntenna") {
        check_at_most("antenna.min_gain", min_gain, "antenna.max_gain", max_gain);
    }
    const bool has_beam = type_name == "CosineAntenna" || type_name == "ParabolicAntenna";
    if (has_beam && beam_width_rad == 0) {
        throw ConfigError({"antenna.beam_width_rad",
                           Quantity{beam_width_rad, "rad"},
                           {"expected more than ", Quantity{0, "rad"}},
                           {"antenna.typename"}});
    }
    const double wavelength_m = speed_of_light_mps / carrier_hz;
    if (length_m > wavelength_m) {
        throw ConfigError({"antenna.length_m",
                           Quantity{length_m, "m"},
                           {"expected at most the wavelength, ", Quantity{wavelength_m, "m"}},
                           {"radio.carrier_hz"}});
    }
}

}  // namespace netsim
