#include "proxy_protocol/telemetry_object.hpp"

#include <bit>
#include <cstdint>

namespace py = pybind11;

namespace proxy_protocol {

TelemetryObject::TelemetryObject()
    : class_(py::module_::import("gradysim.protocol.messages.telemetry").attr("Telemetry")),
      current_position_(py::reinterpret_steal<py::object>(PyUnicode_InternFromString("current_position"))) {}

py::handle TelemetryObject::at(const netsim::Position& position) {
    if (!is_as_handed_out()) {
        create();
    }
    const double values[] = {position.x, position.y, position.z};
    for (Py_ssize_t axis = 0; axis < 3; ++axis) {
        PyObject* old = PyTuple_GET_ITEM(coordinates_.ptr(), axis);
        if (old != nullptr && std::bit_cast<std::uint64_t>(PyFloat_AS_DOUBLE(old)) ==
                                  std::bit_cast<std::uint64_t>(values[axis])) {
            continue;  // vehicles often stand still or fly along an axis
        }
        PyTuple_SET_ITEM(coordinates_.ptr(), axis, py::float_(values[axis]).release().ptr());
        Py_XDECREF(old);
    }
#if PY_VERSION_HEX >= 0x030E0000
    // Reset the cached hash of the last position.
    reinterpret_cast<PyTupleObject*>(coordinates_.ptr())->ob_hash = -1;
#endif
    return telemetry_;
}

bool TelemetryObject::is_as_handed_out() const {
    // Expected references: one of this object to each, and one of each to the next.
    return telemetry_ && Py_REFCNT(telemetry_.ptr()) == 1 && Py_REFCNT(fields_.ptr()) == 2 &&
           Py_REFCNT(coordinates_.ptr()) == 2 && PyDict_GET_SIZE(fields_.ptr()) == 1 &&
           PyDict_GetItemWithError(fields_.ptr(), current_position_.ptr()) == coordinates_.ptr();
}

void TelemetryObject::create() {
    coordinates_ = py::tuple(3);
    auto* type = reinterpret_cast<PyTypeObject*>(class_.ptr());
    telemetry_ = py::reinterpret_steal<py::object>(type->tp_new(type, py::tuple().ptr(), nullptr));
    if (!telemetry_ || PyObject_SetAttr(telemetry_.ptr(), current_position_.ptr(), coordinates_.ptr()) != 0) {
        throw py::error_already_set();
    }
    fields_ = py::reinterpret_steal<py::object>(PyObject_GenericGetDict(telemetry_.ptr(), nullptr));
    if (!fields_) {
        throw py::error_already_set();
    }
}

}  // namespace proxy_protocol
