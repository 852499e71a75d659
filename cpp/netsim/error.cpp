#include "netsim/error.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace netsim {
namespace {

struct TextOfPart {
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const Quantity& quantity) const {
        std::string text = text_of(quantity.value);
        if (!quantity.unit.empty()) {
            text.append(" ").append(quantity.unit);
        }
        return text;
    }
    std::string operator()(const FieldName& field) const { return field.name; }
};

std::string text_of_problem(const Problem& problem) {
    std::string text;
    if (problem.interface) {
        text = "wlan[" + std::to_string(*problem.interface) + "].";
    }
    if (!problem.field.empty()) {
        const std::string value = std::visit(TextOfPart{}, problem.value);
        text += problem.field + (value.empty() ? "" : " = " + value) + ": ";
    }
    for (const MessagePart& part : problem.message) {
        text += std::visit(TextOfPart{}, part);
    }
    return text;
}

}  // namespace

ConfigError::ConfigError(Problem problem)
    : std::invalid_argument(text_of_problem(problem)),
      problem_(std::make_shared<const Problem>(std::move(problem))) {}

std::string text_of(double value) {
    std::array<char, 32> buffer{};
    const bool is_whole = std::abs(value) < 1e15 && std::trunc(value) == value;
    const auto [end, error] =
        is_whole ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), static_cast<long long>(value))
                 : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    NETSIM_ASSERT(error == std::errc{});
    return {buffer.data(), end};
}

void assertion_failed(const char* expression, const char* file, int line) {
    std::fprintf(stderr, "netsim: internal error: %s does not hold (%s:%d); please report it\n", expression,
                 file, line);
    std::abort();
}

}  // namespace netsim
