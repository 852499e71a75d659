// An error of a C++ protocol during a run, with node, callback and time for the error message.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

#include "netsim/error.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/mac/frame.hpp"

namespace netsim {

class ProtocolError : public SimulationError {
public:
    ProtocolError(const std::string& what, NodeId node, const char* callback, SimTime time)
        : SimulationError(what), node_(node), callback_(callback), time_(time) {}

    NodeId node() const { return node_; }
    // Name of the protocol's method that was running; static storage.
    const char* callback() const { return callback_; }
    SimTime time() const { return time_; }

private:
    NodeId node_;
    const char* callback_;
    SimTime time_;
};

// Calls one of a protocol's methods. A std::runtime_error (such as SimulationError) or
// std::logic_error is nested in a ProtocolError; others propagate unchanged.
template <typename Call>
void call_of_protocol(const char* callback, NodeId node, SimTime now, const Call& call) {
    try {
        call();
    } catch (const std::runtime_error& error) {
        std::throw_with_nested(ProtocolError(error.what(), node, callback, now));
    } catch (const std::logic_error& error) {
        std::throw_with_nested(ProtocolError(error.what(), node, callback, now));
    }
}

}  // namespace netsim
