// Gaussian numbers of a link, as a function of the run's seed, the pair of its ends and the time.
//
// Nothing is stored for a link and nothing is drawn in an order: who asks again, or asks later, or asks from the other
// end, gets the same numbers. They are what fading and shadowing are made of.
//
// The time is cut into intervals of one coherence time. Each border has a pair of independent standard normal numbers
// of its own, keyed by its index. In between, a share f of the interval after border i, they are
// cos(π f / 2) of the pair of i and sin(π f / 2) of that of i + 1: the squares of the weights add up to 1, so the
// numbers are standard normal at any time, continuous in time, and independent from two coherence times on. Averaged
// over f, their correlation over a lag of u coherence times is
//   (1 − u/2) cos(π u / 2) + sin(π u / 2) / π            for u ≤ 1: 1 at u = 0, 0.755 at 1/2, 0.318 at 1,
//   sin(π (u − 1) / 2) (u/2 − 1) + cos(π (u − 1) / 2) / π for 1 ≤ u ≤ 2, and 0 beyond.
#pragma once

#include <cstdint>
#include <optional>

#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Two independent standard normal numbers.
struct GaussianPair {
    double first = 0;
    double second = 0;
};

class LinkGaussians {
public:
    // `coherence_time` 0: new numbers for each transmission, whatever the time. Otherwise at least a microsecond.
    LinkGaussians(std::uint64_t seed, SimTime coherence_time)
        : seed_(seed), coherence_time_(coherence_time) {}

    // The same for (a, b) as for (b, a). `transmission` below 2^48.
    GaussianPair at(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission) const {
        constexpr double always = 1;
        return *at_if_beyond(always, a, b, time, transmission);
    }
    // The same, or nothing if it is sure, at a fraction of the cost, that the pair lies no farther from 0 than the distance beyond
    // which a pair lies with that chance: √(−2 ln chance). Where two pairs are mixed, that is sure of few that lie near it.
    std::optional<GaussianPair> at_if_beyond(double chance, std::uint32_t a, std::uint32_t b, SimTime time,
                                             std::uint64_t transmission) const;

private:
    // A pair as it is drawn, in polar coordinates.
    struct Drawn {
        double chance_beyond;  // of lying farther from 0; in (0, 1]
        double turn;           // in [0, 1)

        GaussianPair pair() const;
    };

    Drawn draw(std::uint32_t low, std::uint32_t high, std::uint64_t index) const;

    std::uint64_t seed_;
    SimTime coherence_time_;
};

}  // namespace netsim
