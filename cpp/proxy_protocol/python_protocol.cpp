#include "proxy_protocol/python_protocol.hpp"

#include <bit>
#include <cstdint>
#include <utility>

#include "proxy_protocol/python_text.hpp"

namespace py = pybind11;

namespace proxy_protocol {

namespace {

py::object interned(const char* text) {
    return py::reinterpret_steal<py::object>(PyUnicode_InternFromString(text));
}

}  // namespace

PythonProtocol::PythonProtocol(py::object protocol, py::object on_failure)
    : protocol_(std::move(protocol)),
      on_failure_(std::move(on_failure)),
      telemetry_class_(py::module_::import("gradysim.protocol.messages.telemetry").attr("Telemetry")),
      current_position_(interned("current_position")),
      initialize_(interned("initialize")),
      handle_timer_(interned("handle_timer")),
      handle_packet_(interned("handle_packet")),
      handle_telemetry_(interned("handle_telemetry")),
      finish_(interned("finish")) {}

void PythonProtocol::initialize() {
    call(initialize_);
}

void PythonProtocol::handle_timer(const std::string& timer) {
    call(handle_timer_, python_from_utf8(timer));
}

void PythonProtocol::handle_packet(const netsim::Payload& message) {
    call(handle_packet_, python_from_utf8(*message));
}

void PythonProtocol::handle_telemetry(const netsim::Position& position) {
    // Telemetry(current_position=(x, y, z)), up to a hundred times a second for each node. If the protocol kept no
    // reference to the last one, nobody can tell whether this is a new one: it is used again, as zip() does with its
    // tuples.
    if (!telemetry_ || Py_REFCNT(telemetry_.ptr()) != 1 || Py_REFCNT(coordinates_.ptr()) != 2) {
        auto* type = reinterpret_cast<PyTypeObject*>(telemetry_class_.ptr());
        telemetry_ = py::reinterpret_steal<py::object>(type->tp_alloc(type, 0));
        coordinates_ = py::tuple(3);
        if (!telemetry_ ||
            PyObject_SetAttr(telemetry_.ptr(), current_position_.ptr(), coordinates_.ptr()) != 0) {
            throw py::error_already_set();
        }
    }
    const double values[] = {position.x, position.y, position.z};
    for (Py_ssize_t index = 0; index < 3; ++index) {
        PyObject* old = PyTuple_GET_ITEM(coordinates_.ptr(), index);
        if (old != nullptr && std::bit_cast<std::uint64_t>(PyFloat_AS_DOUBLE(old)) ==
                                  std::bit_cast<std::uint64_t>(values[index])) {
            continue;  // vehicles often fly along an axis, and stand still
        }
        PyObject* value = PyFloat_FromDouble(values[index]);
        if (value == nullptr) {
            throw py::error_already_set();
        }
        PyTuple_SET_ITEM(coordinates_.ptr(), index, value);
        Py_XDECREF(old);
    }
    call(handle_telemetry_, telemetry_);
}

void PythonProtocol::finish() {
    call(finish_);
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
