// The contract of a protocol in C++: the same five events as in Python.
//
// A protocol reacts to events and acts through its Node (send, go_to, schedule_timer, …). The Python proxy is
// one implementation; native protocols, in protocols/, are others. An exception thrown by a callback ends the run: a
// std::runtime_error (SimulationError, too) or std::logic_error as a ProtocolError, in which it is nested, others as they are.
#pragma once

#include <string>

#include "netsim/geometry/position.hpp"
#include "netsim/mac/frame.hpp"
#include "netsim/mac/network_interface.hpp"

namespace netsim {

struct Surroundings;  // node/surroundings.hpp

class Protocol : private NetworkInterfaceListener {
public:
    virtual ~Protocol() = default;

    // Before the run, when all nodes are there. Throws ConfigError for parameters that this node, in this network, cannot
    // have: another node that is not there, say.
    virtual void check() const {}

    // Once, at the start of the run, in the order of node ids.
    virtual void initialize() = 0;
    // A timer of this node is due.
    virtual void handle_timer(const std::string& timer) = 0;
    // A message for this node arrived.
    virtual void handle_packet(const Payload& message) = 0;
    // Where the node is now; every telemetry interval.
    virtual void handle_telemetry(const Position& position) = 0;
    // Once, at the end of the run, in the order of node ids.
    virtual void finish() = 0;

    // A timer will be due soon: may have what it touches brought into the cache, beside the first two lines of the protocol
    // itself, which are there (kernel/fetch.hpp).
    virtual void fetch() const {}

private:
    friend class Node;  // says where it is

    // Straight from the interface: what there is to note of a message is noted here, so that in a large network no line of
    // the node has to be brought into the cache for it.
    void message_received(const Frame& frame) final;

    Surroundings* surroundings_ = nullptr;
    NodeId node_ = 0;
};

}  // namespace netsim
