// The engine's exceptions, as exceptions of Python. Texts name files, whose names may be any bytes.
// A failure of a native protocol knows where in the run it happened.
#include <cstring>
#include <exception>
#include <utility>

#include <pybind11/pybind11.h>

#include "netsim/error.hpp"
#include "netsim/node/protocol_error.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;

namespace proxy_protocol {

namespace {

// Bytes that are no UTF-8 become what Python has for them in names of files.
py::object text_of(const char* what) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(what, static_cast<Py_ssize_t>(std::strlen(what)), "surrogateescape"));
}

py::object exception_of(const char* name, const std::exception& error) {
    return py::module_::import("gradysim._netsim").attr(name)(text_of(error.what()));
}

void set(const py::object& exception) {
    PyErr_SetObject(py::type::handle_of(exception).ptr(), exception.ptr());
}

void translate(std::exception_ptr pending) {
    try {
        std::rethrow_exception(std::move(pending));
    } catch (const netsim::ProtocolError& error) {
        const py::object exception = exception_of("ProtocolError", error);
        exception.attr("node_id") = error.node();
        exception.attr("callback") = error.callback();
        exception.attr("time_s") = error.time().seconds();
        set(exception);
    } catch (const netsim::SimulationError& error) {
        set(exception_of("SimulationError", error));
    } catch (const netsim::ConfigError& error) {
        set(exception_of("ConfigError", error));
    }
}

}  // namespace

void bind_errors(py::module_& module) {
    const py::exception<netsim::ConfigError> config(module, "ConfigError", PyExc_ValueError);
    const py::exception<netsim::SimulationError> simulation(module, "SimulationError", PyExc_RuntimeError);
    const py::exception<netsim::ProtocolError> protocol(module, "ProtocolError", simulation);
    py::register_exception_translator(&translate);
}

}  // namespace proxy_protocol
