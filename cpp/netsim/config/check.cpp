#include "netsim/config/check.hpp"

#include "netsim/config/field.hpp"

namespace netsim {

void check_at_least(std::string_view field, double value, double minimum, std::string_view unit) {
    check_value(field, value, quantity(unit).at_least(minimum));
}

void check_greater(std::string_view field, double value, double bound, std::string_view unit) {
    check_value(field, value, quantity(unit).above(bound));
}

void check_between(std::string_view field, double value, double minimum, double maximum,
                   std::string_view unit) {
    check_value(field, value, quantity(unit).at_least(minimum).at_most(maximum));
}

void check_finite(std::string_view field, double value, std::string_view unit) {
    check_value(field, value, quantity(unit));
}

void check_at_most(std::string_view field, double value, const std::string& other, double most,
                   std::string_view unit) {
    if (value > most) {
        throw ConfigError({std::string(field),
                           Quantity{value, unit},
                           {"expected at most ", FieldName{other}, ", ", Quantity{most, unit}},
                           {other}});
    }
}

void check_name(std::string_view field, std::string_view value, std::span<const std::string_view> names) {
    check_value(field, value, one_of(names));
}

}  // namespace netsim
