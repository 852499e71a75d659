// The Telemetry of Python that a protocol is handed, up to a hundred times a second for each node.
//
// To make one takes as long as many a callback. So the last one is used again, as zip() does with its tuples, if nobody can
// tell it from a new one: nobody has kept it, its fields or its position, and nothing was written on it.
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
    void make_anew();

    pybind11::object class_;
    pybind11::object current_position_;  // the interned name of its field
    pybind11::object telemetry_;         // the last one,
    pybind11::object fields_;            // its __dict__, {"current_position": coordinates_},
    pybind11::object coordinates_;       // and the tuple in it
};

}  // namespace proxy_protocol
