#include "netsim/config/interface_config.hpp"

#include "netsim/config/medium_config.hpp"

namespace netsim {
namespace {

constexpr Field fields[] = {
    {"typename", &member<&InterfaceConfig::type_name>, "typename", one_of(interface_type_names),
     "Network interface: a station of 802.11, or a device of 802.15.4, whose radio has other defaults"},
};

// An error model fits one modulation only.
void check_error_model(const std::string& interface_type, const std::string& error_model) {
    const std::string own = RadioConfig(interface_type).error_model;
    const bool is_80211 = interface_type == ieee80211_interface;
    if (error_model == own || (is_80211 && error_model == ber_table_error_model)) {
        return;
    }
    std::string expected = "expected \"" + own;
    if (is_80211) {
        expected.append("\" or \"").append(ber_table_error_model);
    }
    throw ConfigError({"radio.error_model",
                       "\"" + error_model + "\"",
                       {expected + "\" for an " + interface_type},
                       {"interface.typename"}});
}

}  // namespace

const Schema InterfaceConfig::schema{"interface", "wlan[0]", true, fields, with_radios};

void InterfaceConfig::validate() const {
    check_fields(*this);
    radio.validate();
    check_error_model(type_name, radio.error_model);
    mac.validate();
    csma.validate();
}

}  // namespace netsim
