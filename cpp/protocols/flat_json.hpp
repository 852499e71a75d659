// JSON objects whose values are integers, booleans and strings without escapes: the messages of
// ZigZag.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace netsim {

using FlatJsonValue = std::variant<bool, std::int64_t, std::string>;
using FlatJson = std::map<std::string, FlatJsonValue, std::less<>>;

// Returns nullopt for any other string.
std::optional<FlatJson> parse_flat_json(std::string_view text);

}  // namespace netsim
