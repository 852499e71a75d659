// What a full transmit queue does with a message.
#pragma once

#include <array>
#include <string_view>

namespace netsim {

inline constexpr std::string_view drop_when_full = "drop";
inline constexpr std::string_view block_when_full = "block";  // it waits in front of the queue
inline constexpr std::array<std::string_view, 2> when_full_names{drop_when_full, block_when_full};

}  // namespace netsim
