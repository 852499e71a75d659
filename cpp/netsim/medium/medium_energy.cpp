// The part of the medium that finds the radios at which several transmissions, none of which matters alone, make the
// channel busy together. Only those that watch their channels are looked for; who begins to is told what it has to know.
//
// Each transmission has rings of receivers that it has to watch (energy_ring.hpp), one for each audience. At each of
// them, as long as the transmission lasts there, one of two things holds at any moment: the radio was told of enough to
// find its channel busy, or all that is on the air stays below the level, by what the ring says is missing. Where bounds
// do not tell what is missing, the sum of the powers does (energy_forecast.hpp).
//
// Looking at a radio is put off while nothing depends on it: until what it was told of is not enough any more, or the next
// frame arrives. By then more frames are known, or it sends itself.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "netsim/medium/medium.hpp"

namespace netsim {

namespace {

// Of what is missing: who needs to know has to ask again.
constexpr double unknown_w = 0;

// To put off looking at so many frames that a radio was not told of.
constexpr std::size_t worth_an_event = 4;

SimTime just_before(SimTime time) {
    return time - SimTime::from_ps(1);
}

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
        if (other->transmission.id < newest.transmission.id && other->last_end > newest.transmission.start) {
            beside_.push_back(other.get());
        }
    }
}

void Medium::bound_interference(OnAir& here, const OnAir& there) const {
    const double most_w = antennas_.all_isotropic()
                              ? most_brought_w(there, here, there.transmission.power_w)(here.reach_m)
                              : std::numeric_limits<double>::infinity();
    here.others_w += most_w;
    // From six times the reach away, in free space, the nearest receiver gets twice what the farthest gets.
    constexpr double close = 6;
    if (propagation_.is_random() || most_w == std::numeric_limits<double>::infinity() ||
        squared_distance(here.transmission.origin, there.transmission.origin) <
            close * close * here.reach_m * here.reach_m) {
        here.close.push_back(&there);
    } else {
        here.far_w += most_w;
    }
}

void Medium::add_up_energy(OnAir& newest) {
    for (std::size_t audience = 0; audience < audiences_.size(); ++audience) {
        if (newest.shares[audience] > 0) {
            tell_where_energy_adds_up(newest, audience);
        }
    }
}

// Many may begin in one instant, as those of stations whose slots end together. Most of the radios that watch will transmit
// by the end of it, too, and need not be looked at. So all but the first few wait until then: they arrive after it, but for
// a radio in the same place.
void Medium::add_up_energy_in_time(OnAir& newest) {
    constexpr std::size_t few = 4;
    if (beside_.size() < few ||
        beside_[beside_.size() - few]->transmission.start < newest.transmission.start) {
        add_up_energy(newest);
        return;
    }
    begun_now_.push_back(&newest);
    if (!std::exchange(awaits_end_of_instant_, true)) {
        const auto at_its_end = [this] {
            awaits_end_of_instant_ = false;
            add_up_energy_of_those_begun_now();
        };
        simulator_.schedule_at(simulator_.now(), at_its_end, Priority::last);
    }
    if (newest.arrives_at_once) {
        add_up_energy_of_those_begun_now();
    }
}

void Medium::add_up_energy_of_those_begun_now() {
    for (OnAir* each : begun_now_) {
        find_those_beside(*each);
        add_up_energy(*each);
    }
    begun_now_.clear();
}

void Medium::tell_where_energy_adds_up(OnAir& newest, std::size_t audience) {
    for (OnAir* other : beside_) {
        if (other->shares[audience] > 0) {
            add_to_ring(*other, newest, audience);
            if (other->rings[audience].is_too_narrow()) {
                widen_ring(*other, newest, audience);
            }
            add_to_ring(newest, *other, audience);
        }
    }
    if (newest.rings[audience].is_too_narrow()) {
        widen_ring(newest, newest, audience);
    }
}

void Medium::add_to_ring(OnAir& here, const OnAir& there, std::size_t audience) {
    EnergyRing& ring = here.rings[audience];
    const auto bound_w = most_brought_w(there, here, most_power_w(there.transmission, audiences_[audience]));
    const double most_w = bound_w(ring.radius_m());
    std::erase_if(ring.watched(), [this](const EnergyRing::Watched& watched) {
        return !attached_[watched.radio].watches_energy;
    });
    for (EnergyRing::Watched& watched : ring.watched()) {
        if (watched.missing_w > most_w) {
            watched.missing_w -= most_w;
            continue;
        }
        // The bound does not tell, perhaps the power does.
        if (outlook_of_[watched.radio] == no_outlook) {
            watched.missing_w -= brought_w(there, watched.radio, watched.place);
            if (watched.missing_w > 0) {
                continue;
            }
        }
        watched.missing_w = missing_at(watched.radio, watched.place);
    }
    ring.add(bound_w);
}

