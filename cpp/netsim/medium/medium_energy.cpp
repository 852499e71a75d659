// The part of the medium that finds the radios at which several transmissions, none of which matters alone, make the
// channel busy together.
#include <algorithm>
#include <cmath>
#include <limits>

#include "netsim/medium/medium.hpp"

namespace netsim {

void Medium::find_those_beside(const OnAir& newest) {
    const Transmission& sent = newest.transmission;
    beside_.clear();
    for (const std::unique_ptr<OnAir>& other : on_air_) {
        if (other.get() == &newest || other->last_end <= sent.start) {
            continue;
        }
        // At any receiver, the ends of two frames are shifted against each other by at most the distance of their
        // senders (triangle inequality), and by what the receiver moved in between.
        const Transmission& earlier = other->transmission;
        const double shift_m = distance(earlier.origin, sent.origin) + newest.odometer_m - other->odometer_m;
        if (earlier.start + earlier.duration + most_propagation_delay(shift_m * (1 + 1e-9)) > sent.start) {
            beside_.push_back(other.get());
        }
    }
}

// Of k powers that reach the level together, the largest reaches a k-th of it. So it is enough to look around each
// of the senders, as far as it is received with that power: and less far, where the others are far away.
void Medium::tell_where_energy_adds_up(OnAir& newest, const Audience& audience) {
    const SimTime now = simulator_.now();
    ++checks_;
    searches_.clear();
    searches_.push_back(Search{&newest, 0, 0});
    for (OnAir* other : beside_) {
        if (other->transmission.band.fits_in(audience.band)) {
            searches_.push_back(Search{other, 0, 0});
        }
    }
    if (searches_.size() == 1) {
        return;
    }
    for (Search& search : searches_) {
        narrow(search, audience);
    }
    for (const Search& search : searches_) {
        const Transmission& strongest = search.on_air->transmission;
        const double moved_m = odometer_.reading_m(now) - search.on_air->odometer_m;
        const double radius_m = search.radius_m + moved_m;
        const double loud_to_all_m = std::max(loud_to_all_m_of(strongest, audience) - moved_m, 0.0);
        audience.members.visit(strongest.origin, radius_m, [&](NodeId node, const Position& place) {
            const double squared_m2 = squared_distance(strongest.origin, place);
            if (squared_m2 > radius_m * radius_m || squared_m2 < loud_to_all_m * loud_to_all_m) {
                return;
            }
            Attached& attached = attached_[node];
            if (attached.checks == checks_ || node == newest.transmission.sender ||
                node == strongest.sender) {
                return;
            }
            const Receiver& receiver = attached.receiver;
            // Up to rounding, that is, for which there is a margin on both sides.
            const double received_w =
                moved_m > 0 || !odometer_.all_stand()
                    ? arrival_at(strongest, node).power_w
                    : power_w(strongest, node, place, distance(strongest.origin, place));
            if (is_loud(receiver, received_w * (1 - 1e-9)) ||
                (receiver.noise_w + received_w + search.others_w) * (1 + 1e-9) <
                    receiver.energy_detection_w) {
                return;
            }
            attached.checks = checks_;
            tell_if_energy_adds_up(node, newest);
        });
    }
}

// Who is nearer is told of the transmission even if it is alone: the inner edge of the ring in which it takes others to
// matter. 0 where that depends on more than the distance.
double Medium::loud_to_all_m_of(const Transmission& transmission, const Audience& audience) const {
    constexpr double more = 1 + 1e-8;  // for rounding
    if (!antennas_.all_isotropic()) {
        return 0;
    }
    return propagation_.sure_reach_m(audience.most_energy_w * more / transmission.power_w,
                                     transmission.band.carrier_hz) /
           more;
}

// Rings around the sender are excluded from outside: in none of them can its power and those of the others, each at
// most as large, reach the level.
void Medium::narrow(Search& search, const Audience& audience) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double less = 1 - 1e-9;  // for rounding
    const Transmission& here = search.on_air->transmission;
    const double level_w = audience.least_energy_w * less;
    const double share_w = level_w / static_cast<double>(searches_.size());
    search.others_w = infinite;
    search.radius_m = share_w > 0 ? reach_of_power_m(here, audience, share_w) : infinite;
    if (!(search.radius_m < infinite)) {
        return;
    }
    between_m_.clear();
    for (const Search& other : searches_) {
        const double moved_m = std::abs(other.on_air->odometer_m - search.on_air->odometer_m);
        const double distance_m = distance(here.origin, other.on_air->transmission.origin);
        between_m_.push_back(distance_m * less - moved_m);
    }
    // What the others can bring within `within_m`, each at most `most_w`.
    const auto others_w = [&](double within_m, double most_w, double enough_w) {
        double sum_w = 0;
        for (std::size_t i = 0; i < searches_.size() && sum_w < enough_w; ++i) {
            const Transmission& there = searches_[i].on_air->transmission;
            if (&there != &here) {
                const double least_m = std::max(between_m_[i] - within_m, 0.0);
                sum_w += std::min(most_w, most_power_w(there, audience) *
                                              propagation_.most_gain_beyond(least_m, there.band.carrier_hz));
            }
        }
        return sum_w;
    };
    const double loud_m = reach_of_power_m(here, audience, audience.least_energy_w);
    // Each ring is optional, so their number may be limited: with extreme powers there could be thousands.
    constexpr int most_rings = 100;
    for (int ring = 0; ring < most_rings && search.radius_m > loud_m; ++ring) {
        constexpr double step = 0.75;
        const double inner_m = std::max(step * search.radius_m, loud_m);
        const double most_w = most_power_w(here, audience) *
                              propagation_.most_gain_beyond(inner_m * less, here.band.carrier_hz);
        if (most_w + others_w(search.radius_m, most_w, level_w) >= level_w) {
            break;
        }
        search.radius_m = inner_m;
    }
    // Within the last ring it has to bring what the others leave to be brought.
    const double rest_w = level_w - others_w(search.radius_m, infinite, level_w);
    if (rest_w > 0) {
        search.radius_m = std::min(search.radius_m, reach_of_power_m(here, audience, rest_w));
    }
    search.others_w = others_w(search.radius_m, infinite, audience.most_energy_w);
    if (search.others_w >= audience.most_energy_w) {
        search.others_w = infinite;
    }
}

