// The computer that runs a node's protocol: settings `*.<node>.computer.…` of an .ini file. The meaning and
// range of each field are in computer_config.cpp.
#pragma once

#include "netsim/config/field.hpp"

namespace netsim {

struct ComputerConfig {
    double processing_time_s = 0;  // 0: none
    double processing_time_spread = 0;

    static const Schema schema;

    // Throws ConfigError for the first field out of its range: "computer.processing_time_s = -1 s: expected …".
    void validate() const { check_fields(*this); }
};

}  // namespace netsim
