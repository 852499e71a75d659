// Each transmission has rings of receivers that it has to watch (energy_ring.hpp), one for each audience. At each of
// them, as long as the transmission lasts there, one of two things holds at any moment: the radio was told of enough to
// find its channel busy, or all that is on the air stays below the level, by what the ring says is missing. Where bounds
// do not tell what is missing, the sum of the powers does (energy_forecast.hpp).
//
// Looking at a radio is put off while nothing depends on it: until what it was told of is not enough any more, or the next
// frame arrives. By then more frames are known, or it sends itself.
#include "netsim/medium/energy_watch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace netsim {

void EnergyWatch::begin_ring(OnAir& here, std::size_t index) {
    Audience& audience = links_.audiences()[index];
    const Transmission& sent = here.transmission;
    EnergyRing& ring = here.rings[index];
    const double level_w = audience.noticed_energy_w();
    if (level_w < std::numeric_limits<double>::min()) {  // of less there may be no parts, and so no zones
        ring.begin_without_zones();
        return;
    }
    ring.begin(level_w,
               links_.known_reach_m(audience.ring_reach, sent, audience, EnergyRing::first_zone_w(level_w)),
               links_.known_reach_m(audience.outer_reach, sent, audience, EnergyRing::outer_w(level_w)));
    here.ring_m = std::max(here.ring_m, ring.radius_m());
}

void EnergyWatch::add_up(OnAir& newest, const std::vector<OnAir*>& beside) {
    for (std::size_t audience = 0; audience < links_.audiences().size(); ++audience) {
        if (newest.shares[audience] > 0) {
            tell_where_it_adds_up(newest, beside, audience);
        }
    }
}

// Many may begin in one instant, as those of stations whose slots end together. Most of the radios that watch will transmit
// by the end of it, too, and need not be looked at. So all but the first few wait until then: they arrive after it, but for
// a radio in the same place.
void EnergyWatch::add_up_in_time(OnAir& newest, const std::vector<OnAir*>& beside) {
    constexpr std::size_t few = 4;
    if (beside.size() < few || beside[beside.size() - few]->transmission.start < newest.transmission.start) {
        add_up(newest, beside);
        return;
    }
    begun_now_.push_back(&newest);
    if (!std::exchange(awaits_end_of_instant_, true)) {
        const auto at_its_end = [this] {
            awaits_end_of_instant_ = false;
            add_up_those_begun_now();
        };
        simulator_.schedule_at(simulator_.now(), at_its_end, Priority::last);
    }
    if (newest.arrives_at_once) {
        add_up_those_begun_now();
    }
}

void EnergyWatch::add_up_those_begun_now() {
    for (OnAir* each : begun_now_) {
        airwaves_.find_those_beside(*each, beside_);
        add_up(*each, beside_);
    }
    begun_now_.clear();
}

void EnergyWatch::tell_where_it_adds_up(OnAir& newest, const std::vector<OnAir*>& beside,
                                        std::size_t audience) {
    for (OnAir* other : beside) {
        if (other->shares[audience] > 0) {
            add_to_ring(*other, newest, audience);
            if (other->rings[audience].is_too_narrow()) {
                widen_ring(*other, newest, beside, audience);
            }
            add_to_ring(newest, *other, audience);
        }
    }
    if (newest.rings[audience].is_too_narrow()) {
        widen_ring(newest, newest, beside, audience);
    }
}

void EnergyWatch::add_to_ring(OnAir& here, const OnAir& there, std::size_t audience) {
    EnergyRing& ring = here.rings[audience];
    const auto bound_w = airwaves_.most_brought_w(
        there, here, links_.most_power_w(there.transmission, links_.audiences()[audience]));
    const double most_w = bound_w(ring.radius_m());
    std::erase_if(ring.watched(), [this](const EnergyRing::Watched& watched) {
        return !links_.watches_energy(watched.radio);
    });
    for (EnergyRing::Watched& watched : ring.watched()) {
        if (watched.missing_w > most_w) {
            watched.missing_w -= most_w;
            continue;
        }
        // The bound does not tell, perhaps the power does.
        if (!outlooks_.has(watched.radio)) {
            watched.missing_w -= brought_w(there, watched.radio, watched.place);
            if (watched.missing_w > 0) {
                continue;
            }
        }
        watched.missing_w = missing_at(watched.radio, watched.place);
    }
    ring.add(bound_w);
}

