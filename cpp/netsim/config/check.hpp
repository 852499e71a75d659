// Checks of single values. Each throws a ConfigError for the person who set the value: field, value, unit, expected
// values, nearest name. Fields of configurations are checked by their declarations (config/field.hpp).
//
// `field` is the full name, "radio.tx_power_w"; `unit` may be empty. NaN and infinity are outside every range.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "netsim/error.hpp"

namespace netsim {

void check_at_least(std::string_view field, double value, double minimum, std::string_view unit);
void check_greater(std::string_view field, double value, double bound, std::string_view unit);
void check_between(std::string_view field, double value, double minimum, double maximum,
                   std::string_view unit);
void check_finite(std::string_view field, double value, std::string_view unit);
// Compares two fields: `value` must not exceed `most`, the value of the field `other`.
void check_at_most(std::string_view field, double value, const std::string& other, double most,
                   std::string_view unit = "");
void check_name(std::string_view field, std::string_view value, std::span<const std::string_view> names);

}  // namespace netsim
