#include "netsim/medium/medium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/kernel/fetch.hpp"
#include "netsim/medium/order_of_arrival.hpp"
#include "netsim/units.hpp"

namespace netsim {

Medium::Medium(Simulator& simulator, const MediumConfig& config, FrameFates& fates, Fingerprint& fingerprint,
               Hearing hearing, std::uint64_t seed)
    : simulator_(simulator),
      fates_(fates),
      fingerprint_(fingerprint),
      links_(config, seed),
      airwaves_(links_),
      energy_watch_(simulator, links_, airwaves_, *this),
      background_noise_(config),
      hearing_(hearing) {}

RadioId Medium::attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna) {
    energy_watch_.add_radio();
    return links_.add(interface, receiver, antenna, simulator_.now());
}

SimTime Medium::watch_energy(RadioId radio, SimTime since) {
    links_.set_watches_energy(radio, true);
    return hearing_ == Hearing::everything ? SimTime::long_ago() : energy_watch_.watch(radio, since);
}

void Medium::transmit(Transmission transmission) {
    const SimTime now = simulator_.now();
    airwaves_.forget_the_past(now, remembered_);
    const Turn first_turn = simulator_.reserve_turns(2 * static_cast<std::uint64_t>(links_.count()));
    OnAir& entry = airwaves_.put(std::move(transmission), now, first_turn);
    const Transmission& sent = entry.transmission;
    fingerprint_.add(static_cast<std::uint64_t>(sent.start.ps()));
    fingerprint_.add((static_cast<std::uint64_t>(sent.sender.stream()) << 32) ^ sent.psdu_bytes);
    if (hearing_ == Hearing::everything) {
        tell_everybody(entry);
    } else {
        tell_those_it_matters_to(entry);
    }
}

// The plain model.
void Medium::tell_everybody(OnAir& entry) {
    const Transmission& sent = entry.transmission;
    entry.others_w = std::numeric_limits<double>::infinity();
    entry.far_w = entry.others_w;
    entry.heard_is_complete = true;  // nobody: each is told apart
    CopyCount addressed;
    CopyCount overheard;
    for (RadioId radio = 0; radio < links_.count(); ++radio) {
        const ReceiverKind& receiver = links_.kind(radio);
        if (radio == sent.radio || airwaves_.share_at(entry, radio) == 0) {
            continue;
        }
        const Arrival arrival = airwaves_.arrival_at(entry, radio);
        if (receiver.can_decode(sent)) {
            CopyCount& count = sent.label.is_for(links_.interface(radio).node) ? addressed : overheard;
            ++count.made;
            if (arrival.power_w < receiver.sensitivity_w) {
                ++count.too_weak;
            }
        }
        entry.last_end = std::max(entry.last_end, arrival.end);
        tell(radio, entry, arrival);
    }
    fates_.book_transmission(sent.label, addressed, overheard);
}

void Medium::tell_those_it_matters_to(OnAir& entry) {
    const Transmission& sent = entry.transmission;
    airwaves_.find_those_beside(entry, beside_);
    CopyCount copies;
    double farthest_m = 0;
    for (std::size_t audience = 0; audience < links_.audiences().size(); ++audience) {
        if (entry.shares[audience] > 0) {
            const CopyCount there = find_those_it_matters_to(entry, audience);
            copies.made += there.made;
            copies.too_weak += there.too_weak;
            farthest_m = std::max(farthest_m, links_.audiences()[audience].members.farthest_m(sent.origin));
        }
    }
    entry.last_end = sent.start + sent.duration + most_propagation_delay(farthest_m);
    if (!beside_.empty()) {
        for (OnAir* other : beside_) {
            bound_interference(entry, *other);
            bound_interference(*other, entry);
        }
        energy_watch_.add_up_in_time(entry, beside_);
    }
    book_copies(entry, copies);
    schedule_arrivals(entry);
}

