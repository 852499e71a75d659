// The table of native protocols, for gradysim.integrated.native_protocols and the reader of .ini
// files.
#include <string>
#include <variant>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "protocols/native_protocols.hpp"
#include "proxy_protocol/bindings.hpp"

namespace py = pybind11;
using namespace netsim;

namespace proxy_protocol {

void bind_native_protocols(py::module_& module) {
    py::class_<Parameter>(module, "Parameter")
        .def_readonly("name", &Parameter::name)
        .def_readonly("default", &Parameter::default_value)
        .def_readonly("unit", &Parameter::unit)
        .def_readonly("meaning", &Parameter::meaning);
    py::class_<NativeProtocol>(module, "NativeProtocol")
        .def_readonly("name", &NativeProtocol::name)
        .def_readonly("meaning", &NativeProtocol::meaning)
        .def_readonly("python_class", &NativeProtocol::python_class)
        .def_readonly("parameters", &NativeProtocol::parameters);
    module.def("native_protocols", &native_protocols, py::return_value_policy::reference);
}

}  // namespace proxy_protocol
