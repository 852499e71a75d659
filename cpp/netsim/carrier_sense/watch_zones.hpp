// Watch zones of one transmission: the receivers where it is the strongest on the air, and where
// several transmissions may exceed the ED threshold together although none does alone.
// carrier_sense/README.md explains them with a drawing.
//
// The receivers around a transmission are divided into zones by its received power: at least 4/5 of
// the level, at least 3/5, and so on. The level is the ED threshold minus the noise. In a zone, the
// received power is below the lower bound of the next inner zone, and no other transmission is
// stronger. The distances of the other transmissions bound their power there. If the sum of the
// bounds stays below the level, no receiver in the zone needs a check. All zones up to the outermost
// one where it does not are watched. Each watched receiver has a headroom: how far the power may
// still rise before its channel can become busy. Each new transmission subtracts an upper bound of
// its power there. A receiver is evaluated exactly only when its headroom is used up.
//
// Usually the first zone is enough. One number shows that: a bound for the power of the other
// transmissions at any relevant receiver farther out. The outer zones are computed only when that
// number gets too large.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/interface_id.hpp"

namespace netsim {

class WatchZones {
public:
    struct Watched {
        RadioId radio = 0;
        Position place;         // of the receiver, when the transmission began
        double headroom_w = 0;  // the power may rise by this before its channel can become busy
    };

    // A receiver with at least this power is in the first zone or nearer.
    static double first_zone_w(double level_w) { return level_w * (1 - 1.0 / fifths); }
    // With at most `few` other transmissions, a receiver with less power than this need not be
    // watched: another transmission is stronger there, or all together are too weak.
    static double outer_zone_w(double level_w) { return level_w / (few + 1); }

    // Starts the zones of a new transmission, without others. `level_w` > 0. No receiver with
    // first_zone_w is farther away than `first_reach_m`, and none with outer_zone_w is farther away
    // than `outer_reach_m`. The first zone is watched from now on: the search for receivers of the
    // frame finds its receivers, too.
    void begin(double level_w, double first_reach_m, double outer_reach_m);
    // The same for a level of 0: every receiver is watched once there are other transmissions.
    void begin_without_zones();

    // Adds another transmission. `max_received_w(radius_m)`: its largest received power in W within
    // that radius around this one.
    template <typename Bound>
    void add(const Bound& max_received_w);
    // Resets the sums, so that `count` other transmissions can be added again, zone by zone.
    // `reach_m(power_w)`: no receiver with that power is farther away, in m.
    template <typename Reach>
    void reset_others(std::size_t count, const Reach& reach_m);

    // Whether a receiver that is not watched may have to be.
    bool is_too_narrow() const {
        return has_only_first_zone() ? others_ > few || zones_.front().min_w + outside_w_ >= level_w_
                                     : zones_needed() > zones_watched_;
    }
    // Every receiver with min_power_w() must be watched from now on. Call it after reset_others.
    void widen() { zones_watched_ = zones_needed(); }
    // Smallest power in the watched zones; infinite while no zone is watched.
    double min_power_w() const { return zones_watched_ == 0 ? infinite : zones_[zones_watched_ - 1].min_w; }
    // Upper bound in m for the distance of watched receivers from the transmission's origin.
    double radius_m() const { return zones_watched_ == 0 ? 0 : zones_[zones_watched_ - 1].reach_m; }
    std::vector<Watched>& watched() { return watched_; }

private:
    struct Zone {
        double min_w = 0;  // of this transmission
        double reach_m = 0;
        double others_w = 0;  // bound for the sum of the other transmissions there
    };
    static constexpr std::size_t fifths = 5;
    static constexpr std::size_t few = 4;
    static constexpr double infinite = std::numeric_limits<double>::infinity();

    bool has_only_first_zone() const { return zones_.size() == 1 && level_w_ > 0; }
    std::size_t zones_needed() const;

    double level_w_ = 0;
    std::size_t others_ = 0;
    double outer_reach_m_ = 0;
    double outside_w_ = 0;     // bound for the others within that reach, while there is only the first zone
    std::vector<Zone> zones_;  // from the innermost outward
    std::size_t zones_watched_ = 0;
    std::vector<Watched> watched_;
};

template <typename Bound>
void WatchZones::add(const Bound& max_received_w) {
    ++others_;
    if (has_only_first_zone()) {
        outside_w_ += max_received_w(outer_reach_m_);
        return;
    }
    // If it may be the stronger one in a zone, it may be so in all outer zones: its bound grows
    // outward, and the power of this transmission falls.
    bool is_strongest = false;
    for (std::size_t i = std::max<std::size_t>(zones_watched_, 1); i < zones_.size(); ++i) {
        const double max_w = is_strongest ? infinite : max_received_w(zones_[i].reach_m);
        is_strongest = max_w >= zones_[i - 1].min_w;
        zones_[i].others_w += std::min(zones_[i - 1].min_w, max_w);
    }
}

template <typename Reach>
void WatchZones::reset_others(std::size_t count, const Reach& reach_m) {
    others_ = 0;
    for (Zone& zone : zones_) {
        zone.others_w = 0;
    }
    if (level_w_ <= 0) {
        zones_.assign(1, Zone{0, infinite, 0});
        return;
    }
    // If k powers reach the level together, the largest reaches 1/k of it. The zones suffice for
    // twice as many transmissions.
    const double enough_w = level_w_ / static_cast<double>(2 * count + 4);
    while (zones_.back().min_w >= enough_w) {
        const std::size_t fifths_less = zones_.size() + 1;
        const double min_w = fifths_less < fifths
                                 ? level_w_ * static_cast<double>(fifths - fifths_less) / fifths
                                 : zones_.back().min_w / 2;
        zones_.push_back(Zone{min_w, reach_m(min_w), 0});
    }
}

}  // namespace netsim
