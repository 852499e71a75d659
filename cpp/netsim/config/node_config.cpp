#include "netsim/config/node_config.hpp"

#include <utility>

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

namespace netsim {

NodeConfig::NodeConfig(std::string node_name, const std::vector<std::string>& interface_types)
    : name(std::move(node_name)), wlan(interface_types.begin(), interface_types.end()) {}

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
    validate_interfaces();
    mobility.validate();
    wind.validate();
    computer.validate();
}

void NodeConfig::validate_interfaces() const {
    if (wlan.empty() || wlan.size() > most_interfaces) {
        throw ConfigError("node.wlan: " + std::to_string(wlan.size()) + " interfaces; expected 1 to " +
                          std::to_string(most_interfaces));
    }
    for (std::size_t index = 0; index < wlan.size(); ++index) {
        try {
            wlan[index].validate();
        } catch (const ConfigError& error) {
            throw error_of_interface(index, error);
        }
    }
}

ConfigError NodeConfig::error_of_interface(std::size_t index, const ConfigError& error) const {
    if (wlan.size() == 1 || error.problem() == nullptr) {
        return error;
    }
    Problem problem = *error.problem();
    problem.interface = static_cast<int>(index);
    return ConfigError(std::move(problem));
}

}  // namespace netsim
