#include "netsim/carrier_sense/watch_zones.hpp"

namespace netsim {

void WatchZones::begin(double level_w, double first_reach_m, double outer_reach_m) {
    level_w_ = level_w;
    others_ = 0;
    outer_reach_m_ = outer_reach_m;
    outside_w_ = 0;
    zones_.assign(1, Zone{first_zone_w(level_w), first_reach_m, 0});
    zones_watched_ = 1;
    watched_.clear();
}

void WatchZones::begin_without_zones() {
    level_w_ = 0;
    others_ = 0;
    zones_.clear();
    zones_watched_ = 0;
    watched_.clear();
}

std::size_t WatchZones::zones_needed() const {
    if (zones_.empty() || level_w_ <= 0) {
        return 1;
    }
    if (zones_.back().min_w * static_cast<double>(others_ + 1) >= level_w_) {
        return zones_.size() + 1;  // not known: there are too few zones
    }
    // The first zone is always watched, and a watched zone stays watched.
    const std::size_t min_needed = std::max<std::size_t>(zones_watched_, 1);
    std::size_t needed = zones_.size();
    while (needed > min_needed && zones_[needed - 2].min_w + zones_[needed - 1].others_w < level_w_) {
        --needed;
    }
    return needed;
}

}  // namespace netsim
