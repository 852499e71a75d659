#include "netsim/config/interface_config.hpp"

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

namespace netsim {
namespace {

// A model of another modulation could only make up an answer.
void check_error_model(const std::string& interface_type, const std::string& error_model) {
    const std::string fitting = RadioConfig(interface_type).error_model;
    const bool fits = interface_type == ieee80211_interface
                          ? error_model == fitting || error_model == ber_table_error_model
                          : error_model == fitting;
    if (!fits) {
        throw ConfigError("radio.error_model = \"" + error_model + "\": expected \"" + fitting +
                          "\", the one for an " + interface_type);
    }
}

}  // namespace

void InterfaceConfig::validate() const {
    check_name("interface.typename", type_name, interface_type_names);
    radio.validate();
    check_error_model(type_name, radio.error_model);
    mac.validate();
    csma.validate();
}

}  // namespace netsim
