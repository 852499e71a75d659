// Minstrel: measures the success ratio at each rate, and uses the rates with the highest throughput.
//
// Every `update_interval`, the success ratios since the last update enter the means (a rate without
// attempts keeps its mean), and the rates are ranked again by
//
//   throughput = mean success ratio / duration of an attempt, including waiting and ACK
//
// The attempts of a frame follow a chain of stages until the MAC drops the frame. A stage has as
// many attempts as fit into 6 ms, or two if the rate nearly always or hardly ever succeeds:
//
//   best throughput --> second best --> most likely to succeed --> slowest
//
// A random fraction `look_around` of the frames tries another random rate. A faster rate is tried at
// the first attempt. A slower one replaces the second stage, where it costs nothing unless the best
// rate fails.
//
// Sources: the description of Minstrel in the documentation of Linux' mac80211; D. Xia, J. Hart, Q.
// Fu, "Evaluation of the Minstrel rate adaptation algorithm in IEEE 802.11g WLANs", ICC 2013. Two
// differences: the MAC's retry limit usually cuts the chain, and durations are those of the current
// frame (Minstrel: of a frame of 1200 B).
#pragma once

#include <cstddef>
#include <unordered_map>
#include <utility>
#include <vector>

#include "netsim/kernel/random.hpp"
#include "netsim/mac/rate_control.hpp"
#include "netsim/mac/response_modes.hpp"
#include "netsim/mac/timing.hpp"

namespace netsim {

class MinstrelRateControl final : public RateControl {
public:
    struct Parameters {
        SimTime update_interval;
        double look_around;  // fraction of frames, 0 to 1
        double ewma_weight;  // weight of the past in the mean, 0 to 1
    };

    MinstrelRateControl(const ModeSet& modes, ResponseModes responses, const Mode& initial,
                        const Parameters& parameters, RandomStream draws)
        : modes_(modes),
          responses_(std::move(responses)),
          timing_(modes),
          initial_(initial),
          parameters_(parameters),
          draws_(draws) {}

    const Mode& mode_for(const RateAttempt& attempt, SimTime now) override;
    void succeeded(const RateAttempt& attempt, const Mode& mode, SimTime now) override;
    void failed(const RateAttempt& attempt, const Mode& mode, SimTime now) override;

private:
    struct Statistics {
        int attempts = 0;  // since the last update
        int successes = 0;
        bool known = false;  // whether there was an attempt before the last update
        double mean = 0;     // of the success ratio
    };
    // Indices of modes.
    struct Chain {
        std::size_t best = 0;
        std::size_t second = 0;
        std::size_t likeliest = 0;
    };
    struct Link {
        std::vector<Statistics> modes;
        Chain chain;
        std::size_t tried = 0;  // rate to try with the current frame; the best rate if none
        SimTime updated;
    };

    Link& link_to(NodeId destination, SimTime now);
    void update(Link& link, int psdu_bytes, SimTime now) const;
    std::size_t draw_tried(const Link& link);
    std::size_t choose(const Link& link, const RateAttempt& attempt) const;
    int attempts_in_a_row(const Link& link, std::size_t mode, int psdu_bytes) const;
    void count(const RateAttempt& attempt, const Mode& mode, bool success, SimTime now);

    const ModeSet& modes_;
    ResponseModes responses_;
    MacTiming timing_;
    const Mode& initial_;
    Parameters parameters_;
    RandomStream draws_;
    std::unordered_map<NodeId, Link> links_;
};

}  // namespace netsim
