#include "netsim/carrier_sense/energy_outlooks.hpp"

namespace netsim {

void EnergyOutlooks::begin(RadioId radio, double noise_w, SimTime now) {
    if (spare_.empty()) {
        take_back(now);
    }
    index_of_[radio] = spare_.back();
    spare_.pop_back();
    EnergyOutlook& outlook = outlooks_[index_of_[radio]];
    outlook.radio = radio;
    outlook.next_id = 0;
    outlook.rests_until = SimTime::long_ago();
    outlook.forecast.begin(noise_w);
}

// Those in which all is over. What they told is no longer on the air, and what they do not know they did not tell.
void EnergyOutlooks::take_back(SimTime now) {
    for (std::size_t i = 0; i < outlooks_.size(); ++i) {
        if (outlooks_[i].forecast.is_over(now)) {
            index_of_[outlooks_[i].radio] = none;
            spare_.push_back(static_cast<std::uint32_t>(i));
        }
    }
    // More, unless that helps for a while.
    const std::size_t enough = outlooks_.size() / 8 + 1;
    while (spare_.size() < enough) {
        spare_.push_back(static_cast<std::uint32_t>(outlooks_.size()));
        outlooks_.emplace_back();
    }
}

}  // namespace netsim
