// The proxy protocol: a protocol of the engine that forwards every event to a Python object.
//
// The methods are looked up by name at each event, since the dispatcher plugin may replace them on the
// instance at any time. Such a call costs as much as the same call in Python.
#pragma once

#include <pybind11/pybind11.h>

#include "netsim/node/protocol.hpp"
#include "proxy_protocol/telemetry_object.hpp"

namespace proxy_protocol {

class PythonProtocol final : public netsim::Protocol {
public:
    // `protocol` has the five methods of IProtocol. `on_failure(exception, callback_name)` is called
    // when one of them raises, before the exception propagates through the engine to the caller of
    // run_until. `wants_failed_messages`: whether it has handle_failed_message.
    PythonProtocol(pybind11::object protocol, pybind11::object on_failure, bool wants_failed_messages);

    void initialize() override;
    void handle_timer(const std::string& timer) override;
    void handle_packet(const netsim::Payload& message) override;
    void handle_telemetry(const netsim::Position& position) override;
    void finish() override;
    bool wants_failed_messages() const override { return wants_failed_messages_; }
    void handle_failed_message(const netsim::Payload& message, netsim::NodeId destination,
                               netsim::MessageOutcome reason) override;

private:
    void call(pybind11::handle method);
    void call(pybind11::handle method, pybind11::handle argument);
    pybind11::object text_for(pybind11::handle method, const std::string& text);
    void check(PyObject* result, pybind11::handle method);

    pybind11::object protocol_;
    pybind11::object on_failure_;
    TelemetryObject telemetry_;
    pybind11::object initialize_;  // the interned names of the methods
    pybind11::object handle_timer_;
    pybind11::object handle_packet_;
    pybind11::object handle_telemetry_;
    pybind11::object finish_;
    pybind11::object handle_failed_message_;
    bool wants_failed_messages_;
};

}  // namespace proxy_protocol
