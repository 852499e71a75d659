#include "netsim/config/interface_config.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

namespace netsim {
namespace {

// A model of another modulation could only make up an answer.
void check_error_model(const std::string& interface_type, const std::string& error_model) {
    std::vector<std::string> fitting{RadioConfig(interface_type).error_model};
    if (interface_type == ieee80211_interface) {
        fitting.emplace_back(ber_table_error_model);
    }
    if (std::ranges::find(fitting, error_model) == fitting.end()) {
        std::string text = "radio.error_model = \"" + error_model + "\": expected \"" + fitting.front();
        for (std::size_t i = 1; i < fitting.size(); ++i) {
            text += "\" or \"" + fitting[i];
        }
        throw ConfigError(text + "\" for an " + interface_type);
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
