#include "protocols/parameter.hpp"

#include <algorithm>
#include <cstddef>

#include "netsim/config/check.hpp"
#include "netsim/config/nearest_name.hpp"
#include "netsim/error.hpp"

namespace netsim {

void refuse_unknown_parameter(std::string_view protocol, std::string_view parameter,
                              const std::vector<std::string_view>& names) {
    std::string text = "`" + std::string(parameter) + "` is not a parameter of " + std::string(protocol);
    text += names.empty() ? ", which has none"
                          : "; did you mean `" + std::string(nearest_name(parameter, names)) + "`?";
    throw ConfigError(text);
}

void refuse_kind_of_parameter(std::string_view parameter, const ParameterValue& expected) {
    constexpr std::string_view kinds[] = {"true or false", "an integer", "a number"};
    throw ConfigError(
        {"protocol." + std::string(parameter), "", {"expected " + std::string(kinds[expected.index()])}});
}

void check_payload_bytes(Node& node, std::int64_t payload_bytes) {
    constexpr std::size_t longest_in_udp_bytes = 65'507;
    const std::size_t longest_bytes = std::min(node.longest_message_bytes(), longest_in_udp_bytes);
    if (payload_bytes < 0 || static_cast<std::size_t>(payload_bytes) > longest_bytes) {
        throw ConfigError(
            {"protocol.payload_bytes",
             Quantity{static_cast<double>(payload_bytes), "B"},
             {"expected from ", Quantity{0, "B"}, " to ", Quantity{static_cast<double>(longest_bytes), "B"},
              ", the longest message of " + node.name() +
                  " (what its wlan[0] takes, less IPv4 and UDP headers)"}});
    }
}

void check_node_id(const Node& node, std::string_view field, std::int64_t id) {
    if (id < 0 || id >= node.node_count()) {
        throw ConfigError(
            {std::string(field),
             Quantity{static_cast<double>(id), ""},
             {"expected the id of a node, from 0 to " + std::to_string(node.node_count() - 1)}});
    }
}

void check_other_node_id(const Node& node, std::string_view field, std::int64_t id) {
    check_node_id(node, field, id);
    if (id == node.id()) {
        throw ConfigError(
            {std::string(field),
             Quantity{static_cast<double>(id), ""},
             {"expected the id of another node than " + node.name() + " itself" +
              (node.node_count() == 1 ? ", but there is no other"
                                      : ", from 0 to " + std::to_string(node.node_count() - 1))}});
    }
}

void check_can_move(const Node& node, std::string_view protocol) {
    if (!node.can_move()) {
        throw ConfigError({.field = "mobility.typename",
                           .message = {"expected \"MasslessMobility\" for " + node.name() + ", as " +
                                       std::string(protocol) + " flies"}});
    }
}

}  // namespace netsim
