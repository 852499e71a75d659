// The engine's random streams, for comparison with those of gradysim.encapsulator.random_stream.
#include <cstdint>

#include <pybind11/pybind11.h>

#include "netsim/kernel/random.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

void bind_random(py::module_& module) {
    py::class_<RandomStream>(module, "RandomStream")
        .def(py::init([](std::uint64_t seed, std::uint32_t node, std::uint32_t purpose) {
                 return RandomStream(seed, node, Purpose{purpose});
             }),
             py::arg("seed"), py::arg("node"), py::arg("purpose"))
        .def("next_u32", &RandomStream::next_u32)
        .def("uniform", py::overload_cast<>(&RandomStream::uniform));
}

}  // namespace proxy_protocol
