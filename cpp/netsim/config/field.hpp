// The declaration of a configuration's fields: one row for each, next to its struct.
//
// Everything else about a field follows from its row: the check of its range, the Python binding and its type stub, the
// keys that .ini files accept with their errors, the reference page of keys, and the values that the fuzzer tries.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "netsim/config/model.hpp"
#include "netsim/error.hpp"

namespace netsim {

// Type of a value, its range, and its format in .ini files. Made by the functions below:
// `quantity("s").shown_in("us").at_least(0).at_most(1)`.
struct ValueType {
    enum class Kind {
        quantity,
        level,
        ratio,
        number,
        integer,
        bytes,
        boolean,
        name,
        file,
        bitrates,
        powers_by_bitrate
    };

    Kind kind = Kind::number;
    std::string_view unit = {};   // of the field, an SI unit
    std::string_view shown = {};  // the unit of readable output; "" for `unit`
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool excludes_least = false;
    std::optional<double> special = {};            // allowed in addition to the range
    std::string_view special_meaning = {};         // "" if the meaning of the field includes it
    std::span<const std::string_view> names = {};  // of Kind::name

    constexpr ValueType shown_in(std::string_view unit_of_people) const {
        ValueType type = *this;
        type.shown = unit_of_people;
        return type;
    }
    constexpr ValueType at_least(double bound) const {
        ValueType type = *this;
        type.least = bound;
        type.excludes_least = false;
        return type;
    }
    constexpr ValueType above(double bound) const {
        ValueType type = at_least(bound);
        type.excludes_least = true;
        return type;
    }
    constexpr ValueType at_most(double bound) const {
        ValueType type = *this;
        type.most = bound;
        return type;
    }
    constexpr ValueType or_special(double value, std::string_view meaning = "") const {
        ValueType type = *this;
        type.special = value;
        type.special_meaning = meaning;
        return type;
    }
    constexpr bool is_number() const { return kind < Kind::boolean; }
    bool contains(double value) const;
};

constexpr ValueType quantity(std::string_view unit) {
    return {.kind = ValueType::Kind::quantity, .unit = unit};
}
// A power at a receiver, in W, written in dBm.
constexpr ValueType level() {
    return {.kind = ValueType::Kind::level, .unit = "W", .shown = "dBm", .least = 0};
}
// A ratio of powers, written in dB.
constexpr ValueType ratio() {
    return {.kind = ValueType::Kind::ratio, .shown = "dB", .least = 0};
}
constexpr ValueType number() {
    return {};
}
// A number with an optional unit in .ini files.
constexpr ValueType number_in(std::string_view unit) {
    return {.unit = unit};
}
constexpr ValueType integer() {
    return {.kind = ValueType::Kind::integer};
}
constexpr ValueType bytes() {
    return {.kind = ValueType::Kind::bytes, .unit = "B"};
}
constexpr ValueType boolean() {
    return {.kind = ValueType::Kind::boolean};
}
constexpr ValueType file_name() {
    return {.kind = ValueType::Kind::file};
}
constexpr ValueType one_of(std::span<const std::string_view> names) {
    return {.kind = ValueType::Kind::name, .names = names};
}
constexpr ValueType angle() {
    return quantity("rad").shown_in("deg");
}
constexpr ValueType bitrate() {
    return quantity("bps").shown_in("Mbps").above(0).or_special(-1);
}

// Bitrates in bps: [1Mbps, 2Mbps].
constexpr ValueType bitrates() {
    return {.kind = ValueType::Kind::bitrates,
            .unit = "bps",
            .shown = "Mbps",
            .least = 0,
            .excludes_least = true};
}
// A power in W for each of several bitrates in bps: [[6Mbps, 22dBm], [54Mbps, 19dBm]].
constexpr ValueType powers_by_bitrate() {
    return {.kind = ValueType::Kind::powers_by_bitrate, .unit = "W", .shown = "mW", .least = 0};
}

// The family of models that decides whether a field is read: a model reads it if its row names it.
struct ReadBy {
    std::string_view chosen_by =
        {};  // the field that chooses the model: "radio.error_model"; "": every model reads it
    std::span<const Model> models = {};
};

using Bitrates = std::vector<double>;                            // in bps
using PowersByBitrate = std::vector<std::pair<double, double>>;  // {bitrate in bps, power in W}
using Member = std::variant<double*, int*, bool*, std::string*, Bitrates*, PowersByBitrate*>;
using ConstMember = std::variant<const double*, const int*, const bool*, const std::string*, const Bitrates*,
                                 const PowersByBitrate*>;

// Where a field is in its struct. This is data, as headers declare fields: with pointers to members, each source that
// includes the header would compile a function for each field.
struct Accessor {
    std::size_t offset;
    Member (*value_at)(void* address);
    ConstMember (*const_value_at)(const void* address);

    Member operator()(void* config) const { return value_at(static_cast<std::byte*>(config) + offset); }
    ConstMember operator()(const void* config) const {
        return const_value_at(static_cast<const std::byte*>(config) + offset);
    }
};

template <typename Value>
constexpr Accessor accessor(std::size_t offset) {
    return {offset, [](void* address) -> Member { return static_cast<Value*>(address); },
            [](const void* address) -> ConstMember { return static_cast<const Value*>(address); }};
}

struct Field {
    std::string_view name;  // the name in C++ and Python
    Accessor of;
    std::string_view key;  // the key in .ini files, below the path of the struct
    ValueType type;
    std::string_view meaning;            // one sentence for lists of keys
    std::optional<ReadBy> read_by = {};  // default: that of the struct
    bool must_be_set = false;            // its default means "not set": the model that reads it needs a value
};

// All fields of one struct.
struct Schema {
    std::string_view name;  // first part of a field's full name: "radio" in "radio.tx_power_w"
    std::string_view path;  // of their keys: below a node if `is_of_node`, else below the network
    bool is_of_node;
    std::span<const Field> fields;
    ReadBy read_by = {};          // of fields without their own
    std::string_view shown = {};  // the name of these models in lists of keys; "" to leave it out

    std::string full_name(const Field& field) const;
    const ReadBy& family(const Field& field) const { return field.read_by ? *field.read_by : read_by; }
    // Names of the models of that family that read the field.
    std::vector<std::string_view> readers(const Field& field) const;
    // The same for lists of keys: "RayleighFading, RicianFading", or "All but …" if that is shorter.
    std::string readers_shown(const Field& field) const;
};

// Schemas of all structs that .ini files set, in the order in which lists of keys show them.
std::span<const Schema* const> all_schemas();

// Throws ConfigError, about the field of that full name, for a value that is not of the type. NaN and infinity are
// outside every range.
void check_value(std::string_view field, double value, const ValueType& type);
void check_value(std::string_view field, std::string_view value, const ValueType& type);

// Throws ConfigError for the first field of `config` outside its range.
void check_fields(const Schema& schema, const void* config);

template <typename Config>
void check_fields(const Config& config) {
    check_fields(Config::schema, &config);
}

}  // namespace netsim

// Accessor of a field, or of a part of one: NETSIM_MEMBER(AntennaConfig, offset.heading_rad).
#define NETSIM_MEMBER(Config, field) ::netsim::accessor<decltype(Config::field)>(offsetof(Config, field))
// Name and accessor of a field, for the first two members of a Field.
#define NETSIM_FIELD(Config, field) #field, NETSIM_MEMBER(Config, field)
