// Observer of one radio, for capture files. It does not change the run. A radio without one pays
// one test per frame.
#pragma once

#include "netsim/medium/arrival.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class RadioObserver {
public:
    // The radio begins to send. Of the fields that the medium fills in, only the start is set.
    virtual void transmitted(const Transmission& transmission) = 0;
    // A frame ended that the radio was locked on to, decoded or not. `noise_w`: background noise,
    // without interference.
    virtual void received(const Arrival& arrival, double noise_w, bool decoded) = 0;

protected:
    ~RadioObserver() = default;
};

}  // namespace netsim
