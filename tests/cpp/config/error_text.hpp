// The text of the ConfigError that a check raises, for comparisons in tests; "no error" if there
// is none.
#pragma once

#include <string>

#include "netsim/error.hpp"

namespace netsim {

template <typename Check>
std::string error_text(const Check& check) {
    try {
        check();
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace netsim
