// The wind at one vehicle: constant, and gusts of its own. The same as gradysim.motion.wind.
#pragma once

#include <cstdint>
#include <optional>

#include "netsim/config/wind_config.hpp"
#include "netsim/geometry/position.hpp"
#include "netsim/mobility/gauss_markov.hpp"

namespace netsim {

class Wind {
public:
    Wind(const WindConfig& config, std::uint64_t seed, std::uint32_t node);

    // The velocity of the air North, East and down, at times that do not decrease.
    Position velocity_mps(double time_s);

private:
    Position constant_mps_;
    std::optional<GaussMarkov> gusts_;
};

}  // namespace netsim
