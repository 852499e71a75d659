// The kinds of network interface: values of `*.<node>.wlan[*].typename`. The kind chooses the MAC, and the defaults of
// the radio.
#pragma once

#include <string_view>

#include "netsim/config/field.hpp"

namespace netsim {

inline constexpr std::string_view ieee80211_interface = "Ieee80211Interface";
inline constexpr std::string_view ieee802154_interface = "Ieee802154NarrowbandInterface";

inline constexpr Model interface_models[] = {{ieee80211_interface, {"mac"}},
                                             {ieee802154_interface, {"csma"}}};
inline constexpr auto interface_type_names = names_of(interface_models);
inline constexpr ReadBy by_interface{"interface.typename", interface_models};

}  // namespace netsim
