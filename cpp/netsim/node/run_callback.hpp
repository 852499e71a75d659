// Runs a callback of a protocol: the replay recorder, the network and errors know which one it is.
#pragma once

#include "netsim/node/network_context.hpp"
#include "netsim/node/protocol_error.hpp"
#include "netsim/node/replay_recorder.hpp"

namespace netsim {

// Calls `call()`. `callback`: the name of the protocol's method; static storage. Its errors become ProtocolErrors.
template <typename Call>
void run_callback(NetworkContext& context, NodeId node, const char* callback, const Call& call) {
    if (context.recorder != nullptr) {
        context.recorder->callback_begins(callback);
    }
    context.active_node = node;
    call_of_protocol(callback, node, context.simulator.now(), call);
    context.active_node = NetworkContext::no_node;
}

}  // namespace netsim
