#include "netsim/config/radio_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

RadioConfig::RadioConfig(std::string_view interface_type_name) {
    check_name("interface", interface_type_name, interface_type_names);
    if (interface_type_name == ieee802154_interface) {
        carrier_hz = 2.45e9;
        bandwidth_hz = 2.8e6;
        tx_power_w = 0.00224;
        sensitivity_w = 1e-13;
        energy_detection_w = 1e-12;
        snir_threshold = 0.15848931924611134;
        error_model = "Ieee802154ErrorModel";
    }
}

void RadioConfig::validate() const {
    check_greater("radio.carrier_hz", carrier_hz, 0, "Hz");
    check_greater("radio.bandwidth_hz", bandwidth_hz, 0, "Hz");
    check_at_least("radio.tx_power_w", tx_power_w, 0, "W");
    check_at_least("radio.communication_range_m", communication_range_m, 0, "m");
    check_greater("radio.sensitivity_w", sensitivity_w, 0, "W");
    check_greater("radio.energy_detection_w", energy_detection_w, 0, "W");
    check_at_least("radio.snir_threshold", snir_threshold, 0, "");
    check_name("radio.error_model", error_model, error_model_names);
    antenna.validate(carrier_hz);
}

}  // namespace netsim
