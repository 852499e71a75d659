#include "netsim/medium/energy_ring.hpp"

namespace netsim {

void EnergyRing::clear() {
    others_ = 0;
    zones_.clear();
    zones_watched_ = 0;
    watched_.clear();
    first_zone_.clear();
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
