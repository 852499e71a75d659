// Observer of one radio, for capture files. It does not change the run. For a radio without an
// observer, the cost is one test per frame.
#pragma once

#include "netsim/medium/arrival.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class RadioObserver {
public:
    // The radio starts to transmit. Of the fields that the medium fills in, only the start is set.
    virtual void transmitted(const Transmission& transmission) = 0;
    // A frame that the radio was locked on to has ended. `noise_w`: background noise, without
    // interference.
    virtual void received(const Arrival& arrival, double noise_w, bool decoded) = 0;

protected:
    ~RadioObserver() = default;
};

}  // namespace netsim
