// The interface of a protocol in C++: the same five callbacks as in Python.
//
// A protocol reacts to events and acts through its Node (send, go_to, schedule_timer, …). The
// Python proxy is one implementation; native protocols (cpp/protocols) are others. An exception
// thrown by a callback ends the run, usually as a ProtocolError.
#pragma once

#include <string>

#include "netsim/geometry/position.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/mac/network_interface.hpp"

namespace netsim {

struct NetworkContext;  // node/network_context.hpp

class Protocol : protected NetworkInterfaceListener {
public:
    virtual ~Protocol() = default;

    // Called before the run, when all nodes exist. Throws ConfigError for parameters that are
    // invalid for this node in this network, such as the id of a node that does not exist.
    virtual void check() const {}

    // Once, at the start of the run, in the order of node ids.
    virtual void initialize() = 0;
    // A timer of this node is due.
    virtual void handle_timer(const std::string& timer) = 0;
    // A message for this node arrived.
    virtual void handle_packet(const Payload& message) = 0;
    // Once per telemetry interval, with the current position of the node.
    virtual void handle_telemetry(const Position& position) = 0;
    // Once, at the end of the run, in the order of node ids.
    virtual void finish() = 0;

    // Whether it wants the calls below; asked once, before the run.
    virtual bool wants_failed_messages() const { return false; }
    // A message of this node was dropped, or its retries ended without an ACK. `destination`:
    // broadcast_id for all.
    virtual void handle_failed_message(const Payload&, NodeId, MessageOutcome) {}

    // A timer will be due soon: may prefetch what the handler reads (kernel/prefetch.hpp). The first
    // two cache lines of the protocol itself are prefetched already.
    virtual void prefetch() const {}

private:
    friend class Node;      // sets context_ and node_
    friend class Computer;  // passes on messages

    // Called directly by the interface. The message is recorded here and not by the node, which saves
    // a cache line in a large network.
    void message_received(const Frame& frame) override;

    NetworkContext* context_ = nullptr;
    NodeId node_ = 0;
};

}  // namespace netsim
