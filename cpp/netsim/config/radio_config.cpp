#include "netsim/config/radio_config.hpp"

#include <algorithm>

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
    constexpr double lowest_carrier_hz = 1e6;
    constexpr double highest_carrier_hz = 1e12;
    constexpr double narrowest_hz = 1e3;
    constexpr double widest_hz = 1e9;
    check_between("radio.carrier_hz", carrier_hz, lowest_carrier_hz, highest_carrier_hz, "Hz");
    check_between("radio.bandwidth_hz", bandwidth_hz, narrowest_hz, std::min(widest_hz, carrier_hz), "Hz");
    check_between("radio.tx_power_w", tx_power_w, 0, largest_tx_power_w, "W");
    check_at_least("radio.communication_range_m", communication_range_m, 0, "m");
    check_greater("radio.sensitivity_w", sensitivity_w, 0, "W");
    check_greater("radio.energy_detection_w", energy_detection_w, 0, "W");
    check_at_least("radio.snir_threshold", snir_threshold, 0, "");
    check_name("radio.error_model", error_model, error_model_names);
    antenna.validate(carrier_hz);
    check_at_least("radio.noise_figure", noise_figure, 1, "");
    check_name("radio.snir_mode", snir_mode, snir_mode_names);
    check_name("radio.preamble_detection", preamble_detection, preamble_detection_names);
    check_at_least("radio.preamble_threshold", preamble_threshold, 0, "");
    check_at_least("radio.preamble_minimum_power_w", preamble_minimum_power_w, 0, "W");
    check_between("radio.preamble_duration_s", preamble_duration_s, 1e-12, 1, "s");
    check_name("radio.frame_capture", frame_capture, frame_capture_names);
    check_at_least("radio.capture_margin", capture_margin, 1, "");
    check_between("radio.capture_window_s", capture_window_s, 0, 1, "s");
}

}  // namespace netsim
