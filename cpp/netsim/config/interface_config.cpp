#include "netsim/config/interface_config.hpp"

namespace netsim {
namespace {

// An error model fits one modulation only. No errors fit all.
void check_error_model(const std::string& interface_type, const std::string& error_model) {
    const bool is_80211 = error_model.starts_with("Ieee80211");
    if (error_model.empty() || is_80211 == (interface_type == ieee80211_interface)) {
        return;
    }
    throw ConfigError({"radio.error_model",
                       "\"" + error_model + "\"",
                       {"expected one for an " + interface_type + ", such as \"" +
                        RadioConfig(interface_type).error_model + "\""},
                       {"interface.typename"}});
}

// The bit rates of all operation modes are for channels of 20 MHz (OFDM: IEEE Std 802.11-2020, table 17-4) or 22 MHz
// (DSSS: clause 15, twice its 11 Mchip/s). Channels of other widths have other bit rates.
void check_bandwidth(const InterfaceConfig& config) {
    constexpr double narrowest_hz = 20e6;
    constexpr double widest_hz = 22e6;
    const double bandwidth_hz = config.radio.bandwidth_hz;
    if (config.type_name == ieee80211_interface &&
        (bandwidth_hz < narrowest_hz || bandwidth_hz > widest_hz)) {
        throw ConfigError({"radio.bandwidth_hz",
                           Quantity{bandwidth_hz, "Hz"},
                           {"expected from ", Quantity{narrowest_hz, "Hz"}, " to ", Quantity{widest_hz, "Hz"},
                            " for the operation mode " + config.mac.op_mode},
                           {"interface.typename"}});
    }
}

}  // namespace

void InterfaceConfig::validate() const {
    check_fields(*this);
    radio.validate();
    check_error_model(type_name, radio.error_model);
    check_bandwidth(*this);
    mac.validate();
    csma.validate();
}

}  // namespace netsim
