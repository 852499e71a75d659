// The engine's propagation and antennas, for link budgets and verification.
#include <array>
#include <cstdint>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "netsim/error.hpp"
#include "netsim/phy/antenna.hpp"
#include "netsim/propagation/propagation.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

namespace {

Propagation make_propagation(const MediumConfig& config, std::uint64_t seed) {
    config.validate();
    if (config.type_name == unit_disk_medium) {
        throw ConfigError(
            {"medium.typename", "\"" + config.type_name + "\"", {"expected a medium with a path loss"}});
    }
    return {config, seed};
}

double gain(const Propagation& propagation, const std::array<double, 3>& from_position,
            const std::array<double, 3>& to_position, double carrier_hz, NodeId from_node, NodeId to_node,
            double time, std::uint64_t transmission) {
    Transmission sent;
    sent.label.number = transmission;
    sent.sender.node = from_node;
    sent.start = SimTime::from_seconds(time);
    sent.band.carrier_hz = carrier_hz;
    sent.origin = {from_position[0], from_position[1], from_position[2]};
    const Position place{to_position[0], to_position[1], to_position[2]};
    return propagation.gain(sent, InterfaceId{to_node, 0}, place, distance(sent.origin, place));
}

}  // namespace

void bind_propagation(py::module_& module) {
    module.def(
        "antenna_gain",
        [](const AntennaConfig& config, double carrier_hz, const std::array<double, 3>& direction) {
            config.validate(carrier_hz);
            const auto pattern = make_antenna(config, carrier_hz);
            return pattern ? pattern->gain({direction[0], direction[1], direction[2]}) : 1.0;
        },
        py::arg("config"), py::arg("carrier_hz"), py::arg("direction"));

    py::class_<Propagation>(module, "Propagation")
        .def(py::init(&make_propagation), py::arg("config"), py::arg("seed"))
        .def("gain", &gain, py::arg("from_position"), py::arg("to_position"), py::arg("carrier_hz"),
             py::arg("from_node") = 0, py::arg("to_node") = 1, py::arg("time") = 0.0,
             py::arg("transmission") = 0)
        .def("reach_m", &Propagation::reach_m, py::arg("gain"), py::arg("carrier_hz"))
        .def("most_gain_beyond", &Propagation::max_gain_beyond, py::arg("distance_m"), py::arg("carrier_hz"));
}

}  // namespace proxy_protocol
