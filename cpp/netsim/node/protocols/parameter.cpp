#include "netsim/node/protocols/parameter.hpp"

#include <algorithm>
#include <cstddef>

#include "netsim/config/check.hpp"
#include "netsim/config/nearest_name.hpp"
#include "netsim/error.hpp"

namespace netsim {

void refuse_unknown_parameter(std::string_view protocol, std::string_view parameter,
                              const std::vector<std::string_view>& names) {
    std::string text = "`" + std::string(parameter) + "` is no parameter of " + std::string(protocol);
    text += names.empty() ? ", which has none"
                          : "; did you mean `" + std::string(nearest_name(parameter, names)) + "`?";
    throw ConfigError(text);
}

void refuse_kind_of_parameter(std::string_view parameter, const ParameterValue& expected) {
    constexpr std::string_view kinds[] = {"true or false", "a whole number", "a number"};
    throw ConfigError("protocol." + std::string(parameter) + ": expected " +
                      std::string(kinds[expected.index()]));
}

void check_payload_bytes(Node& node, std::int64_t payload_bytes) {
    constexpr std::size_t longest_in_udp_bytes = 65'507;
    const std::size_t longest_bytes = std::min(node.longest_message_bytes(), longest_in_udp_bytes);
    try {
        check_between("protocol.payload_bytes", static_cast<double>(payload_bytes), 0,
                      static_cast<double>(longest_bytes), "B");
    } catch (const ConfigError& error) {
        throw ConfigError(std::string(error.what()) + ", the longest message of " + node.name() +
                          " (what its wlan[0] takes, less IPv4 and UDP headers)");
    }
}

}  // namespace netsim
