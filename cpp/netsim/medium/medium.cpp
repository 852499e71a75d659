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
      propagation_(config, seed),
      background_noise_(config),
      hearing_(hearing) {}

RadioId Medium::attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna) {
    const auto radio = static_cast<RadioId>(attached_.size());
    attached_.push_back(Attached{.interface = interface, .kind = kind_index(receiver.kind)});
    touched_.push_back(Touched{.listener = receiver.listener});
    trajectories_.push_back(receiver.trajectory);
    outlook_of_.push_back(no_outlook);
    antennas_.add(antenna, *receiver.trajectory);
    if (first_radio_.empty() || attached_[first_radio_.back()].interface.node != interface.node) {
        NETSIM_ASSERT(interface.node == static_cast<NodeId>(first_radio_.size()));
        first_radio_.push_back(radio);
        odometer_.watch(*receiver.trajectory, simulator_.now());
    }
    Audience& audience = audiences_[audience_of(radio)];
    audience.most_antenna_gain = std::max(audience.most_antenna_gain, antenna.max_gain());
    audience.reach = {};
    audience.ring_reach = {};
    audience.outer_reach = {};
    audience.members.add(radio, *receiver.trajectory);
    return radio;
}

std::uint32_t Medium::kind_index(const ReceiverKind& kind) {
    // Mostly that of the one before. Only the latest are looked at: each radio may have a kind of its own.
    constexpr std::ptrdiff_t most = 16;
    const auto last = kinds_.rbegin() + std::min(most, std::ssize(kinds_));
    const auto known = std::find(kinds_.rbegin(), last, kind);
    if (known != last) {
        return static_cast<std::uint32_t>(kinds_.rend() - known - 1);
    }
    kinds_.push_back(kind);
    audience_of_.push_back(audience_index(kind));
    return static_cast<std::uint32_t>(kinds_.size() - 1);
}

std::uint32_t Medium::audience_index(const ReceiverKind& kind) {
    // Less than the difference by what the sum with the noise may be rounded.
    const double energy_w = kind.energy_detection_w - kind.noise_w - 1e-15 * kind.energy_detection_w;
    const double least_w = std::min(kind.sensitivity_w, energy_w);
    const int keenness = least_w > 0 ? std::ilogb(least_w) / 2 : std::numeric_limits<int>::min();
    auto audience = std::find_if(audiences_.begin(), audiences_.end(), [&](const Audience& other) {
        return other.keenness == keenness && other.band == kind.band && other.formats == kind.formats;
    });
    if (audience == audiences_.end()) {
        audiences_.push_back(Audience{.band = kind.band,
                                      .formats = kind.formats,
                                      .keenness = keenness,
                                      .least_w = least_w,
                                      .least_energy_w = energy_w,
                                      .members = Neighbours()});
        audience = audiences_.end() - 1;
    }
    audience->least_w = std::min(audience->least_w, least_w);
    audience->least_energy_w = std::min(audience->least_energy_w, energy_w);
    audience->most_energy_w = std::max(audience->most_energy_w, kind.energy_detection_w);
    return static_cast<std::uint32_t>(audience - audiences_.begin());
}

void Medium::transmit(Transmission transmission) {
    forget_the_past();
    OnAir& entry = put_on_air(std::move(transmission));
    const Transmission& sent = entry.transmission;
    fingerprint_.add(static_cast<std::uint64_t>(sent.start.ps()));
    fingerprint_.add((static_cast<std::uint64_t>(sent.sender.stream()) << 32) ^ sent.psdu_bytes);
    if (hearing_ == Hearing::everything) {
        tell_everybody(entry);
    } else {
        tell_those_it_matters_to(entry);
    }
}

