// The part of the medium that tells what disturbs a reception: exactly, and from above.
#include <limits>

#include "netsim/medium/medium.hpp"

namespace netsim {

void Medium::bound_interference(OnAir& here, const OnAir& there) const {
    const double most_w = links_.all_isotropic() ? airwaves_.most_brought_w(
                                                       there, here, there.transmission.power_w)(here.reach_m)
                                                 : std::numeric_limits<double>::infinity();
    here.others_w += most_w;
    // From six times the reach away, in free space, the nearest receiver gets twice what the farthest gets.
    constexpr double close = 6;
    if (links_.is_random() || most_w == std::numeric_limits<double>::infinity() ||
        squared_distance(here.transmission.origin, there.transmission.origin) <
            close * close * here.reach_m * here.reach_m) {
        here.close.push_back(&there);
    } else {
        here.far_w += most_w;
    }
}

double Medium::most_interference_w(RadioId receiver, const Arrival& arrival) const {
    const OnAir& here = *arrival.on_air;
    double most_w = here.far_w;
    for (const OnAir* other : here.close) {
        if (other->transmission.radio != receiver) {
            most_w += airwaves_.power_at(*other, receiver, arrival.place, simulator_.now());
        }
    }
    return most_w * (1 + rounding_margin);
}

InterferenceSum& Medium::interference_with(RadioId receiver, const Arrival& arrival, SimTime start,
                                           SimTime end) {
    interference_.begin(start, end);
    if (airwaves_.size() <= 1) {
        return interference_;
    }
    const std::uint32_t audience = links_.audience_of(receiver);
    for (const std::unique_ptr<OnAir>& other : airwaves_.entries()) {
        const Transmission& sent = other->transmission;
        if (&sent == arrival.transmission || sent.radio == receiver || other->last_end <= start ||
            sent.start >= end || other->shares[audience] == 0) {
            continue;
        }
        interference_.add(airwaves_.arrival_at(*other, receiver, arrival.place, simulator_.now()));
    }
    return interference_;
}

}  // namespace netsim
