// A failure of a native protocol, as an exception that knows where in the run it happened.
#include <exception>
#include <utility>

#include <pybind11/pybind11.h>

#include "netsim/node/protocol_error.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;

namespace proxy_protocol {

namespace {

void translate(std::exception_ptr pending) {
    try {
        std::rethrow_exception(std::move(pending));
    } catch (const netsim::ProtocolError& error) {
        const py::object type = py::module_::import("gradysim._netsim").attr("ProtocolError");
        const py::object exception = type(error.what());
        exception.attr("node_id") = error.node();
        exception.attr("callback") = error.callback();
        exception.attr("time_s") = error.time().seconds();
        PyErr_SetObject(type.ptr(), exception.ptr());
    }
}

}  // namespace

void bind_protocol_error(py::module_& module) {
    const py::exception<netsim::ProtocolError> type(module, "ProtocolError", module.attr("SimulationError"));
    py::register_exception_translator(&translate);
}

}  // namespace proxy_protocol
