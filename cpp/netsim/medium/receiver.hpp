// What the medium knows of those who hear: their radios' receivers.
#pragma once

#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/transmission.hpp"
#include "netsim/mobility/trajectory.hpp"

namespace netsim {

// The side of a radio that the medium speaks to.
class MediumListener {
public:
    virtual void arrival_started(const Arrival& arrival) = 0;
    virtual void arrival_ended(const Arrival& arrival) = 0;

protected:
    ~MediumListener() = default;
};

// What a receiver can hear. Mostly all of a network have the same.
struct ReceiverKind {
    Band band;
    double sensitivity_w = 0;       // the least power it can lock on to
    double energy_detection_w = 0;  // noise and signals together that make its channel busy
    double noise_w = 0;             // in its band when nobody sends
    // So long it may leave out of the energy a frame that it can lock on to.
    SimTime detection_time = SimTime::from_ps(0);
    PpduFormats formats = PpduFormats::all();

    bool operator==(const ReceiverKind&) const = default;
};

struct Receiver {
    MediumListener* listener = nullptr;
    const Trajectory* trajectory = nullptr;
    ReceiverKind kind;
};

}  // namespace netsim
