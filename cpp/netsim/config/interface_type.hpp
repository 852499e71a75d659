// The kinds of network interface: values of `*.<node>.wlan[*].typename`. The kind chooses the MAC, and the defaults of
// the radio.
#pragma once

#include <array>
#include <string_view>

#include "netsim/config/field.hpp"

namespace netsim {

inline constexpr std::string_view ieee80211_interface = "Ieee80211Interface";
inline constexpr std::string_view ieee802154_interface = "Ieee802154NarrowbandInterface";

inline constexpr std::array interface_type_names{ieee80211_interface, ieee802154_interface};

inline constexpr ReadBy with_ieee80211{"interface.typename", std::span(interface_type_names).first(1), ""};
inline constexpr ReadBy with_ieee802154{"interface.typename", std::span(interface_type_names).last(1),
                                        "802.15.4"};

}  // namespace netsim
