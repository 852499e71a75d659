// The transmissions on the air, those that ended so recently that they can still matter, and their
// arrivals at each radio.
//
// There is one entry per transmission, in the order of their starts. The medium and the cumulative
// energy detection keep their own state of a transmission in its entry.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "netsim/carrier_sense/watch_zones.hpp"
#include "netsim/kernel/event_queue.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/links.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// An arrival that its radio notices, as is known when the transmission begins. The radio is notified
// of the start and the end, in order with the other receivers (ActiveTransmission::notified counts
// them). An arrival that becomes noticeable later, together with others, is in `late_arrivals`. All
// other radios are never notified: there, the transmission counts as energy and interference, summed
// on demand.
struct ScheduledArrival {
    SimTime start;
    double power_w = 0;
    RadioId radio = 0;
    std::uint32_t place_index = 0;  // in ActiveTransmission::places
    bool lockable = false;
};

// The first cache line holds what the search for concurrent transmissions reads.
struct alignas(64) ActiveTransmission {
    // The two events of an arrival. At equal times, the start of an arrival comes before its end.
    enum Edge : std::uint8_t { begins = 0, ends = 1 };
    SequenceNumber sequence_number(RadioId radio, Edge edge) const {
        return first_sequence_number + 2 * static_cast<SequenceNumber>(radio) + edge;
    }

    SimTime last_end;           // its end at the most distant receiver, or later
    double displacement_m = 0;  // DisplacementBound::total_m at its start
    double zone_radius_m = 0;   // no radio farther away is in one of its watch zones
    Transmission transmission;
    SequenceNumber first_sequence_number = 0;  // two for each radio: start and end of the arrival
    double reach_m = 0;                        // no radio farther away locks on to it
    bool arrives_immediately = false;          // without delay at some radio
    double max_interference_w = 0;             // bound for all concurrent transmissions, within reach_m
    // Concurrent transmissions for which that bound is too loose at single receivers.
    std::vector<const ActiveTransmission*> close_interferers;
    double max_far_interference_w = 0;        // bound for all others, within reach_m
    std::vector<ScheduledArrival> scheduled;  // known at the start; in the order of their events
    bool arrivals_are_scheduled = false;      // later arrivals go to `late_arrivals`
    std::vector<Position> places;             // of the receivers in `scheduled`, at the start
    std::array<std::size_t, 2> notified{};    // [edge]: how many of `scheduled` were notified
    std::vector<Arrival> late_arrivals;
    std::vector<double> shares;     // [group]: fraction of the power in the group's band
    std::vector<WatchZones> zones;  // [group]
};

class ActiveTransmissions {
public:
    explicit ActiveTransmissions(const Links& links) : links_(links) {}

    // Adds a transmission that begins now, at the sender's position. Fills in its id, start and
    // origin. `first_sequence_number`: the first one of the events of its arrivals.
    ActiveTransmission& put(Transmission transmission, SimTime now, SequenceNumber first_sequence_number);
    // Drops transmissions that ended more than `remembered` ago, unless one that is still on the air
    // began before their end.
    void forget_ended(SimTime now, SimTime remembered);

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    // In the order of starts.
    const std::vector<std::unique_ptr<ActiveTransmission>>& entries() const { return entries_; }
    // Ids count up from 0 in the order of starts. The entries have the ids from first_id() to
    // next_id() - 1.
    std::uint64_t first_id() const { return entries_.front()->transmission.id(); }
    std::uint64_t next_id() const { return next_id_; }
    ActiveTransmission& of_id(std::uint64_t id) const { return *entries_[id - first_id()]; }
    // Writes to `concurrent` the transmissions that began before `newest` and have not ended at
    // every receiver when it begins.
    void find_concurrent(const ActiveTransmission& newest,
                         std::vector<ActiveTransmission*>& concurrent) const;

    // Inline: sums over all transmissions call it once for each.
    Arrival arrival_at(const ActiveTransmission& active, RadioId radio) const {
        return arrival_at_place(active, radio, links_.position(radio, active.transmission.start));
    }
    // The same, usually without a position lookup. `place`: the radio's position when any of the
    // entries began.
    Arrival arrival_at(const ActiveTransmission& active, RadioId radio, const Position& place,
                       SimTime now) const {
        return all_stood(now) ? arrival_at_place(active, radio, place) : arrival_at(active, radio);
    }
    // The power of that arrival, in W.
    double power_at(const ActiveTransmission& active, RadioId radio, const Position& place,
                    SimTime now) const {
        return all_stood(now)
                   ? power_at_place(active, radio, place)
                   : power_at_place(active, radio, links_.position(radio, active.transmission.start));
    }
    double share_at(const ActiveTransmission& active, RadioId radio) const {
        return active.shares[links_.group_of(radio)];
    }
    // Returns a function of a radius in m: an upper bound in W for the power of `there` at all
    // receivers within that radius around the origin of `here`. `max_sent_w` is a bound for the sent
    // power, including antenna gains.
    auto max_received_w(const ActiveTransmission& there, const ActiveTransmission& here,
                        double max_sent_w) const {
        const double moved_m = std::abs(there.displacement_m - here.displacement_m);
        const double between_m =
            distance(here.transmission.origin, there.transmission.origin) * (1 - rounding_margin) - moved_m;
        const double sent_w = max_sent_w * (1 + rounding_margin);
        return [this, between_m, sent_w, carrier_hz = there.transmission.band.carrier_hz](double radius_m) {
            return sent_w * links_.max_gain_beyond(std::max(between_m - radius_m, 0.0), carrier_hz);
        };
    }

private:
    // `place`: the radio's position when the transmission starts.
    Arrival arrival_at_place(const ActiveTransmission& active, RadioId radio, const Position& place) const {
        Arrival arrival = links_.arrival(active.transmission, share_at(active, radio), radio, place);
        arrival.active = &active;
        return arrival;
    }
    double power_at_place(const ActiveTransmission& active, RadioId radio, const Position& place) const {
        const Transmission& sent = active.transmission;
        return links_.power_w(sent, share_at(active, radio), radio, place, distance(sent.origin, place));
    }
    // Whether no node has moved since the first entry began.
    bool all_stood(SimTime now) const {
        return links_.displacement().all_stand() &&
               links_.displacement().total_m(now) == entries_.front()->displacement_m;
    }

    const Links& links_;
    std::vector<std::unique_ptr<ActiveTransmission>> entries_;
    std::vector<std::unique_ptr<ActiveTransmission>> spare_;  // dropped entries, reused with their memory
    std::uint64_t next_id_ = 0;
};

}  // namespace netsim
