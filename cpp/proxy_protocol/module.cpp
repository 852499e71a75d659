// The compiled module gradysim._netsim. python/gradysim/_netsim.pyi declares its Python interface.
#include <pybind11/pybind11.h>

#include "netsim/kernel/sim_time.hpp"
#include "proxy_protocol/bindings.hpp"

PYBIND11_MODULE(_netsim, module) {
    module.doc() = "The engine of integrated mode.";
    module.attr("longest_run_s") = netsim::SimTime::longest_run_s;
    proxy_protocol::bind_errors(module);
    proxy_protocol::bind_config(module);
    proxy_protocol::bind_propagation(module);
    proxy_protocol::bind_link_budget(module);
    proxy_protocol::bind_random(module);
    proxy_protocol::bind_native_protocols(module);
    proxy_protocol::bind_node(module);
    proxy_protocol::bind_replay(module);
    proxy_protocol::bind_network(module);
}
