// Minstrel: measures the share of successes at each rate, and uses the rates with the most throughput.
//
// Every `update_interval` the shares of the attempts since the last one are averaged in (a rate without attempts keeps
// its mean), and the rates are ranked anew by
//
//   throughput = mean share of successes / time that an attempt takes, waiting and ACK included
//
// The attempts of a frame go down a chain of stages, each of as many attempts as fit into 6 ms, or two if the rate succeeds nearly
// always or hardly ever, until the MAC gives the frame up:
//
//   best throughput --> second best --> most likely to succeed --> slowest
//
// and some frames, `look_around`, drawn at random, try another rate, drawn at random too: a faster one at their first
// attempt, a slower one in place of the second stage, where it costs nothing unless the best one fails.
//
// Sources: the description of Minstrel in the documentation of Linux' mac80211; D. Xia, J. Hart, Q. Fu, "Evaluation of the
// Minstrel rate adaptation algorithm in IEEE 802.11g WLANs", ICC 2013. Ours: the MAC's
// retry limit, which mostly cuts the chain, and times are those of the frame sent last (Minstrel: of 1200 B).
#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "netsim/kernel/random.hpp"
#include "netsim/mac/rate_control.hpp"
#include "netsim/mac/timing.hpp"

namespace netsim {

class MinstrelRateControl final : public RateControl {
public:
    struct Parameters {
        SimTime update_interval;
        double look_around;  // share of frames
        double ewma_weight;  // of the past in the mean
    };

    MinstrelRateControl(const ModeSet& modes, const Mode& initial, const Parameters& parameters,
                        RandomStream draws)
        : modes_(modes), timing_(modes), initial_(initial), parameters_(parameters), draws_(draws) {}

    const Mode& mode_for(const RateAttempt& attempt, SimTime now) override;
    void succeeded(const RateAttempt& attempt, const Mode& mode, SimTime now) override;
    void failed(const RateAttempt& attempt, const Mode& mode, SimTime now) override;

private:
    struct Statistics {
        int attempts = 0;  // since the last update
        int successes = 0;
        bool known = false;  // any attempt before that
        double mean = 0;     // share of successes
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
        std::size_t tried = 0;  // by the frame in progress; the best one: none
        SimTime updated;
    };

    Link& link_to(NodeId destination, SimTime now);
    void update(Link& link, int psdu_bytes, SimTime now) const;
    std::size_t draw_tried(const Link& link);
    std::size_t choose(const Link& link, const RateAttempt& attempt) const;
    int attempts_in_a_row(const Link& link, std::size_t mode, int psdu_bytes) const;
    void count(const RateAttempt& attempt, const Mode& mode, bool success, SimTime now);

    const ModeSet& modes_;
    MacTiming timing_;
    const Mode& initial_;
    Parameters parameters_;
    RandomStream draws_;
    std::unordered_map<NodeId, Link> links_;
};

}  // namespace netsim
