#include "netsim/config/field.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "config/error_text.hpp"
#include "netsim/config/computer_config.hpp"
#include "netsim/config/interface_config.hpp"
#include "netsim/config/medium_config.hpp"
#include "netsim/config/mobility_config.hpp"
#include "netsim/config/obstacle_config.hpp"
#include "netsim/config/wind_config.hpp"

namespace netsim {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// One object of each struct with its defaults.
class Examples {
public:
    void* of(const Schema& schema) {
        for (const auto& [known, config] : configs_) {
            if (known == &schema) {
                return config;
            }
        }
        return nullptr;
    }

private:
    ComputerConfig computer_;
    InterfaceConfig interface_;
    MediumConfig medium_;
    MobilityConfig mobility_;
    ObstacleConfig obstacle_;
    WindConfig wind_;
    std::vector<std::pair<const Schema*, void*>> configs_{
        {&ComputerConfig::schema, &computer_},     {&InterfaceConfig::schema, &interface_},
        {&MacConfig::schema, &interface_.mac},     {&CsmaConfig::schema, &interface_.csma},
        {&RadioConfig::schema, &interface_.radio}, {&AntennaConfig::schema, &interface_.radio.antenna},
        {&MediumConfig::schema, &medium_},         {&MobilityConfig::schema, &mobility_},
        {&ObstacleConfig::schema, &obstacle_},     {&WindConfig::schema, &wind_}};
};

// The field that the check of the struct reports; "" for none.
std::string reported(const Schema& schema, const void* config) {
    try {
        check_fields(schema, config);
    } catch (const ConfigError& error) {
        return error.problem()->field;
    }
    return "";
}

void set_number(const Field& field, void* config, double value) {
    const Member member = field.of(config);
    if (auto* const* number = std::get_if<double*>(&member)) {
        **number = value;
    } else if (auto* const* bitrates = std::get_if<Bitrates*>(&member)) {
        **bitrates = {value};
    } else if (auto* const* powers = std::get_if<PowersByBitrate*>(&member)) {
        **powers = {{6e6, value}};
    } else {
        *std::get<int*>(member) = static_cast<int>(value);
    }
}

// Values just outside the range of a field.
std::vector<double> wrong_numbers(const Field& field) {
    Examples examples;
    const ValueType& type = field.type;
    std::vector<double> values;
    const bool is_integer = type.kind == ValueType::Kind::integer || type.kind == ValueType::Kind::bytes;
    const auto next = [&](double value, double toward) {
        return is_integer ? value + (toward > value ? 1 : -1) : std::nextafter(value, toward);
    };
    if (std::isfinite(type.least)) {
        values.push_back(type.excludes_least ? type.least : next(type.least, -infinity));
    }
    if (std::isfinite(type.most)) {
        values.push_back(next(type.most, infinity));
    }
    if (!is_integer) {
        values.insert(values.end(), {nan, infinity, -infinity});
    }
    std::erase_if(values, [&](double value) { return type.special == value; });
    return values;
}

TEST(Field, EveryDefaultIsValid) {
    for (const Schema* schema : all_schemas()) {
        EXPECT_EQ(reported(*schema, Examples().of(*schema)), "");
    }
}

TEST(Field, EveryNumberOutOfItsRangeIsReportedWithItsName) {
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            if (!field.type.is_number()) {
                continue;
            }
            for (const double value : wrong_numbers(field)) {
                Examples examples;
                set_number(field, examples.of(*schema), value);
                EXPECT_EQ(reported(*schema, examples.of(*schema)), schema->full_name(field)) << value;
            }
        }
    }
}

TEST(Field, BoundsAndSpecialValuesAreAccepted) {
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            const ValueType& type = field.type;
            std::vector<double> values;
            if (std::isfinite(type.least) && !type.excludes_least) {
                values.push_back(type.least);
            }
            if (std::isfinite(type.most)) {
                values.push_back(type.most);
            }
            if (type.special) {
                values.push_back(*type.special);
            }
            for (const double value : values) {
                Examples examples;
                set_number(field, examples.of(*schema), value);
                EXPECT_EQ(reported(*schema, examples.of(*schema)), "") << schema->full_name(field) << value;
            }
        }
    }
}

