// Commands of a Python protocol's provider: they turn command objects into calls of the engine.
//
// A call that fails raises an exception of gradysim.protocol.errors, with the message of
// gradysim.encapsulator.validation.
#pragma once

#include <pybind11/pybind11.h>

#include "netsim/node/node.hpp"

namespace proxy_protocol {

// command: gradysim.protocol.messages.communication.CommunicationCommand (or an object with its
// attributes).
void send_communication_command(netsim::Node& node, pybind11::handle command);
// command: gradysim.protocol.messages.mobility.MobilityCommand. The caller must have converted
// GOTO_GEO_COORDS.
void send_mobility_command(netsim::Node& node, pybind11::handle command);
// timestamp: absolute simulated time in seconds.
void schedule_timer(netsim::Node& node, pybind11::handle timer, pybind11::handle timestamp);
void cancel_timer(netsim::Node& node, pybind11::handle timer);

}  // namespace proxy_protocol
