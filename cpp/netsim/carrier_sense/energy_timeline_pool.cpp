#include "netsim/carrier_sense/energy_timeline_pool.hpp"

namespace netsim {

void EnergyTimelinePool::begin(RadioId radio, double noise_w, SimTime now) {
    if (spare_.empty()) {
        reclaim(now);
    }
    index_of_[radio] = spare_.back();
    spare_.pop_back();
    ReceiverTimeline& receiver = timelines_[index_of_[radio]];
    receiver.radio = radio;
    receiver.next_id = 0;
    receiver.deferred_until = SimTime::long_ago();
    receiver.timeline.begin(noise_w);
}

// Reclaims timelines whose arrivals have all ended.
void EnergyTimelinePool::reclaim(SimTime now) {
    for (std::size_t i = 0; i < timelines_.size(); ++i) {
        if (timelines_[i].timeline.is_over(now)) {
            index_of_[timelines_[i].radio] = none;
            spare_.push_back(static_cast<std::uint32_t>(i));
        }
    }
    // Allocate more if that freed too few.
    const std::size_t enough = timelines_.size() / 8 + 1;
    while (spare_.size() < enough) {
        spare_.push_back(static_cast<std::uint32_t>(timelines_.size()));
        timelines_.emplace_back();
    }
}

}  // namespace netsim
