// The part of the medium that tells what disturbs a reception: exactly, and from above.
#include "netsim/medium/medium.hpp"

namespace netsim {

double Medium::most_interference_w(RadioId receiver, const Arrival& arrival) const {
    const OnAir& here = on_air_of(arrival);
    double most_w = here.far_w;
    for (const OnAir* other : here.close) {
        if (other->transmission.radio != receiver) {
            most_w += arrival_at(*other, receiver, arrival.place).power_w;
        }
    }
    return most_w * (1 + margin);
}

InterferenceSum& Medium::interference_with(RadioId receiver, const Arrival& arrival, SimTime start,
                                           SimTime end) {
    interference_.begin(start, end);
    if (on_air_.size() <= 1) {
        return interference_;
    }
    const std::uint32_t audience = audience_of(receiver);
    for (const std::unique_ptr<OnAir>& other : on_air_) {
        const Transmission& sent = other->transmission;
        if (&sent == arrival.transmission || sent.radio == receiver || other->last_end <= start ||
            sent.start >= end || other->shares[audience] == 0) {
            continue;
        }
        interference_.add(arrival_at(*other, receiver, arrival.place));
    }
    return interference_;
}

}  // namespace netsim
