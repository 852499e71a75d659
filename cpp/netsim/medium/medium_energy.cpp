// The part of the medium that finds the radios at which several transmissions, none of which matters alone, make the
// channel busy together.
//
// Each transmission has rings of receivers that it has to watch (energy_ring.hpp), one for each audience. At each of
// them, as long as the transmission lasts there, one of two things holds at any moment: the radio was told of enough to
// find its channel busy, or all that is on the air stays below the level, by what the ring says is missing.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <ranges>

#include "netsim/medium/medium.hpp"

namespace netsim {

namespace {

// Bounds are taken so much larger and levels so much lower, for rounding.
constexpr double margin = 1e-9;

}  // namespace

// At any receiver that gets `there` and is within a radius, in m, of where `here` began when that did.
auto Medium::most_brought_w(const OnAir& there, const OnAir& here, double most_sent_w) const {
    const double moved_m = std::abs(there.odometer_m - here.odometer_m);
    const double between_m =
        distance(here.transmission.origin, there.transmission.origin) * (1 - margin) - moved_m;
    const double sent_w = most_sent_w * (1 + margin);
    return [this, between_m, sent_w, carrier_hz = there.transmission.band.carrier_hz](double radius_m) {
        return sent_w * propagation_.most_gain_beyond(std::max(between_m - radius_m, 0.0), carrier_hz);
    };
}

void Medium::find_those_beside(const OnAir& newest) {
    beside_.clear();
    for (const std::unique_ptr<OnAir>& other : on_air_) {
        if (other.get() != &newest && other->last_end > newest.transmission.start) {
            beside_.push_back(other.get());
        }
    }
}

void Medium::bound_interference(OnAir& newest) {
    const bool is_known = antennas_.all_isotropic();
    for (OnAir* other : beside_) {
        const double infinite = std::numeric_limits<double>::infinity();
        newest.others_w +=
            is_known ? most_brought_w(*other, newest, other->transmission.power_w)(newest.reach_m) : infinite;
        other->others_w +=
            is_known ? most_brought_w(newest, *other, newest.transmission.power_w)(other->reach_m) : infinite;
    }
}

void Medium::tell_where_energy_adds_up(OnAir& newest, std::size_t audience) {
    bool is_alone = true;
    for (OnAir* other : beside_) {
        if (other->transmission.band.share_in(audiences_[audience].band) > 0) {
            is_alone = false;
            add_to_ring(*other, newest, audience);
        }
    }
    if (!is_alone) {
        widen_ring(newest, newest, audience);
    }
}

void Medium::add_to_ring(OnAir& here, OnAir& newest, std::size_t audience) {
    EnergyRing& ring = here.rings[audience];
    const auto bound_w =
        most_brought_w(newest, here, most_power_w(newest.transmission, audiences_[audience]));
    const double most_w = bound_w(ring.radius_m());
    for (EnergyRing::Watched& watched : ring.watched()) {
        if (watched.missing_w > most_w) {
            watched.missing_w -= most_w;
            continue;
        }
        // The bound does not tell, perhaps the power does.
        watched.missing_w -= brought_w(newest.transmission, watched.radio);
        if (watched.missing_w <= 0) {
            watched.missing_w = tell_enough(watched.radio, here, newest);
        }
    }
    ring.add(bound_w);
    if (ring.is_too_narrow()) {
        widen_ring(here, newest, audience);
    }
}

void Medium::widen_ring(OnAir& here, OnAir& newest, std::size_t index) {
    const Audience& audience = audiences_[index];
    const Transmission& sent = here.transmission;
    EnergyRing& ring = here.rings[index];
    const auto visit_others = [&](const auto& visitor) {
        if (&newest != &here) {
            visitor(newest);
        }
        for (const OnAir* other : beside_) {
            if (other != &here && other->transmission.band.share_in(audience.band) > 0) {
                visitor(*other);
            }
        }
    };
    ring.forget_others(beside_.size(), audience.least_energy_w * (1 - margin),
                       [&](double power_w) { return reach_of_power_m(sent, audience, power_w); });
    visit_others([&](const OnAir& other) {
        ring.add(most_brought_w(other, here, most_power_w(other.transmission, audience)));
    });
    if (!ring.is_too_narrow()) {
        return;
    }
    const double watched_before_w = ring.least_power_w();
    ring.widen();
    const double radius_m = ring.radius_m();
    bounds_.clear();
    visit_others([&](const OnAir& other) {
        const double most_sent_w = most_power_w(other.transmission, audience);
        bounds_.push_back({&other.transmission, most_brought_w(other, here, most_sent_w)(radius_m)});
    });
    // The largest bounds are those of the nearest, and the farthest from the truth.
    std::ranges::sort(bounds_, std::greater(), &Bound::most_w);
    double rest_w = 0;
    for (Bound& bound : bounds_ | std::views::reverse) {
        rest_w = bound.rest_w = rest_w + bound.most_w;
    }
    const double share = sent.band.share_in(audience.band);
    const double moved_m = odometer_.reading_m(simulator_.now()) - here.odometer_m;
    const double loud_to_all_m = std::max(loud_to_all_m_of(sent, audience) - moved_m, 0.0);
    audience.members.visit(sent.origin, radius_m + moved_m, [&](RadioId radio, const Position& place) {
        if (squared_distance(sent.origin, place) < loud_to_all_m * loud_to_all_m || radio == sent.radio) {
            return;
        }
        const double received_w = moved_m > 0 || !odometer_.all_stand()
                                      ? arrival_at(sent, radio).power_w
                                      : power_w(sent, share, radio, place, distance(sent.origin, place));
        const Receiver& receiver = attached_[radio].receiver;
        if (received_w < ring.least_power_w() || received_w >= watched_before_w ||
            is_loud(receiver, received_w * (1 - margin))) {
            return;
        }
        // Bounds give way to powers, one after the other, until it is known that something is missing.
        double known_w = receiver.noise_w + received_w;
        const double level_w = receiver.energy_detection_w * (1 - margin);
        auto bound = bounds_.begin();
        for (; bound != bounds_.end() && known_w + bound->rest_w >= level_w; ++bound) {
            known_w += brought_w(*bound->transmission, radio);
        }
        const double missing_w = level_w - (known_w + (bound == bounds_.end() ? 0 : bound->rest_w));
        ring.watched().push_back({radio, missing_w > 0 ? missing_w : tell_enough(radio, here, newest)});
    });
}

// Who is nearer is told of the transmission even if it is alone. 0 where that depends on more than the distance.
double Medium::loud_to_all_m_of(const Transmission& transmission, const Audience& audience) const {
    constexpr double more = 1 + 1e-8;  // for rounding
    if (!antennas_.all_isotropic()) {
        return 0;
    }
    return propagation_.sure_reach_m(audience.most_energy_w * more / most_power_w(transmission, audience),
                                     transmission.band.carrier_hz) /
           more;
}

double Medium::tell_enough(RadioId radio, OnAir& strongest, OnAir& newest) {
    const Receiver& receiver = attached_[radio].receiver;
    const Arrival here = arrival_at(strongest.transmission, radio);
    const SimTime begin = std::max(here.start, newest.transmission.start);
    double all_w = receiver.noise_w;
    shares_.clear();
    const auto add = [&](OnAir& other) {
        const Transmission& sent = other.transmission;
        if (sent.radio == radio || sent.band.share_in(receiver.band) == 0) {
            return;
        }
        const Arrival there = &other == &strongest ? here : arrival_at(sent, radio);
        // A radio leaves out a frame that it is detecting, which it then is told of anyway.
        const bool may_be_left_out = can_lock_on(receiver, sent, there.power_w);
        // What ends in this very instant does so before the newest can begin, or has done so already.
        if (there.end < begin || there.end <= newest.transmission.start || there.start > here.end ||
            (may_be_left_out && is_loud(receiver, there.power_w))) {
            return;
        }
        const bool is_told =
            is_told_alone(receiver, sent, there.power_w) ||
            std::find(other.told_later.begin(), other.told_later.end(), radio) != other.told_later.end();
        shares_.push_back(Share{&other, there, is_told, is_told && !may_be_left_out, false});
        all_w += there.power_w;
    };
    for (OnAir* other : beside_) {
        add(*other);
    }
    add(newest);
    const double level_w = receiver.energy_detection_w;
    if (all_w * (1 + margin) < level_w) {
        return level_w - all_w * (1 + margin);
    }
    // What is told falls short where something begins, or where something that was told ends.
    double most_w = tell_enough_at(begin, radio);  // of what it is not told
    const auto tell_within = [&](SimTime moment) {
        if (moment > begin && moment <= here.end) {
            most_w = std::max(most_w, tell_enough_at(moment, radio));
        }
    };
    for (const Share& share : shares_) {
        tell_within(share.arrival.start);
    }
    for (bool is_complete = false; !is_complete;) {
        is_complete = true;
        for (Share& share : shares_) {
            if (share.is_told && !share.is_end_checked) {
                share.is_end_checked = true;
                is_complete = false;
                tell_within(share.arrival.end);
            }
        }
    }
    return level_w - most_w * (1 + margin);
}

// Of those not yet told the strongest first: that takes the fewest. To be told for nothing does no harm.
double Medium::tell_enough_at(SimTime moment, RadioId radio) {
    const Receiver& receiver = attached_[radio].receiver;
    // Where several begin or end in one moment, one after the other, there are instants with some of them and instants
    // with others: what is told has to be enough without any of them, if all with all of them is too much.
    int changes = 0;
    for (const Share& share : shares_) {
        changes +=
            static_cast<int>(share.arrival.start == moment) + static_cast<int>(share.arrival.end == moment);
    }
    const bool is_crowded = changes > 1;
    for (;;) {
        double all_w = receiver.noise_w;
        double told_w = receiver.noise_w;
        Share* strongest = nullptr;  // of those not told
        for (Share& share : shares_) {
            const Arrival& arrival = share.arrival;
            if (arrival.start > moment || arrival.end < moment || (arrival.end == moment && !is_crowded)) {
                continue;
            }
            all_w += arrival.power_w;
            if (share.surely_counts && arrival.end > moment && (arrival.start < moment || !is_crowded)) {
                told_w += arrival.power_w;
            }
            if (!share.is_told && (strongest == nullptr || arrival.power_w > strongest->arrival.power_w)) {
                strongest = &share;
            }
        }
        if (told_w * (1 - margin) >= receiver.energy_detection_w) {
            return 0;
        }
        if (strongest == nullptr || all_w * (1 + margin) < receiver.energy_detection_w) {
            return all_w;
        }
        strongest->is_told = true;
        strongest->surely_counts = true;
        strongest->on_air->told_later.push_back(radio);
        tell(radio, *strongest->on_air, strongest->arrival);
    }
}

}  // namespace netsim
