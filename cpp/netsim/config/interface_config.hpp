// One network interface of a node: settings `*.<node>.wlan[k].…` of an .ini file. The network builds a radio and the MAC
// above it from them.
#pragma once

#include <string>
#include <utility>

#include "netsim/config/csma_config.hpp"
#include "netsim/config/interface_type.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/config/radio_config.hpp"

namespace netsim {

struct InterfaceConfig {
    // Sets the defaults of that interface. Throws ConfigError if the name is not one of interface_type_names.
    explicit InterfaceConfig(std::string interface_type_name = std::string(ieee80211_interface))
        : type_name(std::move(interface_type_name)), radio(type_name) {}

    static const Schema schema;

    std::string type_name;  // `typename` in Python
    RadioConfig radio;
    MacConfig mac;    // of Ieee80211Interface only
    CsmaConfig csma;  // of Ieee802154NarrowbandInterface only

    // Throws ConfigError for the first field outside its range, in one of the parts: "radio.tx_power_w = …".
    void validate() const;
};

inline constexpr Field interface_fields[] = {
    {"typename", NETSIM_MEMBER(InterfaceConfig, type_name), "typename", one_of(interface_type_names),
     "Network interface: a station of 802.11, or a device of 802.15.4, whose radio has other defaults",
     ReadBy{}},
};

inline constexpr Schema InterfaceConfig::schema{"interface", "wlan[0]", true, interface_fields, with_radios};

}  // namespace netsim
