#include "netsim/mac/channel_access.hpp"

#include <algorithm>
#include <utility>

#include "netsim/mac/control_frames.hpp"

namespace netsim {

ChannelAccess::ChannelAccess(Radio& radio, const DcfParameters& parameters, RandomStream draws,
                             const TransmitQueue& queue, ContentionListener& listener)
    : radio_(radio), parameters_(parameters), queue_(queue), contention_(parameters, draws, listener) {
    radio_.stop_watching_channel();
    radio_.remember_channel(parameters.longest_wait);
}

// Frames that the radio did not report may have made the channel busy since it was last watched.
void ChannelAccess::watch_since(SimTime since) {
    if (!radio_.watches_channel()) {
        const SimTime radio_free_since = radio_.watch_channel(since);
        contention_.channel_found(is_busy(), std::max(radio_free_since, nav_end_));
        if (is_nav_set()) {
            await_end_of_nav();
        }
    }
}

void ChannelAccess::stop_watching() {
    if (radio_.watches_channel()) {  // otherwise the queue is empty
        if (!queue_.empty() || contention_.in_progress()) {
            return;
        }
        simulator().cancel(nav_event_);
    }
    radio_.stop_watching_channel();
    if (contention_.awaits_end_of_broken_frame()) {
        radio_.report_channel();
    }
}

void ChannelAccess::radio_changed(bool busy) {
    if (!busy) {
        const bool others_are_weak = std::exchange(others_are_weak_, false);
        if (contention_.awaits_end_of_broken_frame() && !radio_.watches_channel() && !others_are_weak) {
            watch_since(simulator().now());
            if (radio_.is_channel_busy()) {
                return;
            }
        }
        contention_.radio_finds_it_free();
        stop_watching();
    }
    if (radio_.watches_channel()) {
        update_contention();
    }
}

void ChannelAccess::update_contention() {
    if (is_busy() != contention_.finds_channel_busy()) {
        contention_.channel_busy_changed(is_busy());
    }
}

void ChannelAccess::frame_corrupted(CorruptedFrame frame) {
    last_frame_was_broken_ = true;
    others_are_weak_ = frame.others_are_weak;
    if (!frame.header_lost) {
        keep_nav();
    }
    if (!frame.header_lost || !parameters_.config.ns3_eifs) {
        contention_.frame_corrupted();
    }
    radio_.report_channel();  // EIFS begins when the channel is free
}

void ChannelAccess::frame_received() {
    if (last_frame_was_broken_) {
        last_frame_was_broken_ = false;
        contention_.frame_received();
    }
    keep_nav();
}

void ChannelAccess::frame_overheard(const Frame& frame, const Mode& mode) {
    if (set_nav(frame.duration_field) && frame.kind == FrameKind::rts) {
        reset_nav_after_rts(mode);
    }
}

bool ChannelAccess::set_nav(SimTime duration) {
    if (duration <= SimTime{} || simulator().now() + duration <= nav_end_) {
        return false;
    }
    nav_end_ = simulator().now() + duration;
    nav_sequence_number_ = simulator().reserve_sequence_numbers(1);
    simulator().cancel(nav_event_);
    if (radio_.watches_channel()) {
        await_end_of_nav();
        update_contention();
    }
    return true;
}

// Source: IEEE 802.11-2020, 10.3.2.4 (NAVTimeout).
void ChannelAccess::reset_nav_after_rts(const Mode& rts_mode) {
    if (!parameters_.config.unanswered_rts_resets_nav) {
        return;
    }
    const Mode& cts_mode = parameters_.responses.to(rts_mode);
    const SimTime timeout = (parameters_.timing.sifs + parameters_.timing.slot) * 2 +
                            cts_mode.duration(cts_bytes) + cts_mode.preamble + cts_mode.header;
    awaits_frame_after_rts_ = true;
    nav_reset_ = simulator().schedule_after(timeout, [this] { reset_nav(); });
}

void ChannelAccess::reset_nav() {
    awaits_frame_after_rts_ = false;
    if (radio_.is_receiving_data() || !is_nav_set()) {
        return;
    }
    nav_end_ = simulator().now();
    simulator().cancel(nav_event_);
    if (radio_.watches_channel()) {
        update_contention();
    }
}

// A frame followed the RTS.
void ChannelAccess::keep_nav() {
    if (awaits_frame_after_rts_) {
        awaits_frame_after_rts_ = false;
        simulator().cancel(nav_reset_);
    }
}

void ChannelAccess::await_end_of_nav() {
    nav_event_ =
        simulator().schedule_reserved(nav_end_, nav_sequence_number_, [this] { update_contention(); });
}

}  // namespace netsim
