// One node: its name, where it starts, and the configurations of its layers. Used by the network to build a
// node.
#pragma once

#include <string>
#include <utility>

#include "netsim/config/csma_config.hpp"
#include "netsim/config/interface_type.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/radio_config.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

struct NodeConfig {
    // Sets the defaults of that interface. Throws ConfigError if it is none of interface_type_names.
    explicit NodeConfig(std::string node_name,
                        std::string interface_type_name = std::string(ieee80211_interface))
        : name(std::move(node_name)), interface_type(std::move(interface_type_name)), radio(interface_type) {}

    std::string name;            // for people: "uavs[0]"; not empty
    std::string interface_type;  // `interface` in Python; one of interface_type_names
    Position initial_position;   // m, each coordinate within ±largest_coordinate_m
    RadioConfig radio;
    MacConfig mac;    // of Ieee80211Interface only
    CsmaConfig csma;  // of Ieee802154NarrowbandInterface only
    MobilityConfig mobility;

    // Throws ConfigError for the first field out of its range, here or in one of the parts: "radio.tx_power_w
    // = …".
    void validate() const;
};

}  // namespace netsim
