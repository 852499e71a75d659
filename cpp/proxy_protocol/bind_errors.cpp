// The engine's exceptions as Python exceptions. Messages may contain file names, and so any bytes. An
// error of a native protocol has its node, callback and time.
#include <cstring>
#include <exception>
#include <utility>
#include <variant>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/error.hpp"
#include "netsim/node/protocol_error.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;

namespace proxy_protocol {

namespace {

// Bytes that are not UTF-8 become surrogate escapes, as in Python's file names.
py::object text_of(const char* what) {
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(what, static_cast<Py_ssize_t>(std::strlen(what)), "surrogateescape"));
}

py::object exception_of(const char* name, const std::exception& error) {
    return py::module_::import("gradysim._netsim").attr(name)(text_of(error.what()));
}

// Converts a part to a str, (value, unit) or (full name of a field,).
struct PythonPart {
    py::object operator()(const std::string& text) const { return text_of(text.c_str()); }
    py::object operator()(const netsim::Quantity& quantity) const {
        return py::make_tuple(quantity.value, quantity.unit);
    }
    py::object operator()(const netsim::FieldName& field) const { return py::make_tuple(field.name); }
};

void set_problem(const py::object& exception, const netsim::Problem& problem) {
    py::list message;
    for (const netsim::MessagePart& part : problem.message) {
        message.append(std::visit(PythonPart{}, part));
    }
    exception.attr("field") = problem.field;
    exception.attr("value") = std::visit(PythonPart{}, problem.value);
    exception.attr("message") = message;
    exception.attr("compared_with") = problem.compared_with;
    exception.attr("interface") = problem.interface;
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
        const py::object exception = exception_of("ConfigError", error);
        const netsim::Problem* problem = error.problem();
        const netsim::Problem plain{"", "", {std::string(error.what())}};
        set_problem(exception, problem == nullptr ? plain : *problem);
        set(exception);
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
