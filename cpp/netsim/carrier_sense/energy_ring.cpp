#include "netsim/carrier_sense/energy_ring.hpp"

namespace netsim {

void EnergyRing::begin(double level_w, double first_reach_m, double outer_reach_m) {
    level_w_ = level_w;
    others_ = 0;
    outer_reach_m_ = outer_reach_m;
    outside_w_ = 0;
    zones_.assign(1, Zone{first_zone_w(level_w), first_reach_m, 0});
    zones_watched_ = 1;
    watched_.clear();
}

void EnergyRing::begin_without_zones() {
    level_w_ = 0;
    others_ = 0;
    zones_.clear();
    zones_watched_ = 0;
    watched_.clear();
}

std::size_t EnergyRing::zones_needed() const {
    if (zones_.empty() || level_w_ <= 0) {
        return 1;
    }
    if (zones_.back().least_w * static_cast<double>(others_ + 1) >= level_w_) {
        return zones_.size() + 1;  // it takes more zones to know
    }
    // The first zone is always watched, and what is watched stays so.
    const std::size_t least = std::max<std::size_t>(zones_watched_, 1);
    std::size_t needed = zones_.size();
    while (needed > least && zones_[needed - 2].least_w + zones_[needed - 1].others_w < level_w_) {
        --needed;
    }
    return needed;
}

}  // namespace netsim
