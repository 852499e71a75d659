#include "proxy_protocol/node_commands.hpp"

#include <cmath>
#include <cstdint>
#include <exception>
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

// An interned attribute name. Create it once: it is never released.
PyObject* name_of(const char* text) {
    return PyUnicode_InternFromString(text);
}

// Thrown if the argument does not have the attributes of a command, or one of them has the wrong type.
class Unreadable : public std::exception {
public:
    const char* what() const noexcept override { return "the argument cannot be read as a command"; }
};

// Returns an attribute of a command. An argument without it is not a command, but a str, for example.
py::object attribute(py::handle command, PyObject* name) {
    PyObject* value = PyObject_GetAttr(command.ptr(), name);
    if (value == nullptr) {
        if (!PyErr_ExceptionMatches(PyExc_AttributeError)) {
            throw py::error_already_set();
        }
        PyErr_Clear();
        throw Unreadable();
    }
    return py::reinterpret_steal<py::object>(value);
}

long integer(py::handle value) {
    int overflow = 0;
    const long number = PyLong_Check(value.ptr()) ? PyLong_AsLongAndOverflow(value.ptr(), &overflow) : -1;
    if (!PyLong_Check(value.ptr()) || overflow != 0) {
        throw Unreadable();
    }
    return number;
}

double number(py::handle value) {
    const double result = PyFloat_AsDouble(value.ptr());
    if (result == -1.0 && PyErr_Occurred()) {
        PyErr_Clear();
        throw Unreadable();
    }
    return result;
}

std::string text(py::handle value) {
    if (!PyUnicode_Check(value.ptr())) {
        throw Unreadable();
    }
    return utf8_from_python(value);
}

// Calls a function of the validation module, which both modes share.
template <typename... Arguments>
py::object validation(const char* function, const Arguments&... arguments) {
    return py::module_::import("gradysim.encapsulator.validation").attr(function)(arguments...);
}

// Carries out a command. If it fails, raises the named exception of gradysim.protocol.errors. `wrong`
// returns what is wrong with the command; if that is "", the engine's error message is used.
template <typename Command, typename Wrong>
void carry_out(const char* exception, Command command, Wrong wrong) {
    std::string engine_message;
    try {
        command();
        return;
    } catch (const netsim::SimulationError& error) {
        engine_message = error.what();
    } catch (const Unreadable& error) {
        engine_message = error.what();
    }
    const py::object problem = wrong();
    const py::object type = py::module_::import("gradysim.protocol.errors").attr(exception);
    PyErr_SetObject(type.ptr(), (py::len(problem) > 0 ? problem : python_from_utf8(engine_message)).ptr());
    throw py::error_already_set();
}

// A user-defined command may lack the attribute `interface`. It is sent through wlan[0].
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
    if (PyLong_CheckExact(value.ptr())) {  // excludes bool
        int overflow = 0;
        const long index = PyLong_AsLongAndOverflow(value.ptr(), &overflow);
        if (index >= 0 && index < netsim::most_interfaces) {
            return static_cast<std::int32_t>(index);
        }
    }
    return validation("checked_interface", value).cast<std::int32_t>();
}

// A node's id, from an int or another number such as a NumPy integer.
netsim::NodeId destination_of(py::handle value) {
    if (PyLong_Check(value.ptr())) {
        int overflow = 0;
        const long id = PyLong_AsLongAndOverflow(value.ptr(), &overflow);
        if (overflow == 0 && std::in_range<netsim::NodeId>(id)) {
            return static_cast<netsim::NodeId>(id);
        }
        throw Unreadable();
    }
    return validation("checked_destination", value).cast<netsim::NodeId>();
}

void carry_out_communication(netsim::Node& node, py::handle command) {
    static PyObject* const type_name = name_of("command_type");
    static PyObject* const message_name = name_of("message");
    static PyObject* const destination_name = name_of("destination");
    const long type = integer(attribute(command, type_name));
    const auto interface = interface_of(command);
    auto payload = std::make_shared<const std::string>(text(attribute(command, message_name)));
    if (type == broadcast_type) {
        node.broadcast(std::move(payload), interface);
        return;
    }
    if (type != send_type) {
        throw Unreadable();
    }
    const py::object destination = attribute(command, destination_name);
    if (destination.is_none()) {
        throw Unreadable();
    }
    node.send(destination_of(destination), std::move(payload), interface);
}

// Whether SET_SPEED sets a speed, not a velocity. In gradysim 0.7, unused parameters are 0.
bool is_speed(py::handle command, const py::object& second, const py::object& third) {
    return (second.is_none() && third.is_none()) || validation("is_speed", command).cast<bool>();
}

void carry_out_mobility(netsim::Node& node, py::handle command) {
    static PyObject* const type_name = name_of("command_type");
    static PyObject* const parameter_names[] = {name_of("param_1"), name_of("param_2"), name_of("param_3")};
    const long type = integer(attribute(command, type_name));
    const auto parameter = [&](int index) { return attribute(command, parameter_names[index]); };
    if (type == goto_coords_type) {
        node.go_to(netsim::Position{number(parameter(0)), number(parameter(1)), number(parameter(2))});
    } else if (type == set_speed_type && is_speed(command, parameter(1), parameter(2))) {
        node.set_speed(number(parameter(0)));
    } else {
        throw Unreadable();
    }
}

}  // namespace

void send_communication_command(netsim::Node& node, py::handle command) {
    carry_out(
        "CommunicationException", [&] { carry_out_communication(node, command); },
        [&] {
            const auto ids = py::module_::import("builtins").attr("range")(node.node_count());
            return validation("wrong_communication", command, node.id(), ids);
        });
}

void send_mobility_command(netsim::Node& node, py::handle command) {
    carry_out(
        "MasslessMobilityException", [&] { carry_out_mobility(node, command); },
        [&] { return validation("wrong_mobility", command, node.id(), node.can_move()); });
}

void schedule_timer(netsim::Node& node, py::handle timer, py::handle timestamp) {
    carry_out(
        "TimerException",
        [&] {
            std::string name = text(timer);
            const double time_s = number(timestamp);
            if (!std::isfinite(time_s)) {
                throw Unreadable();
            }
            node.schedule_timer(std::move(name), netsim::SimTime::of_event(time_s, node.now()));
        },
        [&] { return validation("wrong_timer", timer, timestamp, node.id(), node.now().seconds()); });
}

void cancel_timer(netsim::Node& node, py::handle timer) {
    carry_out(
        "TimerException", [&] { node.cancel_timer(text(timer)); },
        [&] { return validation("wrong_timer_name", timer); });
}

}  // namespace proxy_protocol
