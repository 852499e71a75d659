// What a radio that begins to watch has to know: when its channel was busy for the last time, and what of those on the air
// still keeps it so or may yet.
#include <algorithm>

#include "netsim/medium/energy_watch.hpp"

namespace netsim {

SimTime EnergyWatch::watch(RadioId radio, SimTime since) {
    if (airwaves_.empty()) {
        return SimTime::long_ago();
    }
    const Position place = links_.position(radio, simulator_.now());
    if (!may_be_in_a_ring(place, since)) {
        return SimTime::long_ago();  // mostly: they are far away
    }
    const double most_w = find_passing(radio, place, since);
    if (std::ranges::none_of(passing_, &Passing::is_in_its_ring)) {
        return SimTime::long_ago();
    }
    const bool was_busy = since < simulator_.now() && links_.kind(radio).missing_beside_w(most_w) <= 0;
    const SimTime over = was_busy ? over_at(radio, place, since) : SimTime::long_ago();
    watch_the_rest(radio, place);
    return over;
}

// Whether a radio that is there now was perhaps in a ring of those on the air since then. Outside of all, they never made its
// channel busy together.
bool EnergyWatch::may_be_in_a_ring(const Position& place, SimTime since) const {
    const double odometer_m = links_.odometer().reading_m(simulator_.now());
    // Without a branch, as a processor cannot guess which of them are over.
    int ring_count = 0;
    for (const std::unique_ptr<OnAir>& on_air : airwaves_.entries()) {
        const double within_m = (on_air->ring_m + (odometer_m - on_air->odometer_m)) * (1 + rounding_margin);
        const double squared_m2 = squared_distance(on_air->transmission.origin, place);
        ring_count +=
            static_cast<int>(on_air->last_end > since) & static_cast<int>(squared_m2 <= within_m * within_m);
    }
    return ring_count > 0;
}

// Fills `passing_`. Returns the most that they brought at one time, or more.
double EnergyWatch::find_passing(RadioId radio, const Position& place, SimTime since) {
    const std::uint32_t audience = links_.audience_of(radio);
    // Who brings that much is enough alone. More than that would leave nothing of the others when it is taken off again.
    const double enough_w = links_.kind(radio).energy_detection_w;
    passing_.clear();
    std::size_t first = 0;  // of those that may be on the air together with the one looked at
    double sum_w = 0;
    double most_w = 0;
    for (const std::unique_ptr<OnAir>& on_air : airwaves_.entries()) {
        const Transmission& sent = on_air->transmission;
        if (on_air->last_end <= since || on_air->shares[audience] == 0 || sent.radio == radio) {
            continue;
        }
        const double power_w = brought_w(*on_air, radio, place);
        passing_.push_back({on_air.get(), power_w, power_w >= on_air->rings[audience].least_power_w()});
        sum_w += std::min(power_w, enough_w);
        for (; passing_[first].on_air->last_end <= sent.start; ++first) {
            sum_w -= std::min(passing_[first].power_w, enough_w);
        }
        most_w = std::max(most_w, sum_w);
    }
    return most_w;
}

// The radio watches, of those in `passing_` that are still on the air, each in whose ring it is.
void EnergyWatch::watch_the_rest(RadioId radio, const Position& place) {
    const SimTime now = simulator_.now();
    const ReceiverKind& here = links_.kind(radio);
    const std::uint32_t audience = links_.audience_of(radio);
    // Those that are over everywhere, and of the strong ones also those that are over here.
    std::erase_if(passing_, [&](const Passing& passing) {
        return passing.on_air->last_end <= now ||
               (passing.is_in_its_ring &&
                has_ended(*passing.on_air, airwaves_.arrival_at(*passing.on_air, radio, place, now), radio));
    });
    double present_w = 0;
    for (const Passing& passing : passing_) {
        present_w += passing.power_w;
    }
    double missing_w = here.missing_beside_w(present_w);
    if (missing_w <= 0) {
        missing_w = missing_beside_those_coming(radio, place);
    }
    for (const auto& [on_air, power_w, is_in_its_ring] : passing_) {
        if (is_in_its_ring && !here.is_surely_loud(power_w)) {
            const Position then = airwaves_.arrival_at(*on_air, radio, place, now).place;
            on_air->rings[audience].watched().push_back({radio, then, missing_w});
        }
    }
}

// The same as missing_at, that is put off if several of those in `passing_` are still on their way, and it depends on them.
double EnergyWatch::missing_beside_those_coming(RadioId radio, const Position& place) {
    const SimTime now = simulator_.now();
    const ReceiverKind& here = links_.kind(radio);
    double present_w = 0;
    double arrived_w = 0;
    SimTime next_start = SimTime::never();
    std::size_t coming = 0;
    for (const Passing& passing : passing_) {
        const Arrival arrival = airwaves_.arrival_at(*passing.on_air, radio, place, now);
        if (has_ended(*passing.on_air, arrival, radio)) {
            continue;
        }
        present_w += arrival.power_w;
        if (simulator_.has_passed(arrival.start, passing.on_air->turn_at(radio, OnAir::begins))) {
            arrived_w += arrival.power_w;
        } else {
            next_start = std::min(next_start, arrival.start);
            ++coming;
        }
    }
    const double missing_w = here.missing_beside_w(present_w);
    if (missing_w > 0) {
        return missing_w;
    }
    if (next_start > now && here.missing_beside_w(arrived_w) > 0 && coming >= worth_an_event) {
        look_at(radio, just_before(next_start));
        return unknown_w;
    }
    return missing_at(radio, place);
}

// Adds up in the order of their transmissions, as the radio does.
SimTime EnergyWatch::over_at(RadioId radio, const Position& place, SimTime since) {
    const ReceiverKind& here = links_.kind(radio);
    const SimTime now = simulator_.now();
    changes_.clear();
    for (const Passing& passing : passing_) {
        const Arrival arrival = airwaves_.arrival_at(*passing.on_air, radio, place, now);
        if (arrival.end > since) {
            const OnAir& on_air = *passing.on_air;
            changes_.push_back({arrival.start, on_air.turn_at(radio, OnAir::begins), &passing, true});
            changes_.push_back({arrival.end, on_air.turn_at(radio, OnAir::ends), &passing, false});
        }
    }
    std::ranges::sort(changes_, [](const Change& a, const Change& b) {
        return a.time != b.time ? a.time < b.time : a.turn < b.turn;
    });
    present_.clear();
    SimTime over = SimTime::long_ago();
    bool was_loud = false;
    for (const Change& change : changes_) {
        if (!simulator_.has_passed(change.time, change.turn)) {
            break;
        }
        if (change.begins) {
            present_.insert(std::ranges::upper_bound(present_, change.passing), change.passing);
        } else {
            std::erase(present_, change.passing);
        }
        double energy_w = here.noise_w;
        for (const Passing* passing : present_) {
            energy_w += passing->power_w;
        }
        const bool loud = !present_.empty() && energy_w >= here.energy_detection_w;
        if (was_loud && !loud) {
            over = change.time;
        }
        was_loud = loud;
    }
    return over;
}

}  // namespace netsim
