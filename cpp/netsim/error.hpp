// The two families of failed checks.
//
// Errors that a user can cause throw ConfigError (before a run) or SimulationError (during one),
// with the value, its unit and what was expected. Errors that only a developer of the engine can
// cause are asserted with NETSIM_ASSERT.
#pragma once

#include <stdexcept>
#include <string>

namespace netsim {

// A value of a configuration is outside its range, or a name is not in its table.
class ConfigError : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

// A command of a protocol that cannot be carried out: a timer in the past, an unknown destination,
// …
class SimulationError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Ends the process with the place and the broken assumption; stays on in release builds, so keep it
// cheap.
[[noreturn]] void assertion_failed(const char* expression, const char* file, int line);

}  // namespace netsim

#define NETSIM_ASSERT(expression) \
    ((expression) ? static_cast<void>(0) : ::netsim::assertion_failed(#expression, __FILE__, __LINE__))