Medium::OnAir& Medium::put_on_air(Transmission transmission) {
    if (spare_.empty()) {
        spare_.push_back(std::make_unique<OnAir>());
    }
    on_air_.push_back(std::move(spare_.back()));
    spare_.pop_back();
    const SimTime now = simulator_.now();
    OnAir& entry = *on_air_.back();
    entry.transmission = std::move(transmission);
    entry.transmission.id = next_id_++;
    entry.transmission.start = now;
    entry.transmission.origin = trajectories_[entry.transmission.radio]->position_at(now);
    entry.last_end = now;
    entry.reach_m = 0;
    entry.arrives_at_once = false;
    entry.others_w = 0;
    entry.close.clear();
    entry.far_w = 0;
    entry.first_turn = simulator_.reserve_turns(2 * attached_.size());
    entry.odometer_m = odometer_.reading_m(now);
    entry.heard.clear();
    entry.places.clear();
    entry.told = {};
    entry.heard_is_complete = false;
    entry.told_apart.clear();
    entry.shares.clear();
    for (const Audience& audience : audiences_) {
        entry.shares.push_back(entry.transmission.band.share_in(audience.band));
    }
    entry.rings.resize(audiences_.size());
    return entry;
}

// The plain model.
void Medium::tell_everybody(OnAir& entry) {
    const Transmission& sent = entry.transmission;
    entry.others_w = std::numeric_limits<double>::infinity();
    entry.far_w = entry.others_w;
    entry.heard_is_complete = true;  // nobody: each is told apart
    CopyCount addressed;
    CopyCount overheard;
    for (RadioId radio = 0; radio < static_cast<RadioId>(attached_.size()); ++radio) {
        const ReceiverKind& receiver = kind(radio);
        if (radio == sent.radio || share_at(entry, radio) == 0) {
            continue;
        }
        const Arrival arrival = arrival_at(entry, radio);
        if (can_decode(receiver, sent)) {
            CopyCount& count = sent.label.is_for(attached_[radio].interface.node) ? addressed : overheard;
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
    find_those_beside(entry);
    CopyCount copies;
    double farthest_m = 0;
    for (std::size_t audience = 0; audience < audiences_.size(); ++audience) {
        if (entry.shares[audience] > 0) {
            const CopyCount there = find_those_it_matters_to(entry, audience);
            copies.made += there.made;
            copies.too_weak += there.too_weak;
            farthest_m = std::max(farthest_m, audiences_[audience].members.farthest_m(sent.origin));
        }
    }
    entry.last_end = sent.start + sent.duration + most_propagation_delay(farthest_m);
    if (!beside_.empty()) {
        for (OnAir* other : beside_) {
            bound_interference(entry, *other);
            bound_interference(*other, entry);
        }
        add_up_energy_in_time(entry);
    }
    book_copies(entry, copies);
    schedule_arrivals(entry);
}

CopyCount Medium::find_those_it_matters_to(OnAir& entry, std::size_t index) {
    const Transmission& sent = entry.transmission;
    Audience& audience = audiences_[index];
    const double share = entry.shares[index];
    EnergyRing& ring = entry.rings[index];
    begin_ring(ring, audience, sent);
    const bool is_decodable = can_decode(audience, sent);
    const double within_m = reach_m(audience, sent);
    audience.members.prepare(sent.start, odometer_, within_m);
    entry.reach_m = std::max(entry.reach_m, within_m);
    const double search_m = std::max(within_m, ring.radius_m());
    const double least_w = std::min(noticed_w(audience, sent), ring.least_power_w());
    const std::vector<Neighbours::Near>& near = audience.members.near(sent.origin, search_m);
    for (const auto& [radio, place] : near) {
        netsim::fetch(attached_[radio]);
        netsim::fetch(touched_[radio]);
    }
    std::uint64_t noticed = 0;
    for (const auto& [radio, place] : near) {
        const double squared_m2 = squared_distance(sent.origin, place);
        const double heard_m = attached_[radio].watches_energy ? search_m : within_m;
        if (squared_m2 > heard_m * heard_m || radio == sent.radio) {
            continue;
        }
        constexpr double at_once_m = 1e-3;  // or less: the delay may be rounded to 0
        entry.arrives_at_once |= squared_m2 <= at_once_m * at_once_m;
        const ReceiverKind& there = kind(radio);
        const double distance_m = std::sqrt(squared_m2);
        const double received_w = power_w(sent, share, radio, place, distance_m, least_w);
        const bool can_lock = is_decodable && received_w >= there.sensitivity_w;
        noticed += can_lock ? 1 : 0;
        if (can_lock || is_loud(there, received_w)) {
            fetch(radio, sent.label.kind);
            const auto place_index = static_cast<std::uint32_t>(entry.places.size());
            entry.heard.push_back(
                {sent.start + propagation_delay(distance_m), received_w, radio, place_index, can_lock});
            entry.places.push_back(place);
        }
        if (attached_[radio].watches_energy && received_w >= ring.least_power_w() &&
            !is_surely_loud(there, received_w)) {
            ring.watched().push_back({radio, place, missing_beside_w(there, received_w)});
        }
    }
    if (!is_decodable) {
        return {};
    }
    const std::uint64_t copies =
        audience.members.size() - (audience_of(sent.radio) == index ? 1 : 0);  // none for the sender
    return {copies, copies - noticed};
}

void Medium::book_copies(const OnAir& entry, CopyCount copies) {
    const FrameLabel label = entry.transmission.label;
    if (label.destination == broadcast_id) {
        fates_.book_transmission(label, copies, {});
        return;
    }
    CopyCount addressed;
    if (const RadioId addressee = addressee_of(entry.transmission); addressee >= 0) {
        const bool is_noticed = std::ranges::any_of(entry.heard, [addressee](const Heard& heard) {
            return heard.radio == addressee && heard.lockable;
        });
        addressed = {1, is_noticed ? 0U : 1U};
    }
    fates_.book_transmission(label, addressed,
                             {copies.made - addressed.made, copies.too_weak - addressed.too_weak});
}

RadioId Medium::addressee_of(const Transmission& transmission) const {
    const NodeId node = transmission.label.destination;
    if (node < 0 || static_cast<std::size_t>(node) >= first_radio_.size()) {
        return -1;
    }
    const auto count = static_cast<RadioId>(attached_.size());
    for (RadioId radio = first_radio_[node]; radio < count && attached_[radio].interface.node == node;
         ++radio) {
        if (radio != transmission.radio && can_decode(kind(radio), transmission)) {
            return radio;
        }
    }
    return -1;
}

// The receiver will be told soon. In a large network most of it is in no cache by then: have it fetched meanwhile.
void Medium::fetch(RadioId radio, FrameKind kind) const {
    constexpr std::size_t cache_line = 64;
    const Touched& there = touched_[radio];
    fetch_bytes(there.listener, 2 * cache_line);
    fetch_bytes(there.interface, cache_line);
    fetch_bytes(there.upper_layer, cache_line);
    fetch_bytes(there.protocol, cache_line);
    fates_.fetch(attached_[radio].interface.node, kind);
}

void Medium::begin_ring(EnergyRing& ring, Audience& audience, const Transmission& transmission) const {
    const double level_w = noticed_energy_w(audience);
    if (level_w <= 0) {
        ring.begin_without_zones();
        return;
    }
    ring.begin(level_w,
               known_reach_m(audience.ring_reach, transmission, audience, EnergyRing::first_zone_w(level_w)),
               known_reach_m(audience.outer_reach, transmission, audience, EnergyRing::outer_w(level_w)));
}

double Medium::known_reach_m(KnownReach& known, const Transmission& transmission, const Audience& audience,
                             double power_w) const {
    const double gain = power_w / most_power_w(transmission, audience);
    if (known.gain != gain || known.carrier_hz != transmission.band.carrier_hz) {
        known = {gain, transmission.band.carrier_hz, reach_of_power_m(transmission, audience, power_w)};
    }
    return known.reach_m;
}

double Medium::reach_of_power_m(const Transmission& transmission, const Audience& audience,
                                double power_w) const {
    // Who is in doubt gets the exact calculation.
    return power_w > 0 ? propagation_.reach_m(power_w / most_power_w(transmission, audience),
                                              transmission.band.carrier_hz) *
                             (1 + margin)
                       : std::numeric_limits<double>::infinity();
}

// The events of an arrival have their turns in the order of equal times since its transmission began: the
// course of a run does not depend on when, or whether, a radio is told. So of all arrivals of a transmission only the
// next one to start and the next one to end need to be in the queue.
void Medium::schedule_arrivals(OnAir& entry) {
    entry.heard_is_complete = true;
    if (entry.heard.empty()) {
        return;
    }
    put_in_order(entry.heard, entry.transmission.start);
    schedule_next(entry, Edge::begins);
    schedule_next(entry, Edge::ends);
}

Medium::Due Medium::next_due(const OnAir& entry, Edge edge) {
    const Heard& next = entry.heard[entry.told[edge]];
    return {edge == Edge::begins ? next.start : next.start + entry.transmission.duration,
            entry.first_turn + 2 * static_cast<Turn>(next.radio) + edge};
}

void Medium::schedule_next(OnAir& entry, Edge edge) {
    const Due due = next_due(entry, edge);
    simulator_.schedule_at_turn(due.time, due.turn, [this, &entry, edge] { tell_next(entry, edge); });
}

// And of those after it, as long as nothing else is due in between: mostly they come in one go, and need not pass through
// the queue.
void Medium::tell_next(OnAir& entry, Edge edge) {
    Due due;
    do {
        const Heard& heard = entry.heard[entry.told[edge]++];
        const Arrival arrival{&entry.transmission,
                              heard.start,
                              heard.start + entry.transmission.duration,
                              heard.power_w,
                              entry.places[heard.place_index],
                              heard.lockable};
        const bool is_last = entry.told[edge] == entry.heard.size();
        try {
            MediumListener& listener = *touched_[heard.radio].listener;
            edge == Edge::begins ? listener.arrival_started(arrival) : listener.arrival_ended(arrival);
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

void Medium::tell(RadioId radio, OnAir& on_air, const Arrival& arrival) {
    if (!on_air.heard_is_complete) {
        const auto place_index = static_cast<std::uint32_t>(on_air.places.size());
        on_air.heard.push_back({arrival.start, arrival.power_w, radio, place_index, arrival.lockable});
        on_air.places.push_back(arrival.place);
        return;
    }
    const std::size_t apart = on_air.told_apart.size();
    on_air.told_apart.push_back(arrival);
    if (arrival.start < simulator_.now()) {
        // It came to matter after it had begun: nothing that the radio could have noticed happened in
        // between.
        begin(radio, on_air, apart);
        return;
    }
    simulator_.schedule_at_turn(arrival.start, on_air.first_turn + 2 * static_cast<Turn>(radio),
                                [this, radio, &on_air, apart] { begin(radio, on_air, apart); });
}

void Medium::begin(RadioId radio, const OnAir& on_air, std::size_t apart) {
    const Arrival arrival = on_air.told_apart[apart];  // a copy: others may be told meanwhile
    touched_[radio].listener->arrival_started(arrival);
    simulator_.schedule_at_turn(arrival.end, on_air.first_turn + 2 * static_cast<Turn>(radio) + 1,
                                [this, radio, &on_air, apart] {
                                    const Arrival ended = on_air.told_apart[apart];
                                    touched_[radio].listener->arrival_ended(ended);
                                });
}

void Medium::forget_the_past() {
    const SimTime now = simulator_.now();
    const auto active = std::find_if(on_air_.begin(), on_air_.end(),
                                     [now](const auto& entry) { return entry->last_end >= now; });
    const SimTime needed_from =
        std::min(now - remembered_, active == on_air_.end() ? now : (*active)->transmission.start);
    while (!on_air_.empty() && on_air_.front()->last_end < needed_from) {
        on_air_.front()->transmission.frame.reset();
        spare_.push_back(std::move(on_air_.front()));
        on_air_.pop_front();
    }
}

}  // namespace netsim
