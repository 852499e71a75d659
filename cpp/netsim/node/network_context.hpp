// State and statistics shared by the nodes of one network.
#pragma once

#include <cstdint>

#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/node/payload_hash.hpp"
#include "netsim/node/payload_padding.hpp"
#include "netsim/node_id.hpp"
#include "netsim/trace/message_delays.hpp"

namespace netsim {

class ReplayRecorder;  // node/replay_recorder.hpp

struct NetworkContext {
    static constexpr NodeId no_node = -1;

    Simulator& simulator;
    Fingerprint& fingerprint;
    PayloadHash payload_hash{};
    MessageDelays message_delays{};
    PayloadPadding padding{};
    std::int32_t node_count = 0;
    NodeId active_node = no_node;        // the node whose protocol is running
    ReplayRecorder* recorder = nullptr;  // if the run is recorded
};

}  // namespace netsim