void EnergyWatch::widen_ring(OnAir& here, const OnAir& newest, const std::vector<OnAir*>& beside,
                             std::size_t index) {
    Audience& audience = links_.audiences()[index];
    const Transmission& sent = here.transmission;
    EnergyRing& ring = here.rings[index];
    const auto visit_others = [&](const auto& visitor) {
        if (&newest != &here) {
            visitor(newest);
        }
        for (const OnAir* other : beside) {
            if (other != &here && other->shares[index] > 0) {
                visitor(*other);
            }
        }
    };
    ring.forget_others(beside.size(),
                       [&](double power_w) { return links_.reach_of_power_m(sent, audience, power_w); });
    visit_others([&](const OnAir& other) {
        ring.add(airwaves_.most_brought_w(other, here, links_.most_power_w(other.transmission, audience)));
    });
    if (!ring.is_too_narrow()) {
        return;
    }
    const double watched_before_w = ring.least_power_w();
    ring.widen();
    const double radius_m = ring.radius_m();
    here.ring_m = std::max(here.ring_m, radius_m);
    bounds_.clear();
    visit_others([&](const OnAir& other) {
        const double most_sent_w = links_.most_power_w(other.transmission, audience);
        bounds_.push_back({&other, airwaves_.most_brought_w(other, here, most_sent_w)(radius_m)});
    });
    // The largest bounds are those of the nearest, and the farthest from the truth.
    std::ranges::sort(bounds_, std::greater(), &Bound::most_w);
    double rest_w = 0;
    std::for_each(bounds_.rbegin(), bounds_.rend(),
                  [&](Bound& bound) { rest_w = bound.rest_w = rest_w + bound.most_w; });
    const double share = here.shares[index];
    const double moved_m = links_.odometer().reading_m(simulator_.now()) - here.odometer_m;
    const double loud_to_all_m = std::max(links_.loud_to_all_m(sent, audience) - moved_m, 0.0);
    for (const auto& [place, radio] : audience.members.near(sent.origin, radius_m + moved_m)) {
        if (!links_.watches_energy(radio) ||
            squared_distance(sent.origin, place) < loud_to_all_m * loud_to_all_m || radio == sent.radio) {
            continue;
        }
        ++look_count_;
        const double received_w = moved_m > 0 || !links_.odometer().all_stand()
                                      ? airwaves_.arrival_at(here, radio).power_w
                                      : links_.power_w(sent, share, radio, place,
                                                       distance(sent.origin, place), ring.least_power_w());
        if (received_w >= ring.least_power_w() && received_w < watched_before_w &&
            !links_.kind(radio).is_surely_loud(received_w)) {
            ring.watched().push_back({radio, place, missing_by_bounds(radio, place, received_w)});
        }
    }
}

// Bounds give way to powers, one after the other, until it is known that something is missing.
double EnergyWatch::missing_by_bounds(RadioId radio, const Position& place, double received_w) {
    if (!outlooks_.has(radio)) {
        const ReceiverKind& receiver = links_.kind(radio);
        const double level_w = receiver.energy_detection_w * (1 - rounding_margin);
        double known_w = receiver.noise_w + received_w;
        auto bound = bounds_.begin();
        for (; bound != bounds_.end() && known_w + bound->rest_w >= level_w; ++bound) {
            known_w += brought_w(*bound->from, radio, place);
        }
        const double missing_w = level_w - (known_w + (bound == bounds_.end() ? 0 : bound->rest_w));
        if (missing_w > 0) {
            return missing_w;
        }
    }
    return missing_at(radio, place);
}

double EnergyWatch::missing_at(RadioId radio, const Position& place) {
    const SimTime now = simulator_.now();
    EnergyOutlook& outlook = outlooks_.of(radio, links_.kind(radio).noise_w, now);
    if (outlook.next_id == airwaves_.next_id() && outlook.rests_until == SimTime::long_ago()) {
        return outlook.missing_w;
    }
    if (now < outlook.rests_until) {
        return unknown_w;
    }
    outlook.forecast.begin_at(now);
    for (std::uint64_t id = std::max(outlook.next_id, airwaves_.first_id()); id < airwaves_.next_id(); ++id) {
        const OnAir& other = airwaves_.of_id(id);
        if (other.last_end > now) {
            foresee(outlook.forecast, radio, place, other);
        }
    }
    outlook.next_id = airwaves_.next_id();
    const SimTime rests_until =
        just_before(outlook.forecast.told_until(links_.kind(radio).energy_detection_w));
    if (now < rests_until && outlook.forecast.untold_count() >= worth_an_event) {
        outlook.rests_until = rests_until;
        look_at(radio, rests_until);
        return unknown_w;
    }
    outlook.rests_until = SimTime::long_ago();
    outlook.missing_w = outlook.forecast.settle(
        links_.kind(radio).energy_detection_w, [&](const EnergyForecast::Coming& coming) {
            OnAir& other = airwaves_.of_id(coming.transmission);
            // The place is not quite that of a radio that moves: only what can be locked on is asked for it.
            listener_.energy_matters(
                radio, other,
                Arrival{&other.transmission, coming.start, coming.end, coming.power_w, place, false, &other});
        });
    return outlook.missing_w;
}

void EnergyWatch::look_at(RadioId radio, SimTime time) {
    const auto look = [this, radio] {
        if (links_.watches_energy(radio)) {
            missing_at(radio, links_.position(radio, simulator_.now()));
        }
    };
    simulator_.schedule_at(time, look, Priority::last);
}

void EnergyWatch::foresee(EnergyForecast& forecast, RadioId radio, const Position& place,
                          const OnAir& on_air) {
    const Transmission& sent = on_air.transmission;
    if (sent.radio == radio || airwaves_.share_at(on_air, radio) == 0) {
        return;
    }
    ++look_count_;
    const Arrival arrival = airwaves_.arrival_at(on_air, radio, place, simulator_.now());
    if (has_ended(on_air, arrival, radio)) {
        return;
    }
    const EnergyForecast::Coming coming{sent.id, arrival.start, arrival.end, arrival.power_w};
    const bool is_loud_alone = links_.kind(radio).is_loud(arrival.power_w);
    if (arrival.lockable || is_loud_alone) {
        forecast.add_told(
            coming, arrival.lockable ? arrival.start + links_.kind(radio).detection_time : arrival.start,
            is_loud_alone);
    } else {
        forecast.add_untold(coming);
    }
}

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
