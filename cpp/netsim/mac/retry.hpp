// How often the frame in progress may fail, and the contention window that grows with its failures.
//
// A frame has two counters. The short one counts failures of RTS frames and of frames below the RTS threshold, the
// long one those of frames from the threshold on. A frame whose RTS and own transmissions fail in turn has both
// running: a CTS resets neither. Every failure doubles the window.
//
// Source: IEEE 802.11-2020, 10.3.4.4 (recovery procedures) and 10.3.3 (contention window); that a frame of exactly the
// threshold's length counts as long is INET's choice. A frame that is given up resets the window, as the standard has it;
// in INET the window stays large from the second such frame in a row on (docs/decisions/0025).
#pragma once

#include <algorithm>

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

    Retry(Limits limits, Window window) : limits_(limits), window_(window), cw_(window.min) {}

    // The contention window of the next attempt, in slots.
    int contention_window() const { return cw_; }

    // An RTS or a frame below the RTS threshold was not answered. False if that was the last attempt.
    bool short_failed() { return failed(short_failures_, limits_.short_failures); }
    // The same for a frame from the RTS threshold on.
    bool long_failed() { return failed(long_failures_, limits_.long_failures); }
    // The frame was acknowledged, or given up: the next one starts afresh.
    void start_afresh() {
        forget_failures();
        cw_ = window_.min;
    }
    // A broadcast was sent, which can neither succeed nor fail: the window stays as it is.
    void forget_failures() { short_failures_ = long_failures_ = 0; }

private:
    bool failed(int& failures, int limit) {
        if (++failures >= limit) {
            return false;
        }
        cw_ = std::min(2 * cw_ + 1, window_.max);
        return true;
    }

    Limits limits_;
    Window window_;
    int short_failures_ = 0;
    int long_failures_ = 0;
    int cw_;
};

}  // namespace netsim
