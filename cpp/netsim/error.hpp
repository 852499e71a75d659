// The two families of failed checks.
//
// Errors that a user can cause throw ConfigError (before a run) or SimulationError (during one),
// with the value, its unit and what was expected. Errors that only a developer of the engine can
// cause are asserted with NETSIM_ASSERT.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace netsim {

// Parts of a message whose terms depend on the reader: an .ini file writes the field radio.energy_detection_w as
// energyDetection, and 1e-14 W as -110dBm.
struct Quantity {
    double value;
    std::string_view unit;  // "" for a number without a unit
};
struct FieldName {
    std::string name;  // "radio.energy_detection_w"
};
using MessagePart = std::variant<std::string, Quantity, FieldName>;

// What is wrong with a configuration, in most cases with one of its fields.
struct Problem {
    std::string field = {};  // "radio.tx_power_w"; "" for none
    MessagePart value = {};  // that of the field: a quantity, or a quoted name; "" to show none
    std::vector<MessagePart> message = {};  // "expected more than ", Quantity{...}, ...
    // Other fields that decide whether the value is right, the likeliest cause first.
    std::vector<std::string> compared_with = {};
    std::optional<int> interface = {};  // index of the network interface, if the node has several
};

// A value of a configuration is outside its range, or a name is not in its table.
class ConfigError : public std::invalid_argument {
public:
    explicit ConfigError(const std::string& text) : std::invalid_argument(text) {}
    // The text is "FIELD = VALUE: MESSAGE", after "wlan[INDEX]." if the problem has an interface; only the message if
    // it has no field.
    explicit ConfigError(Problem problem);

    // Null for an error with a plain text.
    const Problem* problem() const { return problem_.get(); }

private:
    std::shared_ptr<const Problem> problem_;  // shared, so that copying an error cannot fail
};

// A command of a protocol that cannot be carried out: a timer in the past, an unknown destination,
// …
class SimulationError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The shortest text that reads back as the same number, integers with all their digits: "0.02", "1e-14", "5500000".
std::string text_of(double value);

// Ends the process with the place and the broken assumption; stays on in release builds, so keep it cheap.
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);

}  // namespace netsim

#define NETSIM_ASSERT(expression) \
    ((expression) ? static_cast<void>(0) : ::netsim::assertion_failed(#expression, __FILE__, __LINE__))
