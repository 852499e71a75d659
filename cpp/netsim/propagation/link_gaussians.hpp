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
        return mixture(a, b, time, transmission).pair();
    }
    // The same, or nothing if it is sure, at a fraction of the cost, that the pair lies no farther from 0 than the distance beyond
    // which a pair lies with that chance: √(−2 ln chance). Where two pairs are mixed, that is sure of few that lie near it.
    std::optional<GaussianPair> at_if_beyond(double chance, std::uint32_t a, std::uint32_t b, SimTime time,
                                             std::uint64_t transmission) const {
        const Mixture numbers = mixture(a, b, time, transmission);
        return numbers.least_chance_beyond() > chance ? std::nullopt : std::optional(numbers.pair());
    }

private:
    // A pair as it is drawn, in polar coordinates.
    struct Drawn {
        double chance_beyond = 1;  // of lying farther from 0; in (0, 1]
        double turn = 0;           // in [0, 1)

        GaussianPair pair() const;
    };
    // Of the pairs at the borders of an interval.
    struct Mixture {
        Drawn before;
        Drawn after;
        double share = 0;  // of the interval that is over; 0: `before` alone

        // It lies no farther from 0 than √(r² + s²), r and s being the distances of the two (Cauchy and Schwarz).
        double least_chance_beyond() const { return before.chance_beyond * after.chance_beyond; }
        GaussianPair pair() const;
    };

    Mixture mixture(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission) const;
    Drawn draw(std::uint32_t low, std::uint32_t high, std::uint64_t index) const;

    std::uint64_t seed_;
    SimTime coherence_time_;
};

}  // namespace netsim
