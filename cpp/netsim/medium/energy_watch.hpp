// Finds the radios at which several transmissions, none of which matters alone, make the channel busy together. Only those
// that watch their channels are looked for; who begins to is told what it has to know.
//
// The medium calls it for each transmission that has others beside it, and passes on what it finds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "netsim/carrier_sense/energy_forecast.hpp"
#include "netsim/carrier_sense/energy_outlooks.hpp"
#include "netsim/carrier_sense/energy_ring.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/medium/airwaves.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/links.hpp"

namespace netsim {

class EnergyListener {
public:
    // The radio has to be told of that arrival, of one that it would not notice alone; at once if it has begun.
    virtual void energy_matters(RadioId radio, OnAir& on_air, const Arrival& arrival) = 0;

protected:
    ~EnergyListener() = default;
};

class EnergyWatch {
public:
    EnergyWatch(Simulator& simulator, Links& links, const Airwaves& airwaves, EnergyListener& listener)
        : simulator_(simulator), links_(links), airwaves_(airwaves), listener_(listener) {}

    // One more of those in `links`.
    void add_radio() { outlooks_.add_radio(); }
    // Begins a new transmission's ring among the audience of that index (energy_ring.hpp). Whoever then gets the ring's
    // least power is to be put into it.
    void begin_ring(OnAir& here, std::size_t index);
    // Tells where the newest and those beside it, none of which matters alone, make the channel busy: now, or at the end of
    // this instant.
    void add_up_in_time(OnAir& newest, const std::vector<OnAir*>& beside);
    // The radio, marked as one that watches, is told from now on (Medium::watch_energy says what this returns).
    SimTime watch(RadioId radio, SimTime since);
    // How often the power of a transmission at a radio was worked out.
    std::uint64_t look_count() const { return look_count_; }

private:
    // What a transmission can bring to any of the receivers that are to be watched.
    struct Bound {
        const OnAir* from = nullptr;
        double most_w = 0;
        double rest_w = 0;  // with those after it
    };
    // One that is or was on the air, at one receiver.
    struct Passing {
        OnAir* on_air = nullptr;
        double power_w = 0;
        bool is_in_its_ring = false;
    };
    // One of those begins or ends.
    struct Change {
        SimTime time;
        Turn turn = 0;
        const Passing* passing = nullptr;
        bool begins = true;
    };

    // Of what is missing: who needs to know has to ask again.
    static constexpr double unknown_w = 0;
    // To put off looking at so many frames that a radio was not told of.
    static constexpr std::size_t worth_an_event = 4;
    static SimTime just_before(SimTime time) { return time - SimTime::from_ps(1); }

    void add_up_those_begun_now();
    // `beside` are those beside the newest, here and below.
    void add_up(OnAir& newest, const std::vector<OnAir*>& beside);
    void tell_where_it_adds_up(OnAir& newest, const std::vector<OnAir*>& beside, std::size_t audience);
    // Those whom the ring of `here` watches miss less by what `there` brings. One of the two is the newest.
    void add_to_ring(OnAir& here, const OnAir& there, std::size_t audience);
    // Adds up anew what the others can bring, and watches whoever that calls for.
    void widen_ring(OnAir& here, const OnAir& newest, const std::vector<OnAir*>& beside, std::size_t index);
    double brought_w(const OnAir& on_air, RadioId radio, const Position& place) {
        ++look_count_;
        return on_air.transmission.radio == radio
                   ? 0
                   : airwaves_.power_at(on_air, radio, place, simulator_.now());
    }
    // Tells the radio of as many as it takes to find its channel busy when it is. Returns by how many W the sum may still
    // rise before more has to be told; not positive if that is not known. What is worked out once for a radio is kept in its
    // outlook, as the rings of several transmissions ask for it, and again for each new one.
    double missing_at(RadioId radio, const Position& place);
    // The same at that time, if it watches then.
    void look_at(RadioId radio, SimTime time);
    // The same for one that gets `received_w` of one transmission, and of the others at most what is in `bounds_`.
    double missing_by_bounds(RadioId radio, const Position& place, double received_w);
    // There, as the radio itself would have it.
    bool has_ended(const OnAir& on_air, const Arrival& arrival, RadioId radio) const {
        return simulator_.has_passed(arrival.end, on_air.turn_at(radio, OnAir::ends));
    }
    void foresee(EnergyForecast& forecast, RadioId radio, const Position& place, const OnAir& on_air);
    bool may_be_in_a_ring(const Position& place, SimTime since) const;
    double find_passing(RadioId radio, const Position& place, SimTime since);
    void watch_the_rest(RadioId radio, const Position& place);
    double missing_beside_those_coming(RadioId radio, const Position& place);
    // When those in `passing_` were enough for the last time since then, as the radio itself would have it.
    SimTime over_at(RadioId radio, const Position& place, SimTime since);

    Simulator& simulator_;
    Links& links_;
    const Airwaves& airwaves_;
    EnergyListener& listener_;
    EnergyOutlooks outlooks_;
    std::vector<OnAir*> begun_now_;       // not added up yet
    bool awaits_end_of_instant_ = false;  // to do that
    std::vector<OnAir*> beside_;          // one of those
    std::vector<Bound> bounds_;
    std::vector<Passing> passing_;  // by start
    std::vector<Change> changes_;
    std::vector<const Passing*> present_;
    std::uint64_t look_count_ = 0;
};

}  // namespace netsim