TEST(Field, EveryWrongNameIsReportedWithItsField) {
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            if (field.type.kind == ValueType::Kind::name) {
                Examples examples;
                *std::get<std::string*>(field.of(examples.of(*schema))) = "?";
                EXPECT_EQ(reported(*schema, examples.of(*schema)), schema->full_name(field));
            }
        }
    }
}

TEST(Field, RowsOfModelsNameFieldsOfTheirFamily) {
    using Names = std::set<std::string, std::less<>>;
    std::map<std::span<const Model>::pointer, Names> read;  // of each family
    std::map<std::span<const Model>::pointer, std::size_t> sizes;
    for (const Schema* schema : all_schemas()) {
        read[schema->read_by.models.data()].emplace(schema->name);
        for (const Field& field : schema->fields) {
            const std::span<const Model> models = schema->family(field).models;
            read[models.data()].insert({std::string(field.name), schema->full_name(field)});
            sizes[models.data()] = models.size();
        }
    }
    for (const auto& [models, size] : sizes) {
        for (const Model& model : std::span(models, size)) {
            for (const std::string_view name : model.reads) {
                EXPECT_TRUE(name.empty() || read[models].contains(name)) << model.name << " reads " << name;
            }
        }
    }
}

TEST(Field, AModelReadsEachFieldAndUsersCanChooseIt) {
    std::set<std::string> choices;
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            for (const std::string_view name : field.type.names) {
                choices.insert(schema->full_name(field) + " = " + std::string(name));
            }
        }
    }
    choices.insert("mobility.typename = ArdupilotMobility");  // scenario files support it
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            const std::string_view chosen_by = schema->family(field).chosen_by;
            EXPECT_EQ(schema->readers(field).empty(), chosen_by.empty()) << schema->full_name(field);
            for (const std::string_view name : schema->readers(field)) {
                const std::string choice = std::string(chosen_by) + " = " + std::string(name);
                EXPECT_TRUE(choices.contains(choice)) << schema->full_name(field) << ": " << choice;
            }
        }
    }
}

// The readers of a field in lists of keys.
std::string shown(std::string_view full_name) {
    for (const Schema* schema : all_schemas()) {
        for (const Field& field : schema->fields) {
            if (schema->full_name(field) == full_name) {
                return schema->readers_shown(field);
            }
        }
    }
    return "no such field";
}

TEST(Field, ListsOfKeysNameTheReadersOrTheOthersIfTheyAreFewer) {
    EXPECT_EQ(shown("medium.sigma_db"), "LogNormalShadowing");
    EXPECT_EQ(shown("medium.alpha"), "All but BreakpointPathLoss, TwoRayInterference");
    EXPECT_EQ(shown("radio.noise_figure"), "ThermalNoise");
    EXPECT_EQ(shown("csma.contention_window"), "802.15.4, linear, constant");
    EXPECT_EQ(shown("csma.sifs_s"), "802.15.4");
    EXPECT_EQ(shown("mac.cw_min"), "");
}

TEST(Field, WhatWasExpectedIsInTheUnitOfTheField) {
    const auto told = [](double value, const ValueType& type) {
        return error_text([&] { check_value("mac.cw_min", value, type); });
    };
    EXPECT_EQ(told(-2, integer().at_least(0).at_most(7).or_special(-1, "the default")),
              "mac.cw_min = -2: expected -1 (the default) or from 0 to 7");
    EXPECT_EQ(told(0, bitrate()), "mac.cw_min = 0 bps: expected -1 bps or more than 0 bps");
    EXPECT_EQ(told(9, quantity("s").above(0).at_most(1)),
              "mac.cw_min = 9 s: expected more than 0 s and at most 1 s");
    EXPECT_EQ(told(nan, angle()), "mac.cw_min = nan rad: expected a finite number");
}

}  // namespace
}  // namespace netsim