void Medium::widen_ring(OnAir& here, const OnAir& newest, std::size_t index) {
    Audience& audience = audiences_[index];
    const Transmission& sent = here.transmission;
    EnergyRing& ring = here.rings[index];
    const auto visit_others = [&](const auto& visitor) {
        if (&newest != &here) {
            visitor(newest);
        }
        for (const OnAir* other : beside_) {
            if (other != &here && other->shares[index] > 0) {
                visitor(*other);
            }
        }
    };
    ring.forget_others(beside_.size(),
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
        bounds_.push_back({&other, most_brought_w(other, here, most_sent_w)(radius_m)});
    });
    // The largest bounds are those of the nearest, and the farthest from the truth.
    std::ranges::sort(bounds_, std::greater(), &Bound::most_w);
    double rest_w = 0;
    std::for_each(bounds_.rbegin(), bounds_.rend(),
                  [&](Bound& bound) { rest_w = bound.rest_w = rest_w + bound.most_w; });
    const double share = here.shares[index];
    const double moved_m = odometer_.reading_m(simulator_.now()) - here.odometer_m;
    const double loud_to_all_m = std::max(loud_to_all_m_of(sent, audience) - moved_m, 0.0);
    for (const auto& [radio, place] : audience.members.near(sent.origin, radius_m + moved_m)) {
        if (!attached_[radio].watches_energy ||
            squared_distance(sent.origin, place) < loud_to_all_m * loud_to_all_m || radio == sent.radio) {
            continue;
        }
        ++energy_looks_;
        const double received_w =
            moved_m > 0 || !odometer_.all_stand()
                ? arrival_at(here, radio).power_w
                : power_w(sent, share, radio, place, distance(sent.origin, place), ring.least_power_w());
        if (received_w >= ring.least_power_w() && received_w < watched_before_w &&
            !is_surely_loud(kind(radio), received_w)) {
            ring.watched().push_back({radio, place, missing_by_bounds(radio, place, received_w)});
        }
    }
}

