// The checks that the configurations' validate() are made of; each throws a ConfigError for the person who
// set the value: field, value, unit, what was expected, nearest name.
//
// `field` is the full name, "radio.tx_power_w"; `unit` may be empty. All texts begin "FIELD = VALUE". NaN and
// infinity are outside of every range.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace netsim {

void check_at_least(std::string_view field, double value, double minimum, std::string_view unit);
void check_greater(std::string_view field, double value, double bound, std::string_view unit);
void check_between(std::string_view field, double value, double minimum, double maximum,
                   std::string_view unit);
void check_finite(std::string_view field, double value, std::string_view unit);
// As check_between, for a field where -1 has a meaning of its own: "-1 (MEANING) or …".
void check_default_or_between(std::string_view field, int value, std::string_view meaning, int minimum,
                              int maximum);
void check_name(std::string_view field, std::string_view value, std::span<const std::string_view> names);

// The shortest text that reads back as the same number, whole numbers with all their digits: "0.02", "1e-14",
// "5500000".
std::string text_of(double value);

}  // namespace netsim
