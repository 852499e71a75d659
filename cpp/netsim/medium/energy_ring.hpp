// Who may find the channel busy because of one transmission and others together, it being the strongest of them there,
// though none does it alone.
//
// The receivers around the transmission are told apart in zones by the power that it brings them: at least nine tenths
// of the level that is noticed, at least eight tenths, and so on. In a zone it brings less than the zone before begins
// with, and none of the others brings more than it does; what else they can bring follows from how far away they are.
// As long as the sum stays below the level, nobody in the zone needs to be looked at. The zones up to the outermost one
// of which that is not true are the ring. Its receivers are watched, each with what is missing until its channel is
// busy: a new transmission takes off what it can bring there at most, and only who then misses nothing is looked at.
// So it costs a subtraction for each of those whom the ones on the air have in their rings, and exact sums for few.
//
// Kept by the medium for each transmission that has others beside it (medium_energy.cpp), which knows the powers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/medium/interface_id.hpp"

namespace netsim {

class EnergyRing {
public:
    struct Watched {
        RadioId radio = 0;
        Position place;  // when the transmission began
        double missing_w =
            0;  // more than that must come before its channel can become busy where it is not yet
    };

    // Who gets so much that it is in the first zone or further in, and does not notice that alone.
    struct Near {
        RadioId radio = 0;
        Position place;
        double received_w = 0;
    };

    void clear();

    // Those of the first zone are found while the transmission looks for receivers anyway: mostly no others are to be watched.
    static double first_zone_w(double level_w) { return level_w * tenths / (tenths + 1); }
    std::vector<Near>& first_zone() { return first_zone_; }
    bool is_first_zone_enough() const { return zones_watched_ == 1 && level_w_ > 0; }

    // Begins to add up the others anew, of which there are `count`. `level_w` is the least energy that is noticed; if
    // that is none, everybody is watched. `reach_m(power_w)`: who gets that power is not farther away, in m.
    template <typename Reach>
    void forget_others(std::size_t count, double level_w, const Reach& reach_m);
    // One of the others. `brought_w(radius_m)` is the most that it brings within that radius.
    template <typename Bound>
    void add(const Bound& brought_w);

    // Whether it is possible that somebody is not watched who ought to be.
    bool is_too_narrow() const { return zones_needed() > zones_watched_; }
    // Who gets `least_power_w()` has to be watched from now on.
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
    static constexpr std::size_t tenths = 9;
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    std::size_t zones_needed() const;

    double level_w_ = 0;
    std::size_t others_ = 0;
    std::vector<Zone> zones_;  // outwards
    std::size_t zones_watched_ = 0;
    std::vector<Watched> watched_;
    std::vector<Near> first_zone_;
};

template <typename Reach>
void EnergyRing::forget_others(std::size_t count, double level_w, const Reach& reach_m) {
    level_w_ = level_w;
    others_ = 0;
    for (Zone& zone : zones_) {
        zone.others_w = 0;
    }
    if (level_w <= 0) {
        zones_.assign(1, Zone{0, infinite, 0});
        return;
    }
    // Of k powers that reach the level together, the largest reaches a k-th of it. Twice as many may come.
    const double enough_w = level_w / static_cast<double>(2 * count + 4);
    while (zones_.empty() || zones_.back().least_w >= enough_w) {
        const double least_w = zones_.size() < tenths
                                   ? level_w * static_cast<double>(tenths - zones_.size()) / (tenths + 1)
                                   : zones_.back().least_w / 2;
        zones_.push_back(Zone{least_w, reach_m(least_w), 0});
    }
}

template <typename Bound>
void EnergyRing::add(const Bound& brought_w) {
    ++others_;
    // Then in the zones farther out, too: there it may bring more, and the transmission less.
    bool is_strongest = false;
    for (std::size_t i = std::max<std::size_t>(zones_watched_, 1); i < zones_.size(); ++i) {
        const double most_w = is_strongest ? infinite : brought_w(zones_[i].reach_m);
        is_strongest = most_w >= zones_[i - 1].least_w;
        zones_[i].others_w += std::min(zones_[i - 1].least_w, most_w);
    }
}

}  // namespace netsim
