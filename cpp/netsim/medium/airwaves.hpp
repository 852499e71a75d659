// What is on the air, or was as lately as it can matter, and what of it arrives where.
//
// Each transmission has an entry in the order of their starts. What the medium and the watch over energy note there is theirs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "netsim/carrier_sense/energy_ring.hpp"
#include "netsim/kernel/event_queue.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/links.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

// An arrival that matters to the radio by itself, as is known when the transmission begins. The radio is told twice: of its
// beginning and of its end, in their order among those of all who hear it (OnAir::told counts them). A radio to which it
// comes to matter later, together with others, is told apart. All other radios never learn of it: there it is energy and
// interference, summed where somebody asks.
struct Heard {
    SimTime start;
    double power_w = 0;
    RadioId radio = 0;
    std::uint32_t place_index = 0;  // of the entry's places
    bool lockable = false;
};

// First what whoever looks for those that matter asks of each: one cache line, with the beginning of the transmission.
struct alignas(64) OnAir {
    // What a radio is told of an arrival; at one time, in this order.
    enum Edge : std::uint8_t { begins = 0, ends = 1 };
    Turn turn_at(RadioId radio, Edge edge) const { return first_turn + 2 * static_cast<Turn>(radio) + edge; }

    SimTime last_end;       // at its most distant receiver, or later
    double odometer_m = 0;  // at its start
    double ring_m = 0;      // nobody farther away is in one of its rings
    Transmission transmission;
    Turn first_turn = 0;                // of its arrivals' events, two for each receiver
    double reach_m = 0;                 // nobody locks on to it farther away
    bool arrives_at_once = false;       // at one whom it matters to
    double others_w = 0;                // within that, at most, of all that are on the air beside it
    std::vector<const OnAir*> close;    // of those, where that bound says little of any one place,
    double far_w = 0;                   // and at most what all the others bring
    std::vector<Heard> heard;           // by those known when it began, in the order of their events
    bool heard_is_complete = false;     // who comes to notice it later is told apart
    std::vector<Position> places;       // of theirs, at its start
    std::array<std::size_t, 2> told{};  // [edge]: so many of `heard`
    std::vector<Arrival> told_apart;    // by the others
    std::vector<double> shares;         // [audience]: of its power, in their band
    std::vector<EnergyRing> rings;      // [audience]
};

class Airwaves {
public:
    explicit Airwaves(const Links& links) : links_(links) {}

    // A transmission that begins now, where its sender is; `first_turn` is that of its arrivals' events. Fills in its id, start
    // and origin.
    OnAir& put(Transmission transmission, SimTime now, Turn first_turn);
    // Those that ended `remembered` ago, unless one is on the air that began before their end.
    void forget_the_past(SimTime now, SimTime remembered);

    bool empty() const { return entries_.empty(); }
    std::size_t size() const { return entries_.size(); }
    // By start.
    const std::vector<std::unique_ptr<OnAir>>& entries() const { return entries_; }
    // The entries' ids are those in between: 0, 1, 2, … in the order of starting.
    std::uint64_t first_id() const { return entries_.front()->transmission.id; }
    std::uint64_t next_id() const { return next_id_; }
    OnAir& of_id(std::uint64_t id) const { return *entries_[id - first_id()]; }
    // Those that began before `newest` and are not over everywhere as it begins.
    void find_those_beside(const OnAir& newest, std::vector<OnAir*>& beside) const;

    // In the header, as sums over all that is on the air call it for each.
    Arrival arrival_at(const OnAir& on_air, RadioId radio) const {
        return arrival_at_place(on_air, radio, links_.position(radio, on_air.transmission.start));
    }
    // The same, mostly with less to look up. `place`: where the radio was when any of those on the air began.
    Arrival arrival_at(const OnAir& on_air, RadioId radio, const Position& place, SimTime now) const {
        return nobody_moved(now) ? arrival_at_place(on_air, radio, place) : arrival_at(on_air, radio);
    }
    // Of that arrival.
    double power_at(const OnAir& on_air, RadioId radio, const Position& place, SimTime now) const {
        return nobody_moved(now)
                   ? power_at_place(on_air, radio, place)
                   : power_at_place(on_air, radio, links_.position(radio, on_air.transmission.start));
    }
    double share_at(const OnAir& on_air, RadioId radio) const {
        return on_air.shares[links_.audience_of(radio)];
    }
    // A function of a radius in m: the most that `there`, sent with at most that power, antennas included, brings to receivers
    // within the radius of where `here` began when that did.
    auto most_brought_w(const OnAir& there, const OnAir& here, double most_sent_w) const {
        const double moved_m = std::abs(there.odometer_m - here.odometer_m);
        const double between_m =
            distance(here.transmission.origin, there.transmission.origin) * (1 - rounding_margin) - moved_m;
        const double sent_w = most_sent_w * (1 + rounding_margin);
        return [this, between_m, sent_w, carrier_hz = there.transmission.band.carrier_hz](double radius_m) {
            return sent_w * links_.most_gain_beyond(std::max(between_m - radius_m, 0.0), carrier_hz);
        };
    }

private:
    // With the radio at `place` when the transmission starts.
    Arrival arrival_at_place(const OnAir& on_air, RadioId radio, const Position& place) const {
        Arrival arrival = links_.arrival(on_air.transmission, share_at(on_air, radio), radio, place);
        arrival.on_air = &on_air;
        return arrival;
    }
    double power_at_place(const OnAir& on_air, RadioId radio, const Position& place) const {
        const Transmission& sent = on_air.transmission;
        return links_.power_w(sent, share_at(on_air, radio), radio, place, distance(sent.origin, place));
    }
    // Since the first of those on the air began.
    bool nobody_moved(SimTime now) const {
        return links_.odometer().all_stand() &&
               links_.odometer().reading_m(now) == entries_.front()->odometer_m;
    }

    const Links& links_;
    std::vector<std::unique_ptr<OnAir>> entries_;
    std::vector<std::unique_ptr<OnAir>> spare_;  // forgotten ones, of use again
    std::uint64_t next_id_ = 0;
};

}  // namespace netsim
