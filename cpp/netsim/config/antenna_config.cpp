#include "netsim/config/antenna_config.hpp"

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"
#include "netsim/units.hpp"

namespace netsim {

void AntennaConfig::validate(double carrier_hz) const {
    check_fields(*this);
    const Model& type = model_named(type_name, antenna_models);
    if (type.does_read("min_gain")) {
        check_at_most("antenna.min_gain", min_gain, "antenna.max_gain", max_gain);
    }
    if (type.does_read("beam_width_rad") && beam_width_rad == 0) {
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
