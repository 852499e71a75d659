#include "netsim/medium/other_systems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "netsim/kernel/random.hpp"
#include "netsim/units.hpp"

namespace netsim {

OtherSystems::OtherSystems(const MediumConfig& config, std::uint64_t seed)
    : median_w_(config.other_systems_w),
      standard_deviation_db_(config.other_systems_standard_deviation_db),
      coherence_time_(SimTime::from_seconds(config.other_systems_coherence_time_s)),
      seed_(seed) {}

double OtherSystems::power_w(std::uint32_t radio, SimTime time) const {
    return is_none() ? 0 : power_of_interval_w(radio, interval_at(time));
}

void OtherSystems::add_to(InterferenceSum& sum, std::uint32_t radio, SimTime start, SimTime end) const {
    if (is_none()) {
        return;
    }
    const std::int64_t last = last_interval(start, end);
    for (std::int64_t interval = interval_at(start); interval <= last; ++interval) {
        sum.add_noise(std::max(start, coherence_time_ * interval), power_of_interval_w(radio, interval));
    }
}

double OtherSystems::max_of_intervals_w(std::uint32_t radio, SimTime start, SimTime end) const {
    double max_w = 0;
    const std::int64_t last = last_interval(start, end);
    for (std::int64_t interval = interval_at(start); interval <= last; ++interval) {
        max_w = std::max(max_w, power_of_interval_w(radio, interval));
    }
    return max_w;
}

std::int64_t OtherSystems::last_interval(SimTime start, SimTime end) const {
    return interval_at(std::max(start, end - SimTime::from_ps(1)));
}

// The normal number is that of Box and Muller, as in propagation/link_gaussians.cpp.
double OtherSystems::power_of_interval_w(std::uint32_t radio, std::int64_t interval) const {
    constexpr std::uint64_t uniforms_of_interval = 2;
    RandomStream draws(seed_, radio, Purpose::other_systems,
                       uniforms_of_interval * static_cast<std::uint64_t>(interval));
    const double radius = std::sqrt(-2 * std::log(1 - draws.uniform()));
    const double normal = radius * std::cos(2 * std::numbers::pi * draws.uniform());
    return median_w_ * ratio_from_db(standard_deviation_db_ * normal);
}

}  // namespace netsim
