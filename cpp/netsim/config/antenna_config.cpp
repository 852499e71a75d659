#include "netsim/config/antenna_config.hpp"

#include <numbers>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"

namespace netsim {

void AntennaConfig::validate(double carrier_hz) const {
    check_name("antenna.typename", type_name, antenna_type_names);
    check_at_least("antenna.gain", gain, 0, "");
    check_at_least("antenna.max_gain", max_gain, 0, "");
    if (type_name == "ParabolicAntenna") {
        check_at_least("antenna.min_gain", min_gain, 0, "");
        if (!(min_gain <= max_gain)) {
            throw ConfigError("antenna.min_gain = " + text_of(min_gain) +
                              ": expected at most antenna.max_gain, " + text_of(max_gain));
        }
    }
    if (type_name == "CosineAntenna" || type_name == "ParabolicAntenna") {
        check_greater("antenna.beam_width_rad", beam_width_rad, 0, "rad");
        // At 2π the exponent of the cosine would be 0.
        check_between("antenna.beam_width_rad", beam_width_rad, 0, 1.999 * std::numbers::pi, "rad");
    }
    check_name("antenna.wire_axis", wire_axis, wire_axis_names);
    check_between("antenna.length_m", length_m, 0, speed_of_light_mps / carrier_hz, "m");
    check_finite("antenna.offset_heading_rad", offset.heading_rad, "rad");
    check_finite("antenna.offset_elevation_rad", offset.elevation_rad, "rad");
    check_finite("antenna.offset_bank_rad", offset.bank_rad, "rad");
}

}  // namespace netsim
