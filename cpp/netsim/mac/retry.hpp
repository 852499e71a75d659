// Retry counters of the frame in progress, and the contention window that grows with failures.
//
// A frame has two counters. The short one counts failures of RTS frames and of frames below the RTS
// threshold. The long one counts failures of frames at or above it. A CTS resets neither.
// Every failure doubles the window.
//
// By default (Rule::frame_counters), dropping a frame resets the window. Rule::station_counters,
// INET's rule, also counts the failures of the station, in two counters that outlive frames. Only
// successes and broadcasts reset them. The failure with which a counter reaches the limit resets the
// window, and each later one doubles it. So the window is small after the first of several dropped
// frames, and large after later ones. In Rule::station_window, of ns-3 3.44, dropping a frame does
// not change the window. With n the short limit, the failure n + 1 in a row resets it.
//
// Source: IEEE 802.11-2020, 10.3.4.4 (recovery procedures) and 10.3.3 (contention window). INET's
// choice: a frame of exactly the threshold's length is long. Why INET's rule is not the default:
// docs/decisions/0025.
#pragma once

#include <algorithm>
#include <cstdint>

namespace netsim {

class Retry {
public:
    struct Limits {
        int short_failures;
        int long_failures;
    };
    struct Window {
        int min;
        int max;
    };
    enum class Rule : std::uint8_t { frame_counters, station_counters, station_window };
    // Usually shared by all stations.
    struct Rules {
        Limits limits{};
        Window window{};
        Rule rule = Rule::frame_counters;
    };

    // The rules must outlive it.
    explicit Retry(const Rules& rules) : rules_(rules), cw_(rules.window.min) {}

    // The contention window of the next attempt, in slots.
    int contention_window() const { return cw_; }

    // An RTS or a frame below the RTS threshold was not answered. Returns false if that was the last
    // attempt.
    bool short_failed() { return failed(short_, rules_.limits.short_failures); }
    // The same for a frame at or above the RTS threshold.
    bool long_failed() { return failed(long_, rules_.limits.long_failures); }
    // An RTS was answered. Affects only the counter of the station.
    void rts_answered() { short_.of_station = 0; }
    // The frame was acknowledged. The next frame starts with its counters and the window reset.
    void acknowledged(bool is_long) {
        (is_long ? long_ : short_).of_station = 0;
        start_afresh();
    }
    // The frame was dropped, after its last attempt.
    void given_up() {
        if (rules_.rule == Rule::frame_counters) {
            start_afresh();
        } else {
            forget_frame();
        }
    }
    // A broadcast neither succeeds nor fails: the window stays as it is.
    void broadcast_sent() { short_ = long_ = {}; }

private:
    // Numbers of consecutive failures.
    struct Failures {
        int of_frame = 0;
        int of_station = 0;
    };

    bool failed(Failures& failures, int limit) {
        const bool may_go_on = ++failures.of_frame < limit;
        ++failures.of_station;
        ++failures_in_a_row_;
        if (rules_.rule == Rule::station_counters && failures.of_station == limit) {
            cw_ = rules_.window.min;
        } else if (rules_.rule == Rule::station_window && failures_in_a_row_ > rules_.limits.short_failures) {
            failures_in_a_row_ = 0;
            cw_ = rules_.window.min;
        } else if (rules_.rule != Rule::frame_counters || may_go_on) {
            cw_ = std::min(2 * cw_ + 1, rules_.window.max);
        }
        return may_go_on;
    }
    void forget_frame() { short_.of_frame = long_.of_frame = 0; }
    void start_afresh() {
        forget_frame();
        failures_in_a_row_ = 0;
        cw_ = rules_.window.min;
    }

    const Rules& rules_;
    Failures short_;
    Failures long_;
    int failures_in_a_row_ = 0;  // of the station; for Rule::station_window
    int cw_;
};

}  // namespace netsim
