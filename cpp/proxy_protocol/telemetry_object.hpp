// The Python Telemetry object that is passed to a protocol, up to a hundred times per second and
// node.
//
// Creating one takes as long as many callbacks. So the last one is reused if the protocol cannot
// notice, as zip() does with its tuples. That is, the protocol did not change the object, and kept no
// reference to it, its fields or its position.
#pragma once

#include <pybind11/pybind11.h>

#include "netsim/geometry/position.hpp"

namespace proxy_protocol {

class TelemetryObject {
public:
    TelemetryObject();

    // Telemetry(current_position=(x, y, z)). Valid until the next call.
    pybind11::handle at(const netsim::Position& position);

private:
    bool is_as_handed_out() const;
    void create();

    pybind11::object class_;
    pybind11::object current_position_;  // the interned name of its field
    pybind11::object telemetry_;         // the last one,
    pybind11::object fields_;            // its __dict__, {"current_position": coordinates_},
    pybind11::object coordinates_;       // and the tuple in it
};

}  // namespace proxy_protocol
