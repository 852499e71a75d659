// One node: its name, where it starts, and the configurations of its layers. Used by the network to build a
// node.
#pragma once

#include <string>
#include <utility>

#include "netsim/config/mac_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/radio_config.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

struct NodeConfig {
    explicit NodeConfig(std::string node_name) : name(std::move(node_name)) {}

    std::string name;           // for people: "uavs[0]"; not empty
    Position initial_position;  // m, each coordinate within ±largest_coordinate_m
    RadioConfig radio;
    MacConfig mac;
    MobilityConfig mobility;

    // Throws ConfigError for the first field out of its range, here or in one of the parts: "radio.tx_power_w
    // = …".
    void validate() const;
};

}  // namespace netsim
