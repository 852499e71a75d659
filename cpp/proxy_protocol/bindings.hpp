// One function per topic. module.cpp calls all of them.
#pragma once

#include <pybind11/pybind11.h>

namespace proxy_protocol {

void bind_errors(pybind11::module_& module);
void bind_config(pybind11::module_& module);
void bind_propagation(pybind11::module_& module);
void bind_link_budget(pybind11::module_& module);
void bind_random(pybind11::module_& module);
void bind_native_protocols(pybind11::module_& module);
void bind_node(pybind11::module_& module);
void bind_replay(pybind11::module_& module);
void bind_network(pybind11::module_& module);

}  // namespace proxy_protocol
