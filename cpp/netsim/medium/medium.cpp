#include "netsim/medium/medium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/kernel/prefetch.hpp"
#include "netsim/medium/sort_arrivals.hpp"
#include "netsim/units.hpp"

namespace netsim {

Medium::Medium(Simulator& simulator, const MediumConfig& config, FrameOutcomes& outcomes,
               Fingerprint& fingerprint, Culling culling, std::uint64_t seed)
    : simulator_(simulator),
      outcomes_(outcomes),
      fingerprint_(fingerprint),
      links_(config, seed),
      active_transmissions_(links_),
      energy_detection_(simulator, links_, active_transmissions_, *this),
      background_noise_(config),
      other_systems_(config, seed),
      culling_(culling) {}

RadioId Medium::attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna) {
    energy_detection_.add_radio();
    return links_.add(interface, receiver, antenna, simulator_.now());
}

SimTime Medium::watch_energy(RadioId radio, SimTime since) {
    links_.set_watches_energy(radio, true);
    return culling_ == Culling::disabled ? SimTime::long_ago() : energy_detection_.watch(radio, since);
}

void Medium::transmit(Transmission transmission) {
    const SimTime now = simulator_.now();
    active_transmissions_.forget_ended(now, remembered_);
    const SequenceNumber first_sequence_number =
        simulator_.reserve_sequence_numbers(2 * static_cast<std::uint64_t>(links_.count()));
    ActiveTransmission& entry =
        active_transmissions_.put(std::move(transmission), now, first_sequence_number);
    const Transmission& sent = entry.transmission;
    fingerprint_.add(static_cast<std::uint64_t>(sent.start.ps()));
    fingerprint_.add((static_cast<std::uint64_t>(sent.sender.stream()) << 32) ^ sent.psdu_bytes);
    if (culling_ == Culling::disabled) {
        notify_all(entry);
    } else {
        find_all_receivers(entry);
    }
}

void Medium::notify_all(ActiveTransmission& entry) {
    const Transmission& sent = entry.transmission;
    entry.max_interference_w = std::numeric_limits<double>::infinity();
    entry.max_far_interference_w = entry.max_interference_w;
    entry.arrivals_are_scheduled = true;  // there are none: all are late arrivals
    CopyCount addressed;
    CopyCount overheard;
    for (RadioId radio = 0; radio < links_.count(); ++radio) {
        const ReceiverParameters& receiver = links_.receiver(radio);
        if (radio == sent.radio || active_transmissions_.share_at(entry, radio) == 0) {
            continue;
        }
        const Arrival arrival = active_transmissions_.arrival_at(entry, radio);
        if (receiver.can_decode(sent)) {
            CopyCount& count = sent.label.is_for(links_.interface(radio).node) ? addressed : overheard;
            ++count.made;
            if (arrival.power_w < receiver.sensitivity_w) {
                ++count.too_weak;
            }
        }
        entry.last_end = std::max(entry.last_end, arrival.end);
        notify(radio, entry, arrival);
    }
    notify_observer(sent, {addressed.made + overheard.made, addressed.too_weak + overheard.too_weak});
    outcomes_.book_transmission(sent.label, addressed, overheard);
}

void Medium::notify_observer(const Transmission& sent, CopyCount copies) {
    if (FrameObserver* const observer = outcomes_.observer(); observer != nullptr) {
        std::vector<FrameObserver::Loss> missed;
        if (copies.too_weak > 0) {
            missed = missed_receptions(sent, *observer);
        }
        observer->frame_begins(sent, copies.made - copies.too_weak, copies.too_weak, missed);
    }
}