CopyCount Medium::find_those_it_matters_to(OnAir& entry, std::size_t index) {
    const Transmission& sent = entry.transmission;
    Audience& audience = links_.audiences()[index];
    const double share = entry.shares[index];
    EnergyRing& ring = entry.rings[index];
    energy_watch_.begin_ring(entry, index);
    const bool is_decodable = audience.can_decode(sent);
    const double within_m = links_.reach_m(audience, sent);
    audience.members.prepare(sent.start, links_.odometer(), within_m);
    entry.reach_m = std::max(entry.reach_m, within_m);
    // Up to there the delay may be rounded to 0: also of those that matter only together.
    constexpr double at_once_m = 1e-3;
    const double search_m = std::max({within_m, ring.radius_m(), at_once_m});
    const double least_w = std::min(audience.noticed_w(sent), ring.least_power_w());
    const auto watch = [&](RadioId radio, const Position& place, double received_w) {
        const ReceiverKind& there = links_.kind(radio);
        if (received_w >= ring.least_power_w() && !there.is_surely_loud(received_w)) {
            ring.watched().push_back({radio, place, there.missing_beside_w(received_w)});
        }
    };
    part(audience.members.near(sent.origin, search_m), sent, std::max(within_m, at_once_m));
    std::uint64_t noticed = 0;
    for (const Neighbours::Near* near : within_) {
        const auto& [place, radio] = *near;
        const double squared_m2 = squared_distance(sent.origin, place);
        entry.arrives_at_once |= squared_m2 <= at_once_m * at_once_m;
        const ReceiverKind& there = links_.kind(radio);
        const double distance_m = std::sqrt(squared_m2);
        const double received_w = links_.power_w(sent, share, radio, place, distance_m, least_w);
        const bool can_lock = is_decodable && received_w >= there.sensitivity_w;
        noticed += can_lock ? 1 : 0;
        if (can_lock || there.is_loud(received_w)) {
            fetch(radio, sent.label.kind);
            const auto place_index = static_cast<std::uint32_t>(entry.places.size());
            entry.heard.push_back(
                {sent.start + propagation_delay(distance_m), received_w, radio, place_index, can_lock});
            entry.places.push_back(place);
        }
        if (links_.watches_energy(radio)) {
            watch(radio, place, received_w);
        }
    }
    for (const Neighbours::Near* near : beyond_) {
        const auto& [place, radio] = *near;
        if (links_.watches_energy(radio)) {
            watch(radio, place,
                  links_.power_w(sent, share, radio, place, distance(sent.origin, place), least_w));
        }
    }
    if (!is_decodable) {
        return {};
    }
    const std::uint64_t copies =
        audience.members.size() - (links_.audience_of(sent.radio) == index ? 1 : 0);  // none for the sender
    return {copies, copies - noticed};
}

void Medium::part(std::span<const Neighbours::Near> near, const Transmission& sent, double noticed_m) {
    within_.resize(near.size());
    beyond_.resize(near.size());
    std::size_t within = 0;
    std::size_t beyond = 0;
    // Without a branch, as a processor cannot guess who is where.
    for (const Neighbours::Near& there : near) {
        links_.fetch(there.radio);
        const bool is_within = squared_distance(sent.origin, there.place) <= noticed_m * noticed_m;
        within_[within] = &there;
        within += static_cast<std::size_t>(is_within) & static_cast<std::size_t>(there.radio != sent.radio);
        beyond_[beyond] = &there;
        beyond += static_cast<std::size_t>(!is_within);
    }
    within_.resize(within);
    beyond_.resize(beyond);
}

void Medium::book_copies(const OnAir& entry, CopyCount copies) {
    const FrameLabel label = entry.transmission.label;
    if (label.destination == broadcast_id) {
        fates_.book_transmission(label, copies, {});
        return;
    }
    CopyCount addressed;
    if (const RadioId addressee = links_.addressee_of(entry.transmission); addressee >= 0) {
        const bool is_noticed = std::ranges::any_of(entry.heard, [addressee](const Heard& heard) {
            return heard.radio == addressee && heard.lockable;
        });
        addressed = {1, is_noticed ? 0U : 1U};
    }
    fates_.book_transmission(label, addressed,
                             {copies.made - addressed.made, copies.too_weak - addressed.too_weak});
}

