#include "netsim/config/schema_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "netsim/config/computer_config.hpp"
#include "netsim/config/interface_config.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/obstacle_config.hpp"
#include "netsim/config/wind_config.hpp"
#include "netsim/error.hpp"

namespace netsim {
namespace {

std::string json(std::string_view text) {
    std::string quoted = "\"";
    for (const char character : text) {
        quoted.append(character == '"' || character == '\\' ? "\\" : "").push_back(character);
    }
    return quoted + "\"";
}
std::string json(bool value) {
    return value ? "true" : "false";
}
std::string json(int value) {
    return std::to_string(value);
}
// Python reads a number without a point or an exponent as an integer.
std::string json(double value) {
    const std::string text = text_of(value);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

template <typename Values, typename Text>
std::string joined(const Values& values, Text text) {
    std::string list;
    for (const auto& value : values) {
        list.append(list.empty() ? "" : ", ").append(text(value));
    }
    return list;
}

std::string json(const Bitrates& bitrates_bps) {
    return "[" + joined(bitrates_bps, [](double bitrate_bps) { return json(bitrate_bps); }) + "]";
}
std::string json(const PowersByBitrate& powers) {
    const auto pair = [](const auto& entry) {
        return "[" + json(entry.first) + ", " + json(entry.second) + "]";
    };
    return "[" + joined(powers, pair) + "]";
}

// Its members are JSON already.
std::string object(const std::vector<std::pair<std::string_view, std::string>>& members) {
    const auto member = [](const auto& entry) { return json(entry.first) + ": " + entry.second; };
    return "{" + joined(members, member) + "}";
}

std::string names_row(const std::vector<std::string_view>& names) {
    return "[" + joined(names, [](std::string_view name) { return json(name); }) + "]";
}

std::string type_row(const Field& field) {
    constexpr std::array kinds{"quantity", "level", "ratio", "number",   "integer",          "bytes",
                               "boolean",  "name",  "file",  "bitrates", "powers_by_bitrate"};
    const ValueType& type = field.type;
    std::vector<std::pair<std::string_view, std::string>> row{
        {"kind", json(std::string_view(kinds[static_cast<std::size_t>(type.kind)]))}};
    if (!type.unit.empty()) {
        row.emplace_back("unit", json(type.unit));
    }
    if (!type.shown.empty()) {
        row.emplace_back("shown", json(type.shown));
    }
    if (type.is_number()) {
        if (std::isfinite(type.least)) {
            row.emplace_back(type.excludes_least ? "above" : "at_least", json(type.least));
        }
        if (std::isfinite(type.most)) {
            row.emplace_back("at_most", json(type.most));
        }
        if (type.special && !field.must_be_set) {
            row.emplace_back("special", json(*type.special));
        }
    }
    if (type.kind == ValueType::Kind::name) {
        row.emplace_back("names", names_row({type.names.begin(), type.names.end()}));
    }
    return object(row);
}

std::string read_by_row(const Schema& schema, const Field& field) {
    const std::string_view chosen_by = schema.family(field).chosen_by;
    return chosen_by.empty() ? "null"
                             : object({{"chosen_by", json(chosen_by)},
                                       {"names", names_row(schema.readers(field))},
                                       {"shown", json(schema.readers_shown(field))}});
}

// {effect: names of the path losses with it}.
std::string effects_row() {
    constexpr std::pair<Model::Effect, std::string_view> effects[] = {{Model::Effect::ground, "ground"},
                                                                      {Model::Effect::shadowing, "shadowing"},
                                                                      {Model::Effect::fading, "fading"}};
    std::vector<std::pair<std::string_view, std::string>> row;
    for (const auto& [effect, name] : effects) {
        std::vector<std::string_view> names;
        for (const Model& model : path_losses) {
            if (model.effect == effect) {
                names.push_back(model.name);
            }
        }
        row.emplace_back(name, names_row(names));
    }
    return object(row);
}

// A configuration with the defaults of one interface.
struct Variant {
    explicit Variant(std::string_view interface_type, std::string_view medium_type)
        : interface{std::string(interface_type)}, medium{std::string(medium_type)} {}

    const void* of(const Schema& schema) const {
        const std::pair<const Schema*, const void*> parts[] = {
            {&InterfaceConfig::schema, &interface}, {&MacConfig::schema, &interface.mac},
            {&CsmaConfig::schema, &interface.csma}, {&RadioConfig::schema, &interface.radio},
            {&MediumConfig::schema, &medium},       {&AntennaConfig::schema, &interface.radio.antenna},
            {&MobilityConfig::schema, &mobility},   {&ComputerConfig::schema, &computer},
            {&ObstacleConfig::schema, &obstacle},   {&WindConfig::schema, &wind},
        };
        return std::ranges::find(parts, &schema, &std::pair<const Schema*, const void*>::first)->second;
    }

    InterfaceConfig interface;
    MediumConfig medium;
    MobilityConfig mobility;
    ComputerConfig computer;
    ObstacleConfig obstacle;
    WindConfig wind;
};

// {name of the variant: default of the field}; "" is the standard variant.
std::string defaults_row(const Schema& schema, const Field& field) {
    static const Variant usual(ieee80211_interface, ieee80211_scalar_medium);
    static const Variant narrowband(ieee802154_interface, ieee802154_scalar_medium);
    const auto default_of = [&](const Variant& variant) {
        return std::visit([](const auto* value) { return json(*value); }, field.of(variant.of(schema)));
    };
    if (field.must_be_set) {
        return "{}";
    }
    const bool has_variants = schema.path.starts_with("wlan") || &schema == &MediumConfig::schema;
    return has_variants ? object({{"", default_of(usual)}, {"802.15.4", default_of(narrowband)}})
                        : object({{"", default_of(usual)}});
}

std::string field_row(const Schema& schema, const Field& field) {
    const std::string key = field.key.empty() ? "" : std::string(schema.path) + "." + std::string(field.key);
    std::vector<std::pair<std::string_view, std::string>> row{
        {"target", json(schema.full_name(field))},
        {"key", json(key)},
        {"of", json(std::string_view(schema.is_of_node ? "node" : "network"))},
        {"type", type_row(field)},
        {"meaning", json(field.meaning)},
        {"read_by", read_by_row(schema, field)}};
    if (schema.full_name(field) == by_path_loss.chosen_by) {
        row.emplace_back("effects", effects_row());
    }
    row.emplace_back("defaults", defaults_row(schema, field));
    return object(row);
}

}  // namespace

std::string schema_json() {
    std::vector<std::string> rows;
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            rows.push_back(field_row(*schema, field));
        }
    }
    return "[" + joined(rows, [](const std::string& row) { return row; }) + "]";
}

}  // namespace netsim
