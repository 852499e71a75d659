#include "proxy_protocol/node_commands.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "netsim/config/node_config.hpp"
#include "netsim/error.hpp"
#include "proxy_protocol/python_text.hpp"

namespace py = pybind11;

namespace proxy_protocol {

namespace {

// Values of the enumerations in gradysim.protocol.messages.
constexpr long send_type = 0;
constexpr long broadcast_type = 1;
constexpr long goto_coords_type = 1;
constexpr long set_speed_type = 3;

// Attribute names, made once for the life of the interpreter.
PyObject* name_of(const char* text) {
    return PyUnicode_InternFromString(text);
}

// An attribute of a command. What has none is no command of the kind `expected`, but something else that a protocol
// passed by mistake: a text, or a command to its vehicle in the place of one to its radio.
py::object attribute(py::handle command, PyObject* name, const char* expected) {
    PyObject* value = PyObject_GetAttr(command.ptr(), name);
    if (value == nullptr) {
        if (!PyErr_ExceptionMatches(PyExc_AttributeError)) {
            throw py::error_already_set();
        }
        PyErr_Clear();
        throw py::type_error("a " + std::string(expected) + " was expected, not " +
                             std::string(py::repr(command)));
    }
    return py::reinterpret_steal<py::object>(value);
}

long integer(py::handle value, const char* what) {
    const long number = PyLong_Check(value.ptr()) ? PyLong_AsLong(value.ptr()) : -1;
    if (number == -1) {
        const bool is_minus_one = PyLong_Check(value.ptr()) && !PyErr_Occurred();
        PyErr_Clear();
        if (!is_minus_one) {
            throw py::type_error(std::string(what) + " must be an int, not " + std::string(py::repr(value)));
        }
    }
    return number;
}

double number(py::handle value, const char* what, const char* expected = "a number") {
    const double result = PyFloat_AsDouble(value.ptr());
    if (result == -1.0 && PyErr_Occurred()) {
        PyErr_Clear();
        throw py::type_error(std::string(what) + " must be " + expected + ", not " +
                             std::string(py::repr(value)));
    }
    return result;
}

// Carries out a command. What it refuses is raised as that exception of gradysim.protocol.errors, as in every mode.
template <typename Command>
void carry_out(const char* exception, Command command) {
    std::string text;
    try {
        command();
        return;
    } catch (const netsim::SimulationError& error) {
        text = error.what();
    } catch (const py::builtin_exception& error) {
        text = error.what();
    }
    const py::object type = py::module_::import("gradysim.protocol.errors").attr(exception);
    PyErr_SetString(type.ptr(), text.c_str());
    throw py::error_already_set();
}

// That of commands of one's own, which may have none, is the first.
std::int32_t interface_of(py::handle command) {
    static PyObject* const interface_name = name_of("interface");
    const auto value = py::reinterpret_steal<py::object>(PyObject_GetAttr(command.ptr(), interface_name));
    if (!value) {
        if (!PyErr_ExceptionMatches(PyExc_AttributeError)) {
            throw py::error_already_set();
        }
        PyErr_Clear();
        return 0;
    }
    if (PyLong_CheckExact(value.ptr())) {  // which True is not
        int overflow = 0;
        const long index = PyLong_AsLongAndOverflow(value.ptr(), &overflow);
        if (index >= 0 && index < netsim::most_interfaces) {
            return static_cast<std::int32_t>(index);
        }
    }
    // What is wrong is said in Python, since prototype mode says the same.
    const auto check =
        py::module_::import("gradysim.protocol.messages.interface_index").attr("checked_interface");
    return check(value).cast<std::int32_t>();
}

// The id of a node, or what equals one, as an integer of NumPy does.
netsim::NodeId destination_of(py::handle value) {
    if (PyLong_Check(value.ptr())) {
        int overflow = 0;
        const long id = PyLong_AsLongAndOverflow(value.ptr(), &overflow);
        if (overflow == 0 && std::in_range<netsim::NodeId>(id)) {
            return static_cast<netsim::NodeId>(id);
        }
    }
    const auto check =
        py::module_::import("gradysim.protocol.messages.destination_id").attr("checked_destination");
    return check(value).cast<netsim::NodeId>();
}

void carry_out_communication(netsim::Node& node, py::handle command) {
    static PyObject* const type_name = name_of("command_type");
    static PyObject* const message_name = name_of("message");
    static PyObject* const destination_name = name_of("destination");
    const auto value_of = [&](PyObject* name) { return attribute(command, name, "CommunicationCommand"); };
    const long type = integer(value_of(type_name), "command_type");
    const auto interface = interface_of(command);
    auto payload = std::make_shared<const std::string>(utf8_from_python(value_of(message_name), "a message"));
    if (type == broadcast_type) {
        node.broadcast(std::move(payload), interface);
        return;
    }
    if (type != send_type) {
        throw py::value_error("command_type " + std::to_string(type) +
                              " is not a CommunicationCommandType: expected SEND (0) or BROADCAST (1)");
    }
    const py::object destination = value_of(destination_name);
    if (destination.is_none()) {
        throw py::value_error("a SEND command needs a destination: the id of a node");
    }
    node.send(destination_of(destination), std::move(payload), interface);
}

void carry_out_mobility(netsim::Node& node, py::handle command) {
    static PyObject* const type_name = name_of("command_type");
    static PyObject* const parameter_names[] = {name_of("param_1"), name_of("param_2"), name_of("param_3")};
    const auto value_of = [&](PyObject* name) { return attribute(command, name, "MobilityCommand"); };
    const long type = integer(value_of(type_name), "command_type");
    const auto parameter = [&](int index, const char* what) {
        return number(value_of(parameter_names[index]), what);
    };
    if (type == goto_coords_type) {
        node.go_to(netsim::Position{parameter(0, "x (metres)"), parameter(1, "y (metres)"),
                                    parameter(2, "z (metres)")});
    } else if (type == set_speed_type) {
        if (!value_of(parameter_names[1]).is_none()) {
            const auto component = [&](int index) {
                return std::string(py::repr(value_of(parameter_names[index])));
            };
            throw py::value_error("a velocity, (" + component(0) + ", " + component(1) + ", " + component(2) +
                                  "), was given to a vehicle that takes a speed and a target");
        }
        node.set_speed(parameter(0, "speed (m/s)"));
    } else {
        throw py::value_error(
            "command_type " + std::to_string(type) +
            " is not a MobilityCommandType: expected GOTO_COORDS (1), GOTO_GEO_COORDS (2) or SET_SPEED (3)");
    }
}

}  // namespace

void send_communication_command(netsim::Node& node, py::handle command) {
    carry_out("CommunicationException", [&] { carry_out_communication(node, command); });
}

void send_mobility_command(netsim::Node& node, py::handle command) {
    carry_out("MasslessMobilityException", [&] { carry_out_mobility(node, command); });
}

void schedule_timer(netsim::Node& node, py::handle timer, py::handle timestamp) {
    carry_out("TimerException", [&] {
        std::string name = utf8_from_python(timer, "a timer's name");
        const double time_s = number(timestamp, "timestamp", "a number of seconds");
        if (!std::isfinite(time_s)) {
            throw py::value_error("cannot set timer '" + name + "' for " + std::string(py::repr(timestamp)) +
                                  ": expected a finite number of seconds");
        }
        node.schedule_timer(std::move(name), netsim::SimTime::of_event(time_s));
    });
}

void cancel_timer(netsim::Node& node, py::handle timer) {
    carry_out("TimerException", [&] { node.cancel_timer(utf8_from_python(timer, "a timer's name")); });
}

}  // namespace proxy_protocol