std::vector<FrameObserver::Loss> Medium::missed_receptions(const Transmission& sent,
                                                           const FrameObserver& observer) {
    std::vector<FrameObserver::Loss> missed;
    const auto add_if_missed = [&](RadioId radio, const Position& place) {
        if (observer.explains(sent.sender.node, links_.interface(radio).node)) {
            if (auto loss = links_.below_sensitivity(sent, radio, place)) {
                missed.push_back(std::move(*loss));
            }
        }
    };
    const RadioId addressee = links_.addressee_of(sent);
    if (addressee >= 0) {
        add_if_missed(addressee, links_.position(addressee, sent.start));
    }
    if (links_.is_power_law()) {
        return missed;
    }
    for (ReceiverGroup& group : links_.groups()) {
        if (!group.can_decode(sent)) {
            continue;
        }
        const double reach_m = links_.steady_reach_m(sent, group);
        group.members.prepare(sent.start, links_.displacement(), reach_m);
        for (const auto& [place, radio] : group.members.near(sent.origin, reach_m)) {
            if (radio != sent.radio && radio != addressee && links_.is_in_steady_reach(sent, radio, place)) {
                add_if_missed(radio, place);
            }
        }
    }
    return missed;
}

void Medium::find_all_receivers(ActiveTransmission& entry) {
    const Transmission& sent = entry.transmission;
    active_transmissions_.find_concurrent(entry, concurrent_);
    CopyCount copies;
    double farthest_m = 0;
    for (std::size_t group = 0; group < links_.groups().size(); ++group) {
        if (entry.shares[group] > 0) {
            const CopyCount there = find_receivers(entry, group);
            copies.made += there.made;
            copies.too_weak += there.too_weak;
            farthest_m = std::max(farthest_m, links_.groups()[group].members.farthest_m(sent.origin));
        }
    }
    entry.last_end = sent.start + sent.duration + max_propagation_delay(farthest_m);
    if (!concurrent_.empty()) {
        for (ActiveTransmission* other : concurrent_) {
            add_interference_bounds(entry, *other);
            add_interference_bounds(*other, entry);
        }
        energy_detection_.add(entry, concurrent_);
    }
    book_copies(entry, copies);
    schedule_arrivals(entry);
}

CopyCount Medium::find_receivers(ActiveTransmission& entry, std::size_t index) {
    const Transmission& sent = entry.transmission;
    ReceiverGroup& group = links_.groups()[index];
    const double share = entry.shares[index];
    WatchZones& zones = entry.zones[index];
    energy_detection_.begin_zones(entry, index);
    const bool is_decodable = group.can_decode(sent);
    const double within_m = links_.reach_m(group, sent);
    group.members.prepare(sent.start, links_.displacement(), within_m);
    entry.reach_m = std::max(entry.reach_m, within_m);
    // Up to this distance, the delay may round to 0, also for radios that notice the transmission
    // only together with others.
    constexpr double immediate_m = 1e-3;
    const double search_m = std::max({within_m, zones.radius_m(), immediate_m});
    const double min_w = std::min(group.min_noticed_w(sent), zones.min_power_w());
    const auto watch = [&](RadioId radio, const Position& place, double received_w) {
        const ReceiverParameters& there = links_.receiver(radio);
        if (received_w >= zones.min_power_w() && !there.surely_exceeds_ed(received_w)) {
            zones.watched().push_back({radio, place, there.headroom_w(received_w)});
        }
    };
    partition(group.members.near(sent.origin, search_m), sent, std::max(within_m, immediate_m));
    std::uint64_t noticed = 0;
    for (const NeighborSearch::Neighbor* near : within_) {
        const auto& [place, radio] = *near;
        const double squared_m2 = squared_distance(sent.origin, place);
        entry.arrives_immediately |= squared_m2 <= immediate_m * immediate_m;
        const ReceiverParameters& there = links_.receiver(radio);
        const double distance_m = std::sqrt(squared_m2);
        const double received_w = links_.power_w(sent, share, radio, place, distance_m, min_w);
        const bool can_lock = is_decodable && received_w >= there.sensitivity_w;
        noticed += can_lock ? 1 : 0;
        if (can_lock || there.exceeds_ed(received_w)) {
            prefetch(radio, sent.label.kind);
            const auto place_index = static_cast<std::uint32_t>(entry.places.size());
            entry.scheduled.push_back(
                {sent.start + propagation_delay(distance_m), received_w, radio, place_index, can_lock});
            entry.places.push_back(place);
        }
        if (links_.watches_energy(radio)) {
            watch(radio, place, received_w);
        }
    }
    for (const NeighborSearch::Neighbor* near : beyond_) {
        const auto& [place, radio] = *near;
        if (links_.watches_energy(radio)) {
            watch(radio, place,
                  links_.power_w(sent, share, radio, place, distance(sent.origin, place), min_w));
        }
    }
    if (!is_decodable) {
        return {};
    }
    const std::uint64_t copies =
        group.members.size() - (links_.group_of(sent.radio) == index ? 1 : 0);  // without the sender
    return {copies, copies - noticed};
}