// The receiver will be told soon. In a large network most of it is in no cache by then: have it fetched meanwhile.
void Medium::fetch(RadioId radio, FrameKind kind) const {
    links_.fetch_touched(radio);
    fates_.fetch(links_.interface(radio).node, kind, FrameFate::delivered);
}

// The events of an arrival have their turns in the order of equal times since its transmission began: the
// course of a run does not depend on when, or whether, a radio is told. So of all arrivals of a transmission only the
// next one to start and the next one to end need to be in the queue.
void Medium::schedule_arrivals(OnAir& entry) {
    entry.heard_is_complete = true;
    if (entry.heard.empty()) {
        return;
    }
    put_in_order(entry.heard, entry.transmission.start, spare_);
    schedule_next(entry, OnAir::begins);
    schedule_next(entry, OnAir::ends);
}

Medium::Due Medium::next_due(const OnAir& entry, OnAir::Edge edge) {
    const Heard& next = entry.heard[entry.told[edge]];
    return {edge == OnAir::begins ? next.start : next.start + entry.transmission.duration,
            entry.turn_at(next.radio, edge)};
}

void Medium::schedule_next(OnAir& entry, OnAir::Edge edge) {
    const Due due = next_due(entry, edge);
    simulator_.schedule_at_turn(due.time, due.turn, [this, &entry, edge] { tell_next(entry, edge); });
}

// And of those after it, as long as nothing else is due in between: mostly they come in one go, and need not pass through
// the queue.
void Medium::tell_next(OnAir& entry, OnAir::Edge edge) {
    Due due;
    do {
        const Heard& heard = entry.heard[entry.told[edge]++];
        const Arrival arrival{&entry.transmission,
                              heard.start,
                              heard.start + entry.transmission.duration,
                              heard.power_w,
                              entry.places[heard.place_index],
                              heard.lockable,
                              &entry};
        const bool is_last = entry.told[edge] == entry.heard.size();
        try {
            MediumListener& listener = links_.listener(heard.radio);
            edge == OnAir::begins ? listener.arrival_started(arrival) : listener.arrival_ended(arrival);
        } catch (...) {  // a protocol's: the others hear the frame all the same
            if (!is_last) {
                schedule_next(entry, edge);
            }
            throw;
        }
        if (is_last) {
            return;
        }
        due = next_due(entry, edge);
    } while (simulator_.goes_on_at(due.time, due.turn));
    schedule_next(entry, edge);
}

void Medium::energy_matters(RadioId radio, OnAir& on_air, const Arrival& arrival) {
    tell(radio, on_air, arrival);
}

void Medium::tell(RadioId radio, OnAir& on_air, const Arrival& arrival) {
    if (!on_air.heard_is_complete) {
        const auto place_index = static_cast<std::uint32_t>(on_air.places.size());
        on_air.heard.push_back({arrival.start, arrival.power_w, radio, place_index, arrival.lockable});
        on_air.places.push_back(arrival.place);
        return;
    }
    if (simulator_.has_passed(arrival.end, on_air.turn_at(radio, OnAir::ends))) {
        return;
    }
    const std::size_t apart = on_air.told_apart.size();
    on_air.told_apart.push_back(arrival);
    const Turn turn = on_air.turn_at(radio, OnAir::begins);
    if (simulator_.has_passed(arrival.start, turn)) {
        // It came to matter after it had begun: nothing that the radio could have noticed happened in
        // between.
        begin(radio, on_air, apart);
        return;
    }
    simulator_.schedule_at_turn(arrival.start, turn,
                                [this, radio, &on_air, apart] { begin(radio, on_air, apart); });
}

void Medium::begin(RadioId radio, const OnAir& on_air, std::size_t apart) {
    const Arrival arrival = on_air.told_apart[apart];  // a copy: others may be told meanwhile
    links_.listener(radio).arrival_started(arrival);
    simulator_.schedule_at_turn(arrival.end, on_air.turn_at(radio, OnAir::ends),
                                [this, radio, &on_air, apart] {
                                    const Arrival ended = on_air.told_apart[apart];
                                    links_.listener(radio).arrival_ended(ended);
                                });
}

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