void Medium::tell_if_energy_adds_up(NodeId node, OnAir& newest) {
    const Receiver& receiver = attached_[node].receiver;
    const Arrival arrival = arrival_at(newest.transmission, node);
    if (is_loud(receiver, arrival.power_w)) {
        return;
    }
    double sum_w = receiver.noise_w + arrival.power_w;
    together_.clear();
    if (!is_told_alone(receiver, arrival.power_w)) {
        together_.emplace_back(&newest, arrival);
    }
    for (OnAir* other : beside_) {
        if (other->transmission.sender == node || !other->transmission.band.fits_in(receiver.band)) {
            continue;
        }
        const Arrival beside = arrival_at(other->transmission, node);
        if (beside.end <= arrival.start || beside.start >= arrival.end || is_loud(receiver, beside.power_w)) {
            continue;
        }
        sum_w += beside.power_w;
        if (!is_told_alone(receiver, beside.power_w) &&
            std::find(other->told_later.begin(), other->told_later.end(), node) == other->told_later.end()) {
            together_.emplace_back(other, beside);
        }
    }
    // To be told for nothing does no harm, so that rounding need not be known.
    if (sum_w * (1 + 1e-12) < receiver.energy_detection_w) {
        return;
    }
    for (auto& [on_air, unnoticed] : together_) {
        on_air->told_later.push_back(node);
        tell(node, *on_air, unnoticed);
    }
}

}  // namespace netsim
