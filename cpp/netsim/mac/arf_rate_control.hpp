// ARF and AARF: one step faster after consecutive successes, one step slower after consecutive
// failures.
//
// The first attempt at a faster rate is a probe: if it fails, the rate falls at once. AARF then also
// requires more successes before the next probe. So a station at its best rate makes few futile
// probes. A decrease after consecutive failures means that the channel got worse, and resets that
// number. A faster rate is also tried when `interval` has passed since the last change, so that a
// station with few frames recovers, too.
//
// The rates are those of the operation mode by bitrate. In g(mixed), OFDM and CCK rates alternate,
// and a faster one may be more robust than a slower one.
//
// Sources: A. Kamerman, L. Monteban, "WaveLAN-II: a high-performance wireless LAN for the
// unlicensed band", 1997 (ARF); M. Lacage, M. H. Manshaei, T. Turletti, "IEEE 802.11 rate
// adaptation: a practical approach", 2004 (AARF). Parameters are INET's. The rules are those of the
// papers, which INET 4.5 does not follow completely: docs/decisions/0017.
#pragma once

#include <cstddef>
#include <unordered_map>

#include "netsim/mac/rate_control.hpp"

namespace netsim {

class ArfRateControl final : public RateControl {
public:
    struct Parameters {
        SimTime interval;
        int increase_threshold;  // successes
        int decrease_threshold;  // failures
        // For AARF. The defaults have no effect.
        double increase_threshold_factor = 1;
        int max_increase_threshold = 1;
    };

    ArfRateControl(const ModeSet& modes, const Mode& initial, const Parameters& parameters)
        : modes_(modes), initial_(initial), parameters_(parameters) {}

    const Mode& mode_for(const RateAttempt& attempt, SimTime now) override;
    void succeeded(const RateAttempt& attempt, const Mode& mode, SimTime now) override;
    void failed(const RateAttempt& attempt, const Mode& mode, SimTime now) override;

private:
    struct Link {
        std::size_t mode = 0;
        SimTime changed;  // last change, or attempt to change beyond the fastest or slowest mode
        int increase_threshold = 1;
        int successes = 0;  // in a row
        int failures = 0;   // in a row
        bool probing = false;
    };

    Link& link_to(NodeId destination, SimTime now);
    void increase(Link& link, SimTime now) const;
    void decrease(Link& link, SimTime now) const;

    const ModeSet& modes_;
    const Mode& initial_;
    Parameters parameters_;
    std::unordered_map<NodeId, Link> links_;
};

}  // namespace netsim
