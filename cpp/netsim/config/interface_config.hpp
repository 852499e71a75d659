// One network interface of a node: what `*.<node>.wlan[k].…` sets in an .ini file. Used by the network to build a radio
// and the MAC above it.
#pragma once

#include <string>
#include <utility>

#include "netsim/config/csma_config.hpp"
#include "netsim/config/interface_type.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/config/radio_config.hpp"

namespace netsim {

struct InterfaceConfig {
    // Sets the defaults of that interface. Throws ConfigError if it is none of interface_type_names.
    explicit InterfaceConfig(std::string interface_type_name = std::string(ieee80211_interface))
        : type_name(std::move(interface_type_name)), radio(type_name) {}

    static const Schema schema;

    std::string type_name;  // `typename` in Python
    RadioConfig radio;
    MacConfig mac;    // of Ieee80211Interface only
    CsmaConfig csma;  // of Ieee802154NarrowbandInterface only

    // Throws ConfigError for the first field out of its range, in one of the parts: "radio.tx_power_w = …".
    void validate() const;
};

}  // namespace netsim
