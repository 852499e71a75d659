// Somebody who looks on at one radio: capture files. Changes nothing, and a radio without one pays one test per frame.
#pragma once

#include "netsim/medium/arrival.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class RadioObserver {
public:
    // The radio begins to send; of what the medium fills in, only the start is known.
    virtual void transmitted(const Transmission& transmission) = 0;
    // A frame that the radio was locked on to until its end has ended, decoded or not. `noise_w` is the background
    // noise, without the interference of other frames.
    virtual void received(const Arrival& arrival, double noise_w, bool decoded) = 0;

protected:
    ~RadioObserver() = default;
};

}  // namespace netsim
