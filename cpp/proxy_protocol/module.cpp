// The compiled module gradysim._netsim. Python's side of it is described in python/gradysim/_netsim.pyi.
#include <pybind11/pybind11.h>

#include "netsim/error.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;

PYBIND11_MODULE(_netsim, module) {
    module.doc() = "The engine of integrated mode.";
    module.attr("longest_run_s") = netsim::SimTime::longest_run_s;
    py::register_exception<netsim::ConfigError>(module, "ConfigError", PyExc_ValueError);
    py::register_exception<netsim::SimulationError>(module, "SimulationError", PyExc_RuntimeError);
    proxy_protocol::bind_protocol_error(module);
    proxy_protocol::bind_config(module);
    proxy_protocol::bind_propagation(module);
    proxy_protocol::bind_link_budget(module);
    proxy_protocol::bind_random(module);
    proxy_protocol::bind_native_protocols(module);
    proxy_protocol::bind_node(module);
    proxy_protocol::bind_network(module);
}
