#include "netsim/config/check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "netsim/config/nearest_name.hpp"
#include "netsim/error.hpp"

namespace netsim {
namespace {

std::string with_unit(double value, std::string_view unit) {
    std::string text = text_of(value);
    if (!unit.empty()) {
        text.append(" ").append(unit);
    }
    return text;
}

[[noreturn]] void refuse(std::string_view field, std::string_view value, std::string_view expected) {
    throw ConfigError(std::string(field).append(" = ").append(value).append(": expected ").append(expected));
}

}  // namespace

std::string text_of(double value) {
    std::array<char, 32> buffer{};
    const bool is_whole = std::abs(value) < 1e15 && std::trunc(value) == value;
    const auto [end, error] =
        is_whole ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), static_cast<long long>(value))
                 : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    NETSIM_ASSERT(error == std::errc{});
    return {buffer.data(), end};
}

void check_at_least(std::string_view field, double value, double minimum, std::string_view unit) {
    if (!std::isfinite(value) || value < minimum) {
        refuse(field, with_unit(value, unit), "at least " + with_unit(minimum, unit));
    }
}

void check_greater(std::string_view field, double value, double bound, std::string_view unit) {
    if (!std::isfinite(value) || value <= bound) {
        refuse(field, with_unit(value, unit), "more than " + with_unit(bound, unit));
    }
}

void check_between(std::string_view field, double value, double minimum, double maximum,
                   std::string_view unit) {
    if (!std::isfinite(value) || value < minimum || value > maximum) {
        refuse(field, with_unit(value, unit),
               "from " + with_unit(minimum, unit) + " to " + with_unit(maximum, unit));
    }
}

void check_finite(std::string_view field, double value, std::string_view unit) {
    if (!std::isfinite(value)) {
        refuse(field, with_unit(value, unit), "a finite number");
    }
}

void check_default_or_between(std::string_view field, int value, std::string_view meaning, int minimum,
                              int maximum) {
    if (value != -1 && (value < minimum || value > maximum)) {
        refuse(field, std::to_string(value),
               std::string("-1 (").append(meaning) + ") or from " + std::to_string(minimum) + " to " +
                   std::to_string(maximum));
    }
}

void check_name(std::string_view field, std::string_view value, std::span<const std::string_view> names) {
    if (std::ranges::find(names, value) != names.end()) {
        return;
    }
    std::string expected;
    std::vector<std::string_view> candidates;
    for (const std::string_view name : names) {
        expected.append(expected.empty() ? "" : ", ").append(name.empty() ? "\"\" (none)" : name);
        if (!name.empty()) {  // which nobody writes by a slip
            candidates.push_back(name);
        }
    }
    if (names.size() > 1) {
        expected.insert(0, "one of ")
            .append("; did you mean ")
            .append(nearest_name(value, candidates))
            .append("?");
    }
    refuse(field, std::string("\"").append(value).append("\""), expected);
}

}  // namespace netsim