void Medium::partition(std::span<const NeighborSearch::Neighbor> near, const Transmission& sent,
                       double noticed_m) {
    within_.resize(near.size());
    beyond_.resize(near.size());
    std::size_t within = 0;
    std::size_t beyond = 0;
    // Branch-free: the processor cannot predict which receivers are within.
    for (const NeighborSearch::Neighbor& there : near) {
        links_.prefetch(there.radio);
        const bool is_within = squared_distance(sent.origin, there.place) <= noticed_m * noticed_m;
        within_[within] = &there;
        within += static_cast<std::size_t>(is_within) & static_cast<std::size_t>(there.radio != sent.radio);
        beyond_[beyond] = &there;
        beyond += static_cast<std::size_t>(!is_within);
    }
    within_.resize(within);
    beyond_.resize(beyond);
}

void Medium::book_copies(const ActiveTransmission& entry, CopyCount copies) {
    const FrameLabel label = entry.transmission.label;
    notify_observer(entry.transmission, copies);
    if (label.destination == broadcast_id) {
        outcomes_.book_transmission(label, copies, {});
        return;
    }
    CopyCount addressed;
    if (const RadioId addressee = links_.addressee_of(entry.transmission); addressee >= 0) {
        const bool is_noticed =
            std::ranges::any_of(entry.scheduled, [addressee](const ScheduledArrival& scheduled) {
                return scheduled.radio == addressee && scheduled.lockable;
            });
        addressed = {1, is_noticed ? 0U : 1U};
    }
    outcomes_.book_transmission(label, addressed,
                                {copies.made - addressed.made, copies.too_weak - addressed.too_weak});
}

// The receiver will be notified soon. In a large network, most of its state is not in a cache.
void Medium::prefetch(RadioId radio, FrameKind kind) const {
    links_.prefetch_targets(radio);
    outcomes_.prefetch(links_.interface(radio).node, kind, FrameOutcome::delivered);
}

// The sequence numbers of all arrival events are reserved when the transmission begins. So the
// order of events does not depend on when, or whether, a radio is notified, and only the next start
// and the next end are in the event queue.
void Medium::schedule_arrivals(ActiveTransmission& entry) {
    entry.arrivals_are_scheduled = true;
    if (entry.scheduled.empty()) {
        return;
    }
    sort_arrivals(entry.scheduled, entry.transmission.start, spare_);
    schedule_next(entry, ActiveTransmission::begins);
    schedule_next(entry, ActiveTransmission::ends);
}

Medium::Due Medium::next_due(const ActiveTransmission& entry, ActiveTransmission::Edge edge) {
    const ScheduledArrival& next = entry.scheduled[entry.notified[edge]];
    return {edge == ActiveTransmission::begins ? next.start : next.start + entry.transmission.duration,
            entry.sequence_number(next.radio, edge)};
}

void Medium::schedule_next(ActiveTransmission& entry, ActiveTransmission::Edge edge) {
    const Due due = next_due(entry, edge);
    simulator_.schedule_reserved(due.time, due.number, [this, &entry, edge] { notify_next(entry, edge); });
}

// Notifies the next radio, and further radios while no other event comes first: most of these events
// need not pass through the queue.
void Medium::notify_next(ActiveTransmission& entry, ActiveTransmission::Edge edge) {
    Due due;
    do {
        const ScheduledArrival& scheduled = entry.scheduled[entry.notified[edge]++];
        const Arrival arrival{&entry.transmission,
                              scheduled.start,
                              scheduled.start + entry.transmission.duration,
                              scheduled.power_w,
                              entry.places[scheduled.place_index],
                              scheduled.lockable,
                              &entry};
        const bool is_last = entry.notified[edge] == entry.scheduled.size();
        try {
            MediumListener& listener = links_.listener(scheduled.radio);
            edge == ActiveTransmission::begins ? listener.arrival_started(arrival)
                                               : listener.arrival_ended(arrival);
        } catch (...) {  // thrown by a protocol: the other radios still get the frame
            if (!is_last) {
                schedule_next(entry, edge);
            }
            throw;
        }
        if (is_last) {
            return;
        }
        due = next_due(entry, edge);
    } while (simulator_.try_run_inline(due.time, due.number));
    schedule_next(entry, edge);
}