// Bounds give way to powers, one after the other, until it is known that something is missing.
double Medium::missing_by_bounds(RadioId radio, const Position& place, double received_w) {
    if (outlook_of_[radio] == no_outlook) {
        const ReceiverKind& receiver = kind(radio);
        const double level_w = receiver.energy_detection_w * (1 - margin);
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

double Medium::missing_at(RadioId radio, const Position& place) {
    Outlook& outlook = outlook_of(radio);
    if (outlook.next_id == next_id_ && outlook.rests_until == SimTime::long_ago()) {
        return outlook.missing_w;
    }
    const SimTime now = simulator_.now();
    if (now < outlook.rests_until) {
        return unknown_w;
    }
    outlook.forecast.begin_at(now);
    const std::uint64_t first_id = on_air_.front()->transmission.id;
    for (std::uint64_t id = std::max(outlook.next_id, first_id); id < next_id_; ++id) {
        const OnAir& other = *on_air_[id - first_id];
        if (other.last_end > now) {
            foresee(outlook.forecast, radio, place, other);
        }
    }
    outlook.next_id = next_id_;
    const SimTime rests_until = just_before(outlook.forecast.told_until(kind(radio).energy_detection_w));
    if (now < rests_until && outlook.forecast.untold_count() >= worth_an_event) {
        outlook.rests_until = rests_until;
        look_at(radio, rests_until);
        return unknown_w;
    }
    outlook.rests_until = SimTime::long_ago();
    outlook.missing_w =
        outlook.forecast.settle(kind(radio).energy_detection_w, [&](const EnergyForecast::Coming& coming) {
            OnAir& other = *on_air_[coming.transmission - first_id];
            // The place is not quite that of a radio that moves: only what can be locked on is asked for it.
            tell(radio, other,
                 Arrival{&other.transmission, coming.start, coming.end, coming.power_w, place, false});
        });
    return outlook.missing_w;
}

void Medium::look_at(RadioId radio, SimTime time) {
    const auto look = [this, radio] {
        if (attached_[radio].watches_energy) {
            missing_at(radio, trajectories_[radio]->position_at(simulator_.now()));
        }
    };
    simulator_.schedule_at(time, look, Priority::last);
}

SimTime Medium::watch_energy(RadioId radio, SimTime since) {
    attached_[radio].watches_energy = true;
    passing_.clear();
    if (hearing_ == Hearing::everything || on_air_.empty()) {
        return SimTime::long_ago();
    }
    const SimTime now = simulator_.now();
    const Position place = trajectories_[radio]->position_at(now);
    const ReceiverKind& here = kind(radio);
    const std::size_t audience = audience_of(radio);
    double all_w = 0;
    bool is_in_a_ring = false;
    for (const std::unique_ptr<OnAir>& on_air : on_air_) {
        if (on_air->last_end > since && on_air->shares[audience] > 0) {
            const double received_w = brought_w(*on_air, radio, place);
            passing_.push_back({on_air.get(), {}});
            all_w += received_w;
            is_in_a_ring |= received_w >= on_air->rings[audience].least_power_w();
        }
    }
    if (!is_in_a_ring && missing_beside_w(here, all_w) > 0) {
        return SimTime::long_ago();  // mostly: they are far away
    }
    double arrived_w = 0;
    double present_w = 0;
    SimTime next_start = SimTime::never();
    std::size_t coming = 0;
    std::erase_if(passing_, [&](Passing& passing) {
        const Arrival& arrival = passing.arrival = arrival_at(*passing.on_air, radio, place);
        const bool is_its_own = passing.on_air->transmission.radio == radio;
        if (!is_its_own && arrival.end > now) {
            present_w += arrival.power_w;
            if (arrival.start <= now) {
                arrived_w += arrival.power_w;
            } else {
                next_start = std::min(next_start, arrival.start);
                ++coming;
            }
        }
        return is_its_own || arrival.end <= since;
    });
    double missing_w = missing_beside_w(here, present_w);
    if (missing_w <= 0) {
        if (missing_beside_w(here, arrived_w) > 0 && coming >= worth_an_event) {
            look_at(radio, just_before(next_start));
        } else {
            missing_w = missing_at(radio, place);
        }
    }
    for (const Passing& passing : passing_) {
        EnergyRing& ring = passing.on_air->rings[audience];
        const double received_w = passing.arrival.power_w;
        if (passing.arrival.end > now && received_w >= ring.least_power_w() &&
            !is_surely_loud(here, received_w)) {
            ring.watched().push_back({radio, passing.arrival.place, missing_w});
        }
    }
    return missing_beside_w(here, all_w) > 0 ? SimTime::long_ago() : energy_over_at(radio);
}

// Adds up in the order in which they began.
SimTime Medium::energy_over_at(RadioId radio) {
    const ReceiverKind& here = kind(radio);
    SimTime over = SimTime::long_ago();
    struct Change {
        SimTime time;
        Turn turn = 0;
        const Passing* passing = nullptr;
        Edge edge = Edge::begins;
    };
    std::vector<Change> changes;
    for (const Passing& passing : passing_) {
        const Turn turn = passing.on_air->first_turn + 2 * static_cast<Turn>(radio);
        changes.push_back({passing.arrival.start, turn, &passing, Edge::begins});
        changes.push_back({passing.arrival.end, turn + 1, &passing, Edge::ends});
    }
    std::ranges::sort(changes, [](const Change& a, const Change& b) {
        return a.time != b.time ? a.time < b.time : a.turn < b.turn;
    });
    std::vector<const Passing*> present;
    bool was_loud = false;
    for (const Change& change : changes) {
        if (change.time > simulator_.now()) {
            break;
        }
        if (change.edge == Edge::begins) {
            present.push_back(change.passing);
        } else {
            std::erase(present, change.passing);
        }
        double energy_w = here.noise_w;
        for (const Passing* passing : present) {
            energy_w += passing->arrival.power_w;
        }
        const bool loud = !present.empty() && energy_w >= here.energy_detection_w;
        if (was_loud && !loud) {
            over = change.time;
        }
        was_loud = loud;
    }
    return over;
}

void Medium::foresee(EnergyForecast& forecast, RadioId radio, const Position& place, const OnAir& on_air) {
    const Transmission& sent = on_air.transmission;
    if (sent.radio == radio || share_at(on_air, radio) == 0) {
        return;
    }
    ++energy_looks_;
    const Arrival arrival = arrival_at(on_air, radio, place);
    if (arrival.end <= simulator_.now()) {
        return;
    }
    const EnergyForecast::Coming coming{sent.id, arrival.start, arrival.end, arrival.power_w};
    const bool is_loud_alone = is_loud(kind(radio), arrival.power_w);
    if (arrival.lockable || is_loud_alone) {
        forecast.add_told(coming,
                          arrival.lockable ? arrival.start + kind(radio).detection_time : arrival.start,
                          is_loud_alone);
    } else {
        forecast.add_untold(coming);
    }
}

Medium::Outlook& Medium::outlook_of(RadioId radio) {
    if (outlook_of_[radio] == no_outlook) {
        if (spare_outlooks_.empty()) {
            take_back_outlooks(simulator_.now());
        }
        outlook_of_[radio] = spare_outlooks_.back();
        spare_outlooks_.pop_back();
        Outlook& outlook = outlooks_[outlook_of_[radio]];
        outlook.radio = radio;
        outlook.next_id = 0;
        outlook.rests_until = SimTime::long_ago();
        outlook.forecast.begin(kind(radio).noise_w);
    }
    return outlooks_[outlook_of_[radio]];
}

// Those in which all is over. What they told is no longer on the air, and what they do not know they did not tell.
void Medium::take_back_outlooks(SimTime now) {
    for (std::size_t i = 0; i < outlooks_.size(); ++i) {
        if (outlooks_[i].forecast.is_over(now)) {
            outlook_of_[outlooks_[i].radio] = no_outlook;
            spare_outlooks_.push_back(static_cast<std::uint32_t>(i));
        }
    }
    // More, unless that helps for a while.
    const std::size_t enough = outlooks_.size() / 8 + 1;
    while (spare_outlooks_.size() < enough) {
        spare_outlooks_.push_back(static_cast<std::uint32_t>(outlooks_.size()));
        outlooks_.emplace_back();
    }
}

}  // namespace netsim
