// For one transmission: the receivers where it is the strongest of those on the air, and where they may make the channel
// busy together, though none does so alone.
//
// The receivers around the transmission are told apart in zones by the power that it brings them: at least four fifths
// of the level that is noticed, at least three fifths, and so on. In a zone it brings less than the zone before begins
// with, and none of the others brings more than it does; what else they can bring follows from how far away they are.
// As long as the sum stays below the level, nobody in the zone needs to be looked at. The zones up to the outermost one
// of which that is not true are the ring. Its receivers are watched, each with what is missing until its channel is
// busy: a new transmission takes off what it can bring there at most, and only who then misses nothing is looked at.
// So it costs a subtraction for each of those whom the ones on the air have in their rings, and exact sums for few.
//
// Mostly the ring is the first zone and one number tells that it is enough: what the others can bring to anybody farther
// out who matters. The zones beyond are told apart only once that is not so.
//
// Kept for each transmission that has others beside it by the watch over energy (energy_watch.hpp), which knows the powers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/interface_id.hpp"

namespace netsim {

class EnergyRing {
public:
    struct Watched {
        RadioId radio = 0;
        Position place;  // when the transmission began
        double missing_w =
            0;  // more than that must come before its channel can become busy where it is not yet
    };

    // Who gets so much that it is in the first zone or further in.
    static double first_zone_w(double level_w) { return level_w * (1 - 1.0 / fifths); }
    // With at most `few` others on the air, a receiver that gets less than this need not be watched for this transmission: one of
    // the others is stronger there, or all together are too weak.
    static double outer_w(double level_w) { return level_w / (few + 1); }

    // A new transmission without others. `level_w` is the least energy that is noticed, more than 0. `first_reach_m`: who gets
    // first_zone_w is not farther away, in m; so outer_reach_m for outer_w. Those of the first zone are watched from now on:
    // they are found while the transmission looks for receivers anyway.
    void begin(double level_w, double first_reach_m, double outer_reach_m);
    // The same, if any energy is noticed: everybody is to be watched beside others.
    void begin_without_zones();

    // One of the others. `brought_w(radius_m)` is the most that it brings within that radius.
    template <typename Bound>
    void add(const Bound& brought_w);
    // Begins to add up the others anew, of which there are `count`, and from now on zone by zone. `reach_m(power_w)`: who
    // gets that power is not farther away, in m.
    template <typename Reach>
    void forget_others(std::size_t count, const Reach& reach_m);

    // Whether it is possible that somebody is not watched who ought to be.
    bool is_too_narrow() const {
        return has_only_first_zone() ? others_ > few || zones_.front().least_w + outside_w_ >= level_w_
                                     : zones_needed() > zones_watched_;
    }
    // Who gets `least_power_w()` has to be watched from now on. After forget_others.
    void widen() { zones_watched_ = zones_needed(); }
    // Infinite as long as nobody is to be watched.
    double least_power_w() const {
        return zones_watched_ == 0 ? infinite : zones_[zones_watched_ - 1].least_w;
    }
    // In m; who is watched is not farther away from where the transmission began.
    double radius_m() const { return zones_watched_ == 0 ? 0 : zones_[zones_watched_ - 1].reach_m; }
    std::vector<Watched>& watched() { return watched_; }

private:
    struct Zone {
        double least_w = 0;
        double reach_m = 0;
        double others_w = 0;  // what the others bring there, at most
    };
    static constexpr std::size_t fifths = 5;
    static constexpr std::size_t few = 4;
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    bool has_only_first_zone() const { return zones_.size() == 1 && level_w_ > 0; }
    std::size_t zones_needed() const;

    double level_w_ = 0;
    std::size_t others_ = 0;
    double outer_reach_m_ = 0;
    double outside_w_ =
        0;  // what the others bring within that, at most; as long as there is only the first zone
    std::vector<Zone> zones_;  // outwards
    std::size_t zones_watched_ = 0;
    std::vector<Watched> watched_;
};

template <typename Bound>
void EnergyRing::add(const Bound& brought_w) {
    ++others_;
    if (has_only_first_zone()) {
        outside_w_ += brought_w(outer_reach_m_);
        return;
    }
    // Then in the zones farther out, too: there it may bring more, and the transmission less.
    bool is_strongest = false;
    for (std::size_t i = std::max<std::size_t>(zones_watched_, 1); i < zones_.size(); ++i) {
        const double most_w = is_strongest ? infinite : brought_w(zones_[i].reach_m);
        is_strongest = most_w >= zones_[i - 1].least_w;
        zones_[i].others_w += std::min(zones_[i - 1].least_w, most_w);
    }
}

template <typename Reach>
void EnergyRing::forget_others(std::size_t count, const Reach& reach_m) {
    others_ = 0;
    for (Zone& zone : zones_) {
        zone.others_w = 0;
    }
    if (level_w_ <= 0) {
        zones_.assign(1, Zone{0, infinite, 0});
        return;
    }
    // Of k powers that reach the level together, the largest reaches a k-th of it. Twice as many may come.
    const double enough_w = level_w_ / static_cast<double>(2 * count + 4);
    while (zones_.back().least_w >= enough_w) {
        const std::size_t fifths_less = zones_.size() + 1;
        const double least_w = fifths_less < fifths
                                   ? level_w_ * static_cast<double>(fifths - fifths_less) / fifths
                                   : zones_.back().least_w / 2;
        zones_.push_back(Zone{least_w, reach_m(least_w), 0});
    }
}

}  // namespace netsim
