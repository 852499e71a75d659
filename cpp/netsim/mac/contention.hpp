// Contention of one station for the channel: interframe space and backoff. Also known as channel
// access function.
//
//   IDLE --start, channel free--> WAITING --time is up--> IDLE, and the channel is granted
//     |                            |   ^
//     +--start, channel busy--+  busy  | free: interframe space again, then the slots that were left
//                             v    v   |
//                             DEFERRING
//
// Every wait takes DIFS (EIFS after a corrupted frame) + backoff · slot. With immediate access
// (`backoff_optimization`), the time before `start` in which the channel was free and this station
// idle counts toward the wait. So a frame is sent at once if the channel was free for long enough.
// Before the run, the channel counts as busy, unless `initial_channel_busy` is off.
//
// EIFS follows IEEE 802.11-2020, 10.3.2.3.7: at every station, it begins when the radio finds the
// channel free after a corrupted frame, and ends early if a frame is received correctly. With
// `inet_eifs`, as in INET, it applies only at a station that waits for the channel, and begins at the
// end of the corrupted frame. A correct frame does not end it, and a busy period that ends within it
// is followed by a whole EIFS. With `ns3_eifs`, it also begins at the end of the corrupted frame,
// even if others still make the channel busy. A lost PHY header brings none. Its end is that of the
// standard.
//
// Two stations whose slots end at the same instant both transmit and collide: neither can sense the
// other in time. A grant is the last event of its instant, so that it sees all other events of that
// instant.
#pragma once

#include <algorithm>
#include <cstdint>

#include "netsim/error.hpp"
#include "netsim/kernel/random.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/mac/dcf_parameters.hpp"

namespace netsim {

class ContentionListener {
public:
    virtual void channel_granted() = 0;

protected:
    ~ContentionListener() = default;
};

class Contention {
public:
    // The parameters must outlive it.
    Contention(const DcfParameters& parameters, RandomStream draws, ContentionListener& listener)
        : parameters_(parameters),
          listener_(listener),
          free_since_(parameters.config.initial_channel_busy ? parameters.simulator.now()
                                                             : SimTime::long_ago()),
          draws_(draws) {}

    // Draws a backoff of 0 … contention_window slots and waits for the channel. Call it only if no
    // wait is in progress.
    void start(int contention_window);
    // The same, but without a backoff if the channel is free now: waits DIFS from now on, however
    // long it was free before. If it becomes busy meanwhile, waits DIFS after that.
    void start_without_backoff_if_free(int contention_window);
    bool in_progress() const { return state_ != State::idle; }

    // The channel became busy (by the radio or the NAV) or free. Call it only for changes. Optional
    // while no wait is in progress.
    void channel_busy_changed(bool busy);
    // Sets the state of the channel after a time without reports: busy, or free since `free_since`.
    void channel_found(bool busy, SimTime free_since) {
        NETSIM_ASSERT(!in_progress());
        busy_ = busy;
        if (!busy) {
            free_since_ = std::max(free_since_, free_since);
        }
    }
    bool finds_channel_busy() const { return busy_; }
    // Whether a corrupted frame will start EIFS when the radio finds the channel free.
    bool awaits_end_of_broken_frame() const { return broken_frame_; }
    // A frame was corrupted. The radio still finds the channel busy.
    void frame_corrupted() {
        if (parameters_.config.ns3_eifs || (parameters_.config.inet_eifs && in_progress())) {
            eifs_until_ = simulator().now() + parameters_.timing.eifs;
        } else if (!parameters_.config.inet_eifs) {
            broken_frame_ = true;
        }
    }
    // The radio finds the channel free again. After a corrupted frame, EIFS begins here, regardless
    // of the NAV, and replaces DIFS. Call it before channel_busy_changed.
    void radio_finds_it_free() {
        if (broken_frame_) {
            broken_frame_ = false;
            eifs_until_ = simulator().now() + parameters_.timing.eifs;
        }
    }
    // A frame was received correctly, which ends EIFS.
    void frame_received() {
        if (!parameters_.config.inet_eifs) {
            broken_frame_ = false;
            eifs_until_ = SimTime::long_ago();
        }
    }

private:
    enum class State : std::uint8_t { idle, deferring, waiting };

    SimTime space_over(SimTime idle_since) const;
    void schedule_grant(SimTime idle_since);
    void granted();

    Simulator& simulator() const { return parameters_.simulator; }

    const DcfParameters& parameters_;
    ContentionListener& listener_;
    State state_ = State::idle;
    bool busy_ = false;
    bool broken_frame_ = false;  // a frame was corrupted since the radio found the channel busy
    int slots_left_ = 0;
    SimTime free_since_;
    SimTime eifs_until_ = SimTime::long_ago();
    SimTime idle_since_ = SimTime::long_ago();
    SimTime grant_time_;
    EventHandle grant_;
    RandomStream draws_;
};

}  // namespace netsim
