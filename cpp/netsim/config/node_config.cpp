#include "netsim/config/node_config.hpp"

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
                          "\", the one for a node with an " + interface_type);
    }
}

}  // namespace

void NodeConfig::validate() const {
    if (name.empty()) {
        throw ConfigError("node.name = \"\": expected a name that is not empty");
    }
    check_between("node.initial_position.x", initial_position.x, -largest_coordinate_m, largest_coordinate_m,
                  "m");
    check_between("node.initial_position.y", initial_position.y, -largest_coordinate_m, largest_coordinate_m,
                  "m");
    check_between("node.initial_position.z", initial_position.z, -largest_coordinate_m, largest_coordinate_m,
                  "m");
    check_name("interface", interface_type, interface_type_names);
    radio.validate();
    check_error_model(interface_type, radio.error_model);
    mac.validate();
    csma.validate();
    mobility.validate();
}

}  // namespace netsim
