#include "proxy_protocol/python_protocol.hpp"

#include <utility>

#include "proxy_protocol/python_text.hpp"

namespace py = pybind11;

namespace proxy_protocol {

namespace {

py::object interned(const char* text) {
    return py::reinterpret_steal<py::object>(PyUnicode_InternFromString(text));
}

}  // namespace

PythonProtocol::PythonProtocol(py::object protocol, py::object on_failure, bool wants_failed_messages)
    : protocol_(std::move(protocol)),
      on_failure_(std::move(on_failure)),
      initialize_(interned("initialize")),
      handle_timer_(interned("handle_timer")),
      handle_packet_(interned("handle_packet")),
      handle_telemetry_(interned("handle_telemetry")),
      finish_(interned("finish")),
      handle_failed_message_(interned("handle_failed_message")),
      wants_failed_messages_(wants_failed_messages) {}

void PythonProtocol::initialize() {
    call(initialize_);
}

void PythonProtocol::handle_timer(const std::string& timer) {
    call(handle_timer_, text_for(handle_timer_, timer));
}

void PythonProtocol::handle_packet(const netsim::Payload& message) {
    call(handle_packet_, text_for(handle_packet_, *message));
}

void PythonProtocol::handle_telemetry(const netsim::Position& position) {
    call(handle_telemetry_, telemetry_.at(position));
}

void PythonProtocol::finish() {
    call(finish_);
}

void PythonProtocol::handle_failed_message(const netsim::Payload& message, netsim::NodeId destination,
                                           netsim::MessageOutcome reason) {
    const py::object text = text_for(handle_failed_message_, *message);
    const py::object receiver =
        destination == netsim::broadcast_id ? py::none() : py::object(py::int_(destination));
    const py::str why(netsim::message_outcome_names[static_cast<std::size_t>(reason)]);
    PyObject* arguments[] = {nullptr, protocol_.ptr(), text.ptr(), receiver.ptr(), why.ptr()};
    check(PyObject_VectorcallMethod(handle_failed_message_.ptr(), arguments + 1,
                                    4 | PY_VECTORCALL_ARGUMENTS_OFFSET, nullptr),
          handle_failed_message_);
}

void PythonProtocol::call(py::handle method) {
    PyObject* arguments[] = {nullptr, protocol_.ptr()};
    check(PyObject_VectorcallMethod(method.ptr(), arguments + 1, 1 | PY_VECTORCALL_ARGUMENTS_OFFSET, nullptr),
          method);
}

void PythonProtocol::call(py::handle method, py::handle argument) {
    PyObject* arguments[] = {nullptr, protocol_.ptr(), argument.ptr()};
    check(PyObject_VectorcallMethod(method.ptr(), arguments + 1, 2 | PY_VECTORCALL_ARGUMENTS_OFFSET, nullptr),
          method);
}

py::object PythonProtocol::text_for(py::handle method, const std::string& text) {
    try {
        return python_from_utf8(text);
    } catch (const py::error_already_set& failure) {  // a native protocol sent invalid UTF-8
        on_failure_(failure.value(), method);
        throw;
    }
}

void PythonProtocol::check(PyObject* result, py::handle method) {
    if (result != nullptr) {
        Py_DECREF(result);
        return;
    }
    const py::error_already_set failure;
    on_failure_(failure.value(), method);
    throw failure;  // NOLINT(misc-throw-by-value-catch-by-reference): a copy shares the Python exception
}

}  // namespace proxy_protocol
