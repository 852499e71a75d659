// ARF and AARF: one step faster after successes in a row, one step slower after failures in a row.
//
// The first attempt at a faster rate is a probe: if it fails, the rate falls at once. AARF then also asks for more
// successes before the next probe, which spares a station whose best rate is found already most of the probes in
// vain; a fall after failures in a row, of a channel that got worse, sets that number back. A faster rate is also
// tried if `interval` passed since the last change, so that a station with little to send recovers, too.
//
// The rates are those of the operation mode by bitrate: in g(mixed) ones of OFDM and of CCK alternate, and a faster
// one may be more robust than a slower one.
//
// Sources: A. Kamerman, L. Monteban, "WaveLAN-II: a high-performance wireless LAN for the unlicensed band", 1997 (ARF);
// M. Lacage, M. H. Manshaei, T. Turletti, "IEEE 802.11 rate adaptation: a practical approach", 2004 (AARF).
// Parameters are INET's; the rules are those of the papers, not all of which INET 4.5 keeps: docs/decisions/0017.
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
        // AARF; those of ARF have no effect.
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
        SimTime changed;  // also at a fall from the slowest mode, which has no effect but this
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
