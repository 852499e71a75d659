#include "netsim/config/radio_config.hpp"

#include "netsim/config/check.hpp"

namespace netsim {

void RadioConfig::validate() const {
    check_greater("radio.carrier_hz", carrier_hz, 0, "Hz");
    check_greater("radio.bandwidth_hz", bandwidth_hz, 0, "Hz");
    check_at_least("radio.tx_power_w", tx_power_w, 0, "W");
    check_at_least("radio.communication_range_m", communication_range_m, 0, "m");
    check_greater("radio.sensitivity_w", sensitivity_w, 0, "W");
    check_greater("radio.energy_detection_w", energy_detection_w, 0, "W");
    check_at_least("radio.snir_threshold", snir_threshold, 0, "");
    check_name("radio.error_model", error_model, error_model_names);
    check_name("radio.antenna", antenna, antenna_names);
}

}  // namespace netsim
