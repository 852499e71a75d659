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
        sensitivity_w = 1e-13;                 // -100 dBm
        energy_detection_w = 1e-12;            // -90 dBm
        snir_threshold = 0.15848931924611134;  // -8 dB
        error_model = "Ieee802154ErrorModel";
    }
}

void RadioConfig::validate() const {
    check_fields(*this);
    for (auto entry = tx_power_by_bitrate_w.begin(); entry != tx_power_by_bitrate_w.end(); ++entry) {
        if (std::ranges::find(tx_power_by_bitrate_w.begin(), entry, entry->first,
                              &PowersByBitrate::value_type::first) != entry) {
            throw ConfigError({"radio.tx_power_by_bitrate_w",
                               Quantity{entry->first, "bps"},
                               {"expected one power for this bit rate"}});
        }
    }
    check_at_most("radio.bandwidth_hz", bandwidth_hz, "radio.carrier_hz", carrier_hz, "Hz");
    antenna.validate(carrier_hz);
}

double tx_power_w(double bitrate_bps, double usual_w, const PowersByBitrate& by_bitrate_w) {
    const auto found = std::ranges::find(by_bitrate_w, bitrate_bps, &PowersByBitrate::value_type::first);
    return found == by_bitrate_w.end() ? usual_w : found->second;
}

}  // namespace netsim
