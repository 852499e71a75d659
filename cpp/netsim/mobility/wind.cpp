#include "netsim/mobility/wind.hpp"

#include <cmath>

namespace netsim {

Wind::Wind(const WindConfig& config, std::uint64_t seed, std::uint32_t node)
    : constant_mps_{config.speed_mps * std::cos(config.heading_rad),
                    config.speed_mps * std::sin(config.heading_rad), 0} {
    constexpr double interval_s = 0.1;
    if (config.gusts_mps > 0) {
        gusts_.emplace(RandomStream(seed, node, Purpose::gusts),
                       Position{config.gusts_mps, config.gusts_mps, config.gusts_mps}, config.gust_time_s,
                       interval_s);
    }
}

Position Wind::velocity_mps(double time_s) {
    return gusts_ ? constant_mps_ + gusts_->at(time_s) : constant_mps_;
}

}  // namespace netsim
