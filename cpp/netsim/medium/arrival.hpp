// The arrival of a transmission at one receiver.
#pragma once

#include "netsim/geometry/position.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

struct ActiveTransmission;  // active_transmissions.hpp

struct Arrival {
    const Transmission* transmission = nullptr;
    SimTime start;
    SimTime end;
    double power_w = 0;
    Position place{};       // of the receiver, when the transmission started
    bool lockable = false;  // reaches the sensitivity, on the receiver's channel and in a known format
    const ActiveTransmission* active = nullptr;  // the medium's state of the transmission; opaque to radios
};

}  // namespace netsim
