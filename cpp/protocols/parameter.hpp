// The parameters of native protocols: fields of a plain struct, each with name, unit and meaning.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "netsim/node/node.hpp"
#include "netsim/node/protocol.hpp"

namespace netsim {

// The alternatives are the valid parameter types.
using ParameterValue = std::variant<bool, std::int64_t, double>;

struct Parameter {
    std::string_view name;  // as in the equivalent Python class
    ParameterValue default_value;
    std::string_view unit;  // SI; "" for a plain number, "B" for a size in bytes
    std::string_view meaning;
};

// Values by name. Other parameters have their defaults. An integer is accepted for a double.
using Parameters = std::map<std::string, ParameterValue, std::less<>>;

// One row of the table of native protocols.
struct NativeProtocol {
    std::string_view name;
    std::string_view meaning;
    std::string_view python_class;  // the equivalent "file.py:Class" in examples/, or ""
    std::vector<Parameter> parameters;
    // Creates the protocol of one node. Throws ConfigError for an unknown parameter, and for a value
    // of the wrong type or out of range.
    std::function<std::unique_ptr<Protocol>(Node&, const Parameters&)> make;
};

// A field of the struct `Config` with its name.
template <typename Config>
struct ParameterField {
    std::string_view name;
    std::variant<bool Config::*, std::int64_t Config::*, double Config::*> member;
    std::string_view unit;
    std::string_view meaning;
};

[[noreturn]] void refuse_unknown_parameter(std::string_view protocol, std::string_view parameter,
                                           const std::vector<std::string_view>& names);
[[noreturn]] void refuse_kind_of_parameter(std::string_view parameter, const ParameterValue& expected);

// Checks a message size: from 0 to the limit of the node's wlan[0], and at most 65,507 B (the
// largest UDP payload).
void check_payload_bytes(Node& node, std::int64_t payload_bytes);

// Check that `id` is a node of the network, and in the second case not `node` itself.
void check_node_id(const Node& node, std::string_view field, std::int64_t id);
void check_other_node_id(const Node& node, std::string_view field, std::int64_t id);

// For a protocol that moves its node: rejects a mobility model that takes no commands.
void check_can_move(const Node& node, std::string_view protocol);

// A row for the class `Type`, which is constructed from a Node and a Config. `Config` has defaults
// and validate(). A field `payload_bytes` is checked by the function above, since its limit depends
// on the node.
template <typename Type, typename Config>
NativeProtocol native_protocol(std::string_view name, std::string_view meaning, std::string_view python_class,
                               std::vector<ParameterField<Config>> fields) {
    NativeProtocol row{name, meaning, python_class, {}, {}};
    for (const ParameterField<Config>& field : fields) {
        const ParameterValue value =
            std::visit([](auto member) { return ParameterValue(Config().*member); }, field.member);
        row.parameters.push_back({field.name, value, field.unit, field.meaning});
    }
    row.make = [name, fields = std::move(fields)](Node& node, const Parameters& given) {
        Config config;
        std::vector<std::string_view> names;
        std::size_t used = 0;
        for (const ParameterField<Config>& field : fields) {
            names.push_back(field.name);
            const auto found = given.find(field.name);
            if (found == given.end()) {
                continue;
            }
            ++used;
            std::visit(
                [&](auto member) {
                    using Value = std::remove_reference_t<decltype(config.*member)>;
                    const auto* whole = std::get_if<std::int64_t>(&found->second);
                    if (const Value* value = std::get_if<Value>(&found->second)) {
                        config.*member = *value;
                    } else if (std::is_same_v<Value, double> && whole != nullptr) {
                        config.*member = static_cast<Value>(*whole);
                    } else {
                        refuse_kind_of_parameter(field.name, ParameterValue(config.*member));
                    }
                },
                field.member);
        }
        if (used != given.size()) {
            for (const auto& [parameter, value] : given) {
                if (std::find(names.begin(), names.end(), parameter) == names.end()) {
                    refuse_unknown_parameter(name, parameter, names);
                }
            }
        }
        config.validate();
        if constexpr (requires { config.payload_bytes; }) {
            check_payload_bytes(node, config.payload_bytes);
        }
        return std::make_unique<Type>(node, config);
    };
    return row;
}

}  // namespace netsim
