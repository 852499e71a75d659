// The channel as one 802.11 station knows it, and the station's access to it: carrier sense by the
// radio, virtual carrier sense by the NAV, and the contention, which needs both.
//
// In a large network, reports of the radio cost much time. So the radio watches the channel only
// while the station has a frame to send or a backoff to count down:
//
//        watch()                       stop_watching(), nothing left to send
//   OFF ---------> WATCHING, and back --------------------------------------> OFF
//    |                ^                                                        ^
//    | corrupted frame| the channel may still be busy by several weak frames   |
//    +-----------> REPORTING --------------- channel free: EIFS begins --------+
//
// REPORTING is the cheaper way to find the beginning of EIFS: the radio then leaves out frames that
// make the channel busy only together.
//
// The order of the calls matters. The contention learns of the end of a corrupted frame before the
// channel is free. What happened while the radio did not watch is caught up when it watches again
// (Contention::channel_found), so the time since then has to be within `longest_wait`.
#pragma once

#include "netsim/kernel/prefetch.hpp"
#include "netsim/mac/contention.hpp"
#include "netsim/mac/dcf_parameters.hpp"
#include "netsim/mac/transmit_queue.hpp"
#include "netsim/phy/radio.hpp"

namespace netsim {

class ChannelAccess {
public:
    // The parameters, the queue of the station and the listener must outlive it.
    ChannelAccess(Radio& radio, const DcfParameters& parameters, RandomStream draws,
                  const TransmitQueue& queue, ContentionListener& listener);

    // Watches the channel until stop_watching(). Call it before the contention begins.
    void watch() { watch_since(simulator().now() - parameters_.longest_wait); }
    // No effect while there is a frame to send or a backoff to count down.
    void stop_watching();

    // Contention::start and so on.
    void contend(int contention_window) { contention_.start(contention_window); }
    void contend_without_backoff_if_free(int contention_window) {
        contention_.start_without_backoff_if_free(contention_window);
    }
    bool is_contending() const { return contention_.in_progress(); }

    // What the radio reports (RadioListener).
    void radio_changed(bool busy);
    void frame_corrupted(CorruptedFrame frame);
    void prefetch_for_corrupted_frame() const { netsim::prefetch(contention_); }
    // Any frame was received correctly. If it is for another station, also call frame_overheard.
    void frame_received();
    void frame_overheard(const Frame& frame, const Mode& mode);

    // Whether the NAV ends later than before.
    bool set_nav(SimTime duration);
    bool is_nav_set() const { return nav_end_ > simulator().now(); }

    NodeId node() const { return radio_.node(); }

private:
    Simulator& simulator() const { return radio_.simulator(); }
    bool is_busy() const { return radio_.is_channel_busy() || is_nav_set(); }
    // Frames that made the channel busy only together count only after `since`.
    void watch_since(SimTime since);
    void update_contention();
    void await_end_of_nav();
    // Unless a frame follows the RTS that set it.
    void reset_nav_after_rts(const Mode& rts_mode);
    void reset_nav();
    void keep_nav();

    // The members that every received frame reads come first: they share a cache line with those of
    // the Dcf.
    Radio& radio_;
    SimTime nav_end_ = SimTime::long_ago();
    bool others_are_weak_ = false;  // of a corrupted frame, until its end frees the channel
    // Contention is notified of a correct frame only if this is set, since it is in another cache line.
    bool last_frame_was_broken_ = false;
    bool awaits_frame_after_rts_ = false;  // nav_reset_ is pending

    // Then the members that sending a broadcast reads.
    const DcfParameters& parameters_;
    const TransmitQueue& queue_;
    EventHandle nav_event_;  // pending while the channel is watched
    Contention contention_;

    EventHandle nav_reset_;  // pending after an RTS that set the NAV
    // Of the event at the end of the NAV; reserved when the NAV was set.
    SequenceNumber nav_sequence_number_ = 0;
};

}  // namespace netsim
