#include "netsim/mac/minstrel_rate_control.hpp"

#include <algorithm>
#include <span>

namespace netsim {

namespace {

// Rates with at least this success ratio count as equally likely to succeed. The one with the largest
// throughput is used.
constexpr double likely_enough = 0.95;

// Rates with a success ratio above likely_enough or below unlikely_enough get two attempts in a row.
constexpr double unlikely_enough = 0.1;
constexpr int fewest_in_a_row = 2;

// The maximum duration of all attempts of a stage together.
constexpr double longest_stage_s = 6e-3;

// Seconds per attempt on a free channel: DIFS, mean backoff with contention window `cw`, frame, SIFS,
// ACK.
double attempt_s(const ResponseModes& responses, const MacTiming& timing, const Mode& mode, int psdu_bytes,
                 int cw) {
    const SimTime fixed = timing.difs + timing.sifs + responses.to(mode).duration(ack_bytes);
    return (fixed + mode.duration(psdu_bytes)).seconds() + cw * timing.slot.seconds() / 2;
}

// The contention window doubles with each attempt.
int attempts_in_a_stage(const ModeSet& modes, const ResponseModes& responses, const MacTiming& timing,
                        const Mode& mode, int psdu_bytes) {
    int attempts = 0;
    int cw = modes.cw_min();
    double taken_s = attempt_s(responses, timing, mode, psdu_bytes, cw);
    while (taken_s <= longest_stage_s) {
        ++attempts;
        cw = std::min(2 * cw + 1, modes.cw_max());
        taken_s += attempt_s(responses, timing, mode, psdu_bytes, cw);
    }
    return std::max(attempts, fewest_in_a_row);
}

}  // namespace

MinstrelRateControl::Link& MinstrelRateControl::link_to(NodeId destination, SimTime now) {
    const auto [place, is_new] = links_.try_emplace(destination);
    Link& link = place->second;
    if (is_new) {
        const std::size_t initial = modes_.index_of(initial_);
        link.modes.resize(modes_.modes().size());
        link.chain = {initial, initial, initial};
        link.tried = initial;
        link.updated = now;
    }
    return link;
}

const Mode& MinstrelRateControl::mode_for(const RateAttempt& attempt, SimTime now) {
    Link& link = link_to(attempt.destination, now);
    if (now - link.updated >= parameters_.update_interval) {
        update(link, attempt.psdu_bytes, now);
    }
    if (attempt.number == 0) {
        link.tried = draw_tried(link);
    }
    return modes_.modes()[choose(link, attempt)];
}

std::size_t MinstrelRateControl::draw_tried(const Link& link) {
    const std::size_t others = link.modes.size() - 1;
    if (others == 0 || draws_.uniform() >= parameters_.look_around) {
        return link.chain.best;
    }
    const std::size_t drawn = draws_.uniform_int(static_cast<std::uint32_t>(others));
    return drawn < link.chain.best ? drawn : drawn + 1;
}

std::size_t MinstrelRateControl::choose(const Link& link, const RateAttempt& attempt) const {
    const Chain& chain = link.chain;
    if (attempt.number == 0) {
        return std::max(link.tried, chain.best);
    }
    const std::size_t second = link.tried < chain.best ? link.tried : chain.second;
    int before = attempt.number;
    for (const std::size_t mode : {chain.best, second, chain.likeliest}) {
        const int in_a_row = attempts_in_a_row(link, mode, attempt.psdu_bytes);
        if (before < in_a_row) {
            return mode;
        }
        before -= in_a_row;
    }
    return 0;
}

int MinstrelRateControl::attempts_in_a_row(const Link& link, std::size_t mode, int psdu_bytes) const {
    const double mean = link.modes[mode].mean;
    return mean > likely_enough || mean < unlikely_enough
               ? fewest_in_a_row
               : attempts_in_a_stage(modes_, responses_, timing_, modes_.modes()[mode], psdu_bytes);
}

void MinstrelRateControl::succeeded(const RateAttempt& attempt, const Mode& mode, SimTime now) {
    count(attempt, mode, true, now);
}

void MinstrelRateControl::failed(const RateAttempt& attempt, const Mode& mode, SimTime now) {
    count(attempt, mode, false, now);
}

void MinstrelRateControl::count(const RateAttempt& attempt, const Mode& mode, bool success, SimTime now) {
    Statistics& statistics = link_to(attempt.destination, now).modes[modes_.index_of(mode)];
    ++statistics.attempts;
    statistics.successes += success ? 1 : 0;
}

void MinstrelRateControl::update(Link& link, int psdu_bytes, SimTime now) const {
    link.updated = now;
    for (Statistics& mode : link.modes) {
        if (mode.attempts > 0) {
            const double share = static_cast<double>(mode.successes) / mode.attempts;
            const double weight = mode.known ? parameters_.ewma_weight : 0;
            mode = {.known = true, .mean = weight * mode.mean + (1 - weight) * share};
        }
    }
    const std::span<const Mode> modes = modes_.modes();
    const auto throughput = [&](std::size_t mode) {
        return link.modes[mode].mean /
               attempt_s(responses_, timing_, modes[mode], psdu_bytes, modes_.cw_min());
    };
    // Of equal rates, the slower one is chosen. If nothing succeeded, the slowest rate is both the
    // best and the second best.
    std::size_t best = 0;
    std::size_t second = 0;
    std::size_t likeliest = 0;
    for (std::size_t mode = 1; mode < modes.size(); ++mode) {
        if (throughput(mode) > throughput(best)) {
            second = best;
            best = mode;
        } else if (throughput(mode) > (second == best ? 0 : throughput(second))) {
            second = mode;
        }
        const bool both_likely = std::min(link.modes[mode].mean, link.modes[likeliest].mean) >= likely_enough;
        if (both_likely ? throughput(mode) > throughput(likeliest)
                        : link.modes[mode].mean > link.modes[likeliest].mean) {
            likeliest = mode;
        }
    }
    link.chain = {best, second, likeliest};
}

}  // namespace netsim
