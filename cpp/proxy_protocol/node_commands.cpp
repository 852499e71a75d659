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

// Attribute names, made once for the life of the interpreter.
PyObject* name_of(const char* text) {
    return PyUnicode_InternFromString(text);
}

// What cannot even be taken apart.
class Unreadable : public std::exception {
public:
    const char* what() const noexcept override { return "what was given cannot be read as a command"; }
};

// An attribute of a command. What has none is no command of that kind, but something else that a
// protocol passed by mistake: a text, or a command to its vehicle in the place of one to its radio.
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

// What is wrong with a command, in the words that prototype mode has, too; "" if nothing is.
template <typename... Arguments>
py::object ask(const char* function, const Arguments&... arguments) {
    return py::module_::import("gradysim.encapsulator.refused_commands").attr(function)(arguments...);
}

// Carries out a command. What it refuses is raised as that exception of gradysim.protocol.errors,
// as in every mode. `wrong` asks what is wrong with the command itself; if nothing is, the engine
// has said what is.
template <typename Command, typename Wrong>
void carry_out(const char* exception, Command command, Wrong wrong) {
    std::string words;
    try {
        command();
        return;
    } catch (const netsim::SimulationError& error) {
        words = error.what();
    } catch (const Unreadable& error) {
        words = error.what();
    }
    const py::object told = wrong();
    const py::object type = py::module_::import("gradysim.protocol.errors").attr(exception);
    PyErr_SetObject(type.ptr(), (py::len(told) > 0 ? told : python_from_utf8(words)).ptr());
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
        throw Unreadable();
    }
    const auto check =
        py::module_::import("gradysim.protocol.messages.destination_id").attr("checked_destination");
    return check(value).cast<netsim::NodeId>();
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

void carry_out_mobility(netsim::Node& node, py::handle command) {
    static PyObject* const type_name = name_of("command_type");
    static PyObject* const parameter_names[] = {name_of("param_1"), name_of("param_2"), name_of("param_3")};
    const long type = integer(attribute(command, type_name));
    const auto parameter = [&](int index) { return attribute(command, parameter_names[index]); };
    if (type == goto_coords_type) {
        node.go_to(netsim::Position{number(parameter(0)), number(parameter(1)), number(parameter(2))});
    } else if (type == set_speed_type && parameter(1).is_none() && parameter(2).is_none()) {
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
            return ask("wrong_communication", command, node.id(), ids);
        });
}

void send_mobility_command(netsim::Node& node, py::handle command) {
    carry_out(
        "MasslessMobilityException", [&] { carry_out_mobility(node, command); },
        [&] { return ask("wrong_mobility", command, node.id(), node.can_move()); });
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
        [&] { return ask("wrong_timer", timer, timestamp, node.id(), node.now().seconds()); });
}

void cancel_timer(netsim::Node& node, py::handle timer) {
    carry_out(
        "TimerException", [&] { node.cancel_timer(text(timer)); },
        [&] { return ask("wrong_timer_name", timer); });
}

}  // namespace proxy_protocol
