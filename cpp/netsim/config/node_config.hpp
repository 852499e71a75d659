// One node: its name, where it starts, and the configurations of its parts. Used by the network to build a node.
#pragma once

#include <string>
#include <vector>

#include "netsim/config/computer_config.hpp"
#include "netsim/config/interface_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/wind_config.hpp"
#include "netsim/error.hpp"
#include "netsim/geometry/position.hpp"

namespace netsim {

inline constexpr int most_interfaces = 16;  // of a node

struct NodeConfig {
    // With one interface of each of these types, in that order, wlan[0] first; they set the defaults. Throws ConfigError
    // for a type that is none of interface_type_names.
    explicit NodeConfig(std::string node_name,
                        const std::vector<std::string>& interface_types = {std::string(ieee80211_interface)});

    std::string name;           // for people: "uavs[0]"; not empty
    Position initial_position;  // m, each coordinate within ±largest_coordinate_m
    std::vector<InterfaceConfig>
        wlan;  // 1 to most_interfaces; where there are radios, each on its own channel
    MobilityConfig mobility;
    WindConfig wind;  // where it flies
    ComputerConfig computer;

    // Throws ConfigError for the first field out of its range, here or in one of the parts: "radio.tx_power_w = …", if
    // there are several interfaces "wlan[1].radio.tx_power_w = …".
    void validate() const;
    // An error of one of its interfaces, so told.
    ConfigError error_of_interface(std::size_t index, const ConfigError& error) const;

private:
    void validate_interfaces() const;
};

}  // namespace netsim
