// Two nodes 10 m apart for the tests of native protocols: one runs the protocol, the other one
// records.
#pragma once

#include <string_view>

#include <gtest/gtest.h>

#include "protocols/native_protocols.hpp"
#include "support/recorder.hpp"

namespace netsim::test {

class PairOfNodes : public testing::Test {
protected:
    PairOfNodes() {
        NodeConfig config("tested");
        config.mobility.telemetry_interval_s = 0;
        tested = &network.add_node(config);
        config.name = "other";
        config.initial_position = {10, 0, 0};
        other = &add_recorder(network, config);
    }
    void run(std::string_view name, const Parameters& parameters, double seconds) {
        set_native_protocol(*tested, name, parameters);
        network.initialize();
        network.run_until(SimTime::from_seconds(seconds));
        network.finish();
    }
    TrackedValue tracked(std::string_view name) const {
        for (const auto& [known, value] : tested->tracked_variables().values()) {
            if (known == name) {
                return value;
            }
        }
        return "not tracked";
    }

    Network network{MediumConfig(), 1};
    Node* tested = nullptr;
    Recorder* other = nullptr;
};

}  // namespace netsim::test
