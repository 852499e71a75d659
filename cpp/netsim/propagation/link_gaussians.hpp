// Gaussian numbers of a link, as a function of the run's seed, the purpose, the pair of its ends
// and the time. Fading and shadowing use them.
//
// Nothing is stored per link, and the order of calls does not matter: calls for the same link and
// time give the same numbers, from either end.
//
// Time is divided into intervals of one coherence time. Each border has its own pair of independent
// standard normal numbers, keyed by its index. At a share f of the interval after border i, the
// numbers are cos(π f / 2) times the pair of i plus sin(π f / 2) times the pair of i + 1. The
// squares of the weights add up to 1. So the numbers are standard normal at any time, continuous in
// time, and independent from two coherence times on. Averaged over f, their correlation over a lag
// of u coherence times is
//   (1 − u/2) cos(π u / 2) + sin(π u / 2) / π            for u ≤ 1: 1 at u = 0, 0.755 at 1/2, 0.318 at 1,
//   sin(π (u − 1) / 2) (u/2 − 1) + cos(π (u − 1) / 2) / π for 1 ≤ u ≤ 2, and 0 beyond.
#pragma once

#include <cstdint>
#include <optional>

#include "netsim/kernel/random.hpp"
#include "netsim/kernel/sim_time.hpp"

namespace netsim {

// Two independent standard normal numbers.
struct GaussianPair {
    double first = 0;
    double second = 0;
};

class LinkGaussians {
public:
    // `coherence_time` 0: new numbers for each transmission, whatever the time. Otherwise at least
    // a microsecond.
    LinkGaussians(std::uint64_t seed, Purpose purpose, SimTime coherence_time)
        : seed_(seed), purpose_(purpose), coherence_time_(coherence_time) {}

    // The same for (a, b) as for (b, a). `transmission` below 2^48.
    GaussianPair at(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission) const {
        return mixture(a, b, time, transmission).pair();
    }
    // The same, or nothing if the pair is certainly not farther from 0 than √(−2 ln chance), the
    // distance that a pair exceeds with probability `chance`. Then it costs a fraction. Between two
    // borders, the test misses pairs near that distance.
    std::optional<GaussianPair> at_if_beyond(double chance, std::uint32_t a, std::uint32_t b, SimTime time,
                                             std::uint64_t transmission) const {
        const Mixture numbers = mixture(a, b, time, transmission);
        return numbers.min_chance_beyond() > chance ? std::nullopt : std::optional(numbers.pair());
    }

private:
    // A drawn pair, in polar coordinates.
    struct Drawn {
        double chance_beyond = 1;  // probability of a larger distance from 0; in (0, 1]
        double turn = 0;           // angle as a share of a turn; in [0, 1)

        GaussianPair pair() const;
    };
    // A weighted sum of the pairs at the borders of an interval.
    struct Mixture {
        Drawn before;
        Drawn after;
        double share = 0;  // elapsed share of the interval; 0: `before` alone

        // Its distance from 0 is at most √(r² + s²), with r and s those of the two pairs
        // (Cauchy-Schwarz).
        double min_chance_beyond() const { return before.chance_beyond * after.chance_beyond; }
        GaussianPair pair() const;
    };

    Mixture mixture(std::uint32_t a, std::uint32_t b, SimTime time, std::uint64_t transmission) const;
    Drawn draw(std::uint32_t low, std::uint32_t high, std::uint64_t index) const;

    std::uint64_t seed_;
    Purpose purpose_;
    SimTime coherence_time_;
};

}  // namespace netsim
