#include "netsim/config/field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "netsim/config/antenna_config.hpp"
#include "netsim/config/computer_config.hpp"
#include "netsim/config/csma_config.hpp"
#include "netsim/config/interface_config.hpp"
#include "netsim/config/mac_config.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/nearest_name.hpp"
#include "netsim/config/obstacle_config.hpp"
#include "netsim/config/radio_config.hpp"
#include "netsim/config/wind_config.hpp"

namespace netsim {
namespace {

std::vector<MessagePart> expectation(const ValueType& type) {
    const Quantity least{type.least, type.unit};
    const Quantity most{type.most, type.unit};
    std::vector<MessagePart> parts{"expected "};
    if (type.special) {
        parts.insert(parts.end(),
                     {Quantity{*type.special, type.unit},
                      type.special_meaning.empty() ? std::string(" or ")
                                                   : " (" + std::string(type.special_meaning) + ") or "});
    }
    const bool has_most = std::isfinite(type.most);
    if (!std::isfinite(type.least)) {
        parts.emplace_back("a finite number");
    } else if (type.excludes_least) {
        parts.insert(parts.end(), {"more than ", least});
        if (has_most) {
            parts.insert(parts.end(), {" and at most ", most});
        }
    } else if (has_most) {
        parts.insert(parts.end(), {"from ", least, " to ", most});
    } else {
        parts.insert(parts.end(), {"at least ", least});
    }
    return parts;
}

std::string expected_name(std::string_view value, std::span<const std::string_view> names) {
    std::string expected;
    std::vector<std::string_view> candidates;
    for (const std::string_view name : names) {
        expected.append(expected.empty() ? "" : ", ").append(name.empty() ? "\"\" (none)" : name);
        if (!name.empty()) {  // an empty name is not a misspelling
            candidates.push_back(name);
        }
    }
    if (names.size() > 1) {
        expected.insert(0, "one of ")
            .append("; did you mean ")
            .append(nearest_name(value, candidates))
            .append("?");
    }
    return "expected " + expected;
}

}  // namespace

bool ValueType::contains(double value) const {
    if (special == value) {
        return true;
    }
    return std::isfinite(value) && (excludes_least ? value > least : value >= least) && value <= most;
}

std::string Schema::full_name(const Field& field) const {
    return std::string(name).append(".").append(field.name);
}

std::vector<std::string_view> Schema::readers(const Field& field) const {
    const std::string_view read = field.read_by ? field.name : name;
    std::vector<std::string_view> names;
    for (const Model& model : family(field).models) {
        if (model.does_read(read) || model.does_read(full_name(field))) {
            names.push_back(model.name);
        }
    }
    return names;
}

std::string Schema::readers_shown(const Field& field) const {
    if (!field.read_by) {
        return std::string(shown);
    }
    std::vector<std::string_view> names = readers(field);
    std::vector<std::string_view> others;
    for (const Model& model : field.read_by->models) {
        if (!model.name.empty() && std::ranges::find(names, model.name) == names.end()) {
            others.push_back(model.name);
        }
    }
    std::string text = shown.empty() || names.empty() ? std::string(shown) : std::string(shown) + ", ";
    if (!others.empty() && others.size() + 1 < names.size()) {
        text += "All but ";
        names = others;
    }
    for (const std::string_view model : names) {
        text.append(model == names.front() ? "" : ", ").append(model);
    }
    return text;
}

std::span<const Schema* const> all_schemas() {
    static constexpr std::array schemas{
        &MobilityConfig::schema, &ComputerConfig::schema, &InterfaceConfig::schema, &MacConfig::schema,
        &CsmaConfig::schema,     &RadioConfig::schema,    &AntennaConfig::schema,   &MediumConfig::schema,
        &ObstacleConfig::schema, &WindConfig::schema,
    };
    return schemas;
}

void check_value(std::string_view field, double value, const ValueType& type) {
    if (!type.contains(value)) {
        throw ConfigError({std::string(field), Quantity{value, type.unit}, expectation(type)});
    }
}

void check_value(std::string_view field, std::string_view value, const ValueType& type) {
    if (std::ranges::find(type.names, value) == type.names.end()) {
        throw ConfigError(
            {std::string(field), "\"" + std::string(value) + "\"", {expected_name(value, type.names)}});
    }
}

void check_fields(const Schema& schema, const void* config) {
    for (const Field& field : schema.fields) {
        const ConstMember value = field.of(config);
        if (const auto* number = std::get_if<const double*>(&value)) {
            if (!field.type.contains(**number)) {
                check_value(schema.full_name(field), **number, field.type);
            }
        } else if (const auto* integer = std::get_if<const int*>(&value)) {
            if (!field.type.contains(**integer)) {
                check_value(schema.full_name(field), **integer, field.type);
            }
        } else if (const auto* name = std::get_if<const std::string*>(&value);
                   name != nullptr && field.type.kind == ValueType::Kind::name) {
            check_value(schema.full_name(field), **name, field.type);
        } else if (const auto* rates = std::get_if<const Bitrates*>(&value)) {
            for (const double bitrate_bps : **rates) {
                check_value(schema.full_name(field), bitrate_bps, field.type);
            }
        } else if (const auto* powers = std::get_if<const PowersByBitrate*>(&value)) {
            for (const auto& [bitrate_bps, power_w] : **powers) {
                check_value(schema.full_name(field), bitrate_bps, bitrates());
                check_value(schema.full_name(field), power_w, field.type);
            }
        }
    }
}

}  // namespace netsim
