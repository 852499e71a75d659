// Cumulative energy detection: finds the radios at which several transmissions, none of which
// exceeds the ED threshold alone, make the channel busy together. Only radios that watch their
// channel take part. carrier_sense/README.md explains it with a drawing.
//
// Words, all in W: the power of one transmission at a receiver, a sum of powers, the energy (a sum
// and the noise), the ED threshold of the receiver, and the headroom from the energy to the
// threshold. `max_` is an upper bound.
//
// The medium calls it for each transmission that starts while others are on the air, and notifies
// the affected radios.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "netsim/carrier_sense/energy_timeline.hpp"
#include "netsim/carrier_sense/energy_timeline_pool.hpp"
#include "netsim/carrier_sense/watch_zones.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/medium/active_transmissions.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/links.hpp"

namespace netsim {

class CumulativeEnergyListener {
public:
    // The radio must be notified of an arrival that it would not notice alone. If the arrival has
    // begun, at once.
    virtual void arrival_needed(RadioId radio, ActiveTransmission& active, const Arrival& arrival) = 0;

protected:
    ~CumulativeEnergyListener() = default;
};

class CumulativeEnergyDetection {
public:
    CumulativeEnergyDetection(Simulator& simulator, Links& links,
                              const ActiveTransmissions& active_transmissions,
                              CumulativeEnergyListener& listener)
        : simulator_(simulator),
          links_(links),
          active_transmissions_(active_transmissions),
          listener_(listener) {}

    // Call it once for each radio added to `links`.
    void add_radio() { timelines_.add_radio(); }
    // Starts the watch zones of a new transmission in the group with that index. The caller adds
    // each receiver that receives at least the zones' min_power_w().
    void begin_zones(ActiveTransmission& here, std::size_t index);
    // Evaluates the newest transmission with the concurrent ones: now, or at the end of this
    // instant.
    void add(ActiveTransmission& newest, const std::vector<ActiveTransmission*>& concurrent);
    // From now on, the radio takes part. It must be marked as watching. Returns the same as
    // Medium::watch_energy.
    SimTime watch(RadioId radio, SimTime since);
    // How often the power of a transmission at a radio was computed.
    std::uint64_t evaluation_count() const { return evaluation_count_; }

private:
    // A bound for the power of a transmission at all receivers to be watched.
    struct Bound {
        const ActiveTransmission* from = nullptr;
        double max_w = 0;
        double sum_w = 0;  // of this bound and those after it
    };
    // A transmission that is or was on the air, at one receiver.
    struct RecentSignal {
        ActiveTransmission* active = nullptr;
        double power_w = 0;
        bool is_in_watch_zone = false;
    };
    // The start or the end of a recent signal.
    struct Change {
        SimTime time;
        SequenceNumber number = 0;
        const RecentSignal* recent = nullptr;
        bool begins = true;
    };

    // Unknown headroom: it must be computed again.
    static constexpr double unknown_w = 0;
    // The evaluation of at least this many unreported frames is worth an event to defer it.
    static constexpr std::size_t min_deferred = 4;
    static SimTime just_before(SimTime time) { return time - SimTime::from_ps(1); }

    void evaluate_started_now();
    // `concurrent`, here and below: the transmissions concurrent with the newest one.
    void evaluate(ActiveTransmission& newest, const std::vector<ActiveTransmission*>& concurrent);
    void evaluate_group(ActiveTransmission& newest, const std::vector<ActiveTransmission*>& concurrent,
                        std::size_t group);
    // Reduces the headroom of receivers in the watch zones of `here` by the power of `there`. One of
    // the two is the newest transmission.
    void add_to_zones(ActiveTransmission& here, const ActiveTransmission& there, std::size_t group);
    // Recomputes the bounds of the other transmissions zone by zone, and watches the receivers in
    // the added zones.
    void widen_zones(ActiveTransmission& here, const ActiveTransmission& newest,
                     const std::vector<ActiveTransmission*>& concurrent, std::size_t index);
    double power_at(const ActiveTransmission& active, RadioId radio, const Position& place) {
        ++evaluation_count_;
        return active.transmission.radio == radio
                   ? 0
                   : active_transmissions_.power_at(active, radio, place, simulator_.now());
    }
    // Reports enough arrivals to the radio for it to find its channel busy at the right times.
    // Returns the headroom in W: how far the sum may still rise before more must be reported. Not
    // positive if unknown. The radio's timeline stores the result, because the zones of several
    // transmissions need it.
    double headroom_at(RadioId radio, const Position& place);
    // Calls headroom_at at that time, if the radio watches then.
    void evaluate_at(RadioId radio, SimTime time);
    // The headroom of a radio that receives `power_w` from one transmission, and at most
    // `bounds_` from the others.
    double headroom_by_bounds(RadioId radio, const Position& place, double power_w);
    // Whether the radio was, or would have been, notified of the arrival's end.
    bool has_ended(const ActiveTransmission& active, const Arrival& arrival, RadioId radio) const {
        return simulator_.has_passed(arrival.end, active.sequence_number(radio, ActiveTransmission::ends));
    }
    void add_to_timeline(EnergyTimeline& timeline, RadioId radio, const Position& place,
                         const ActiveTransmission& active);
    bool may_be_in_watch_zone(const Position& place, SimTime since) const;
    double find_recent(RadioId radio, const Position& place, SimTime since);
    void watch_recent(RadioId radio, const Position& place);
    double headroom_before_next(RadioId radio, const Position& place);
    // When the sum of the signals in `recent_` last fell below the ED threshold after `since`. Long
    // ago if it did not.
    SimTime last_busy_end(RadioId radio, const Position& place, SimTime since);

    Simulator& simulator_;
    Links& links_;
    const ActiveTransmissions& active_transmissions_;
    CumulativeEnergyListener& listener_;
    EnergyTimelinePool timelines_;
    std::vector<ActiveTransmission*> started_now_;  // not evaluated yet
    bool evaluates_at_end_of_instant_ = false;      // an event will evaluate started_now_
    std::vector<ActiveTransmission*> concurrent_;   // with one in started_now_
    std::vector<Bound> bounds_;
    std::vector<RecentSignal> recent_;  // in the order of starts
    std::vector<Change> changes_;
    std::vector<const RecentSignal*> present_;
    std::uint64_t evaluation_count_ = 0;
};

}  // namespace netsim
