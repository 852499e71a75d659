// A node, as used by the provider of its Python protocol.
#include <memory>
#include <string_view>
#include <utility>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/node/node.hpp"
#include "protocols/native_protocols.hpp"
#include "proxy_protocol/bindings.hpp"
#include "proxy_protocol/node_commands.hpp"
#include "proxy_protocol/python_protocol.hpp"

namespace py = pybind11;
using netsim::Node;

namespace proxy_protocol {

namespace {

void observe(Node& node, py::object on_telemetry, py::function on_variable) {
    Node::OnTelemetry report_position;
    if (!on_telemetry.is_none()) {
        report_position = [&node, on_telemetry = std::move(on_telemetry)](const netsim::Position& position) {
            on_telemetry(node.now().ps(), position.x, position.y, position.z);
        };
    }
    node.observe(std::move(report_position),
                 [on_variable = std::move(on_variable)](
                     std::string_view name, const netsim::TrackedValue& value) { on_variable(name, value); });
}

}  // namespace

void bind_node(py::module_& module) {
    py::class_<Node>(module, "Node")
        .def_property_readonly("id", &Node::id)
        .def_property_readonly("name", &Node::name)
        .def_property_readonly("position",
                               [](const Node& node) {
                                   const netsim::Position position = node.position();
                                   return py::make_tuple(position.x, position.y, position.z);
                               })
        .def(
            "set_protocol",
            [](Node& node, py::object protocol, py::object on_failure, bool wants_failed_messages) {
                node.set_protocol(std::make_unique<PythonProtocol>(std::move(protocol), std::move(on_failure),
                                                                   wants_failed_messages));
            },
            py::arg("protocol"), py::arg("on_failure"), py::arg("wants_failed_messages") = false)
        .def("set_native_protocol", &netsim::set_native_protocol, py::arg("name"),
             py::arg("parameters") = netsim::Parameters())
        .def("check_protocol", &Node::check_protocol)
        .def_property_readonly("tracked_variables",
                               [](const Node& node) {
                                   py::dict variables;
                                   for (const auto& [name, value] : node.tracked_variables().values()) {
                                       variables[py::str(name)] = value;
                                   }
                                   return variables;
                               })
        .def("observe", &observe, py::arg("on_telemetry"), py::arg("on_variable"))
        .def("send_communication_command", &send_communication_command, py::arg("command"))
        .def("send_mobility_command", &send_mobility_command, py::arg("command"))
        .def("schedule_timer", &schedule_timer, py::arg("timer"), py::arg("timestamp"))
        .def("cancel_timer", &cancel_timer, py::arg("timer"))
        .def("current_time", [](const Node& node) { return node.now().seconds(); })
        .def("current_time_ps", [](const Node& node) { return node.now().ps(); })
        .def("get_id", &Node::id);
}

}  // namespace proxy_protocol
