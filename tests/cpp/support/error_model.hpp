// Error models without parameters, by name. They are static.
#pragma once

#include <string_view>

#include "netsim/phy/error_rate.hpp"

namespace netsim::test {

inline const ErrorModel& error_model(std::string_view name) {
    RadioConfig config;
    config.error_model = name;
    return *make_error_model(config);
}

}  // namespace netsim::test
