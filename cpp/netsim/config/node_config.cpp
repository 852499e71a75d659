#include "netsim/config/node_config.hpp"

#include "netsim/config/check.hpp"
#include "netsim/error.hpp"

namespace netsim {

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
    radio.validate();
    mac.validate();
    mobility.validate();
}

}  // namespace netsim