void Medium::arrival_needed(RadioId radio, ActiveTransmission& active, const Arrival& arrival) {
    notify(radio, active, arrival);
}

void Medium::notify(RadioId radio, ActiveTransmission& active, const Arrival& arrival) {
    if (!active.arrivals_are_scheduled) {
        const auto place_index = static_cast<std::uint32_t>(active.places.size());
        active.scheduled.push_back({arrival.start, arrival.power_w, radio, place_index, arrival.lockable});
        active.places.push_back(arrival.place);
        return;
    }
    if (simulator_.has_passed(arrival.end, active.sequence_number(radio, ActiveTransmission::ends))) {
        return;
    }
    const std::size_t index = active.late_arrivals.size();
    active.late_arrivals.push_back(arrival);
    const SequenceNumber number = active.sequence_number(radio, ActiveTransmission::begins);
    if (simulator_.has_passed(arrival.start, number)) {
        // The arrival became relevant after its start. The radio could not have noticed anything in
        // between.
        start_late_arrival(radio, active, index);
        return;
    }
    simulator_.schedule_reserved(arrival.start, number,
                                 [this, radio, &active, index] { start_late_arrival(radio, active, index); });
}

void Medium::start_late_arrival(RadioId radio, const ActiveTransmission& active, std::size_t index) {
    const Arrival arrival = active.late_arrivals[index];  // a copy: the vector may grow meanwhile
    links_.listener(radio).arrival_started(arrival);
    simulator_.schedule_reserved(arrival.end, active.sequence_number(radio, ActiveTransmission::ends),
                                 [this, radio, &active, index] {
                                     const Arrival ended = active.late_arrivals[index];
                                     links_.listener(radio).arrival_ended(ended);
                                 });
}

void Medium::add_interference_bounds(ActiveTransmission& here, const ActiveTransmission& there) const {
    const double max_w = links_.all_isotropic() ? active_transmissions_.max_received_w(
                                                      there, here, there.transmission.power_w)(here.reach_m)
                                                : std::numeric_limits<double>::infinity();
    here.max_interference_w += max_w;
    // In free space, at six times the reach, the nearest receiver gets twice the power of the
    // farthest.
    constexpr double close_interferers = 6;
    if (links_.is_random() || max_w == std::numeric_limits<double>::infinity() ||
        squared_distance(here.transmission.origin, there.transmission.origin) <
            close_interferers * close_interferers * here.reach_m * here.reach_m) {
        here.close_interferers.push_back(&there);
    } else {
        here.max_far_interference_w += max_w;
    }
}

double Medium::max_interference_w(RadioId receiver, const Arrival& arrival) const {
    const ActiveTransmission& here = *arrival.active;
    double max_w = here.max_far_interference_w;
    for (const ActiveTransmission* other : here.close_interferers) {
        if (other->transmission.radio != receiver) {
            max_w += active_transmissions_.power_at(*other, receiver, arrival.place, simulator_.now());
        }
    }
    return max_w * (1 + rounding_margin);
}

InterferenceSum& Medium::interference_with(RadioId receiver, const Arrival& arrival, SimTime start,
                                           SimTime end) {
    interference_.begin(start, end);
    if (active_transmissions_.size() <= 1) {
        return interference_;
    }
    const std::uint32_t group = links_.group_of(receiver);
    for (const std::unique_ptr<ActiveTransmission>& other : active_transmissions_.entries()) {
        const Transmission& sent = other->transmission;
        if (&sent == arrival.transmission || sent.radio == receiver || other->last_end <= start ||
            sent.start >= end || other->shares[group] == 0) {
            continue;
        }
        interference_.add(
            active_transmissions_.arrival_at(*other, receiver, arrival.place, simulator_.now()));
    }
    return interference_;
}

}  // namespace netsim
