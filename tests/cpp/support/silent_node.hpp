// A stationary node without telemetry.
#pragma once

#include "netsim/config/node_config.hpp"

namespace netsim::test {

inline NodeConfig silent_node(Position position = {}) {
    NodeConfig config("node");
    config.initial_position = position;
    config.mobility.telemetry_interval_s = 0;
    return config;
}

}  // namespace netsim::test
