// Link budgets: the success of a frame over distance, to choose a transmit power.
#include <pybind11/pybind11.h>

#include "netsim/node/link_budget.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

void bind_link_budget(py::module_& module) {
    py::class_<LinkBudget>(module, "LinkBudget")
        .def(py::init<const MediumConfig&, const NodeConfig&, const NodeConfig&, int, std::size_t>(),
             py::arg("medium"), py::arg("sender"), py::arg("receiver"), py::arg("payload_bytes"),
             py::arg("interface") = 0)
        .def("reception_ratio", py::overload_cast<double, double>(&LinkBudget::reception_ratio, py::const_),
             py::arg("distance_m"), py::arg("tx_power_w"))
        .def("tx_power_w_for", &LinkBudget::tx_power_w_for, py::arg("range_m"), py::arg("ratio"))
        .def("mean_gain", &LinkBudget::mean_gain, py::arg("distance_m"))
        .def_property_readonly("tx_power_w", &LinkBudget::tx_power_w)
        .def_property_readonly("bitrate_bps", &LinkBudget::bitrate_bps)
        .def_property_readonly("psdu_bytes", &LinkBudget::psdu_bytes)
        .def_property_readonly("noise_w", &LinkBudget::noise_w);
}

}  // namespace proxy_protocol
