#include "netsim/mac/dcf.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "netsim/error.hpp"

namespace netsim {

namespace {

const Mode& multicast_mode(const MacConfig& config, const ModeSet& modes, const Mode& data_mode) {
    return config.multicast_bitrate_bps < 0
               ? data_mode
               : modes.mode_for_bitrate(config.multicast_bitrate_bps, "mac.multicast_bitrate_bps");
}

int cw_min(const MacConfig& config, const ModeSet& modes) {
    return config.cw_min < 0 ? modes.cw_min() : config.cw_min;
}

int cw_max(const MacConfig& config, const ModeSet& modes) {
    return config.cw_max < 0 ? modes.cw_max() : config.cw_max;
}

MessageKind message_kind(const Frame& frame) {
    return frame.receiver == broadcast_id ? MessageKind::broadcast : MessageKind::unicast;
}

}  // namespace

Dcf::Dcf(Simulator& simulator, Radio& radio, const MacConfig& config, std::uint64_t seed, MessageFates& fates,
         LinkListener& listener)
    : simulator_(simulator),
      radio_(radio),
      fates_(fates),
      listener_(listener),
      modes_(mode_set(config.op_mode)),
      timing_(modes_),
      data_mode_(modes_.mode_for_bitrate(config.bitrate_bps)),
      multicast_mode_(multicast_mode(config, modes_, data_mode_)),
      retry_limit_(config.short_retry_limit),
      mtu_bytes_(config.mtu_bytes),
      cw_min_(cw_min(config, modes_)),
      cw_max_(cw_max(config, modes_)),
      queue_(config.queue_capacity),
      contention_(simulator, timing_, config.backoff_optimization,
                  RandomStream(seed, static_cast<std::uint32_t>(radio.id()), Purpose::backoff), *this),
      cw_(cw_min_) {
    radio_.set_listener(*this);
}

void Dcf::check(const MacConfig& config) {
    const ModeSet& modes = mode_set(config.op_mode);
    multicast_mode(config, modes, modes.mode_for_bitrate(config.bitrate_bps));
    if (cw_max(config, modes) < cw_min(config, modes)) {
        throw ConfigError("mac.cw_min = " + std::to_string(cw_min(config, modes)) +
                          " and mac.cw_max = " + std::to_string(cw_max(config, modes)) +
                          " slots: expected a cw_max of at least cw_min (what " +
                          "is not set is that of the operation mode, " + config.op_mode + ")");
    }
}

void Dcf::send(NodeId destination, Payload payload) {
    const int payload_bytes = static_cast<int>(std::min(payload->size(), std::size_t{1} << 30));
    if (datagram_bytes(payload_bytes) > mtu_bytes_) {
        throw SimulationError("a message of " + std::to_string(payload->size()) +
                              " bytes does not fit: the longest is " +
                              std::to_string(mtu_bytes_ - datagram_bytes(0)) + " bytes (an MTU of " +
                              std::to_string(mtu_bytes_) + " bytes less IPv4 and UDP headers)");
    }
    Frame frame;
    frame.kind = destination == broadcast_id ? FrameKind::broadcast : FrameKind::unicast;
    frame.transmitter = radio_.id();
    frame.receiver = destination;
    frame.sequence = next_sequence_++;
    frame.psdu_bytes = data_psdu_bytes(payload_bytes);
    frame.payload = std::move(payload);
    if (destination != broadcast_id) {
        frame.duration_field = timing_.sifs + modes_.response_mode(data_mode_).duration(ack_bytes);
    }
    const MessageKind kind = message_kind(frame);
    fates_.accept(kind);
    if (!queue_.push(std::make_shared<const Frame>(std::move(frame)))) {
        fates_.book(kind, MessageFate::queue_overflow);
        return;
    }
    if (exchange_ == Exchange::none) {
        contend_for_next();
    }
}

void Dcf::contend_for_next() {
    if ((in_progress_ || !queue_.empty()) && !contention_.in_progress()) {
        contention_.start(cw_);
    }
}

void Dcf::channel_granted() {
    NETSIM_ASSERT(exchange_ == Exchange::none && response_ == Response::none);
    if (!in_progress_) {
        in_progress_ = queue_.pop();
    }
    exchange_ = Exchange::sending;
    transmit(in_progress_, in_progress_->receiver == broadcast_id ? multicast_mode_ : data_mode_);
}

void Dcf::transmit(std::shared_ptr<const Frame> frame, const Mode& mode) {
    const FrameLabel label{frame->kind, frame->receiver};
    const int psdu_bytes = frame->psdu_bytes;
    radio_.transmit(std::move(frame), label, psdu_bytes, mode, mode.duration(psdu_bytes));
}

void Dcf::transmission_ended() {
    if (response_ == Response::sending) {
        response_ = Response::none;
        return;
    }
    NETSIM_ASSERT(exchange_ == Exchange::sending);
    if (in_progress_->receiver == broadcast_id) {
        finish(MessageFate::sent);
        return;
    }
    exchange_ = Exchange::awaiting_ack;
    set_nav(in_progress_->duration_field);
    ack_timeout_ = simulator_.schedule_after(timing_.response_timeout(modes_.response_mode(data_mode_)),
                                             [this] { ack_timed_out(); });
}

void Dcf::ack_timed_out() {
    // A frame that is being received may be the ACK: its end decides.
    if (!radio_.is_receiving()) {
        attempt_failed();
    }
}

void Dcf::frame_received(const Transmission& transmission) {
    contention_.frame_received();
    const Frame& frame = *transmission.frame;
    const bool for_this_station = frame.receiver == radio_.id();
    if (!for_this_station) {
        set_nav(frame.duration_field);
    }
    if (exchange_ == Exchange::awaiting_ack) {
        if (frame.kind == FrameKind::ack && for_this_station) {
            simulator_.cancel(ack_timeout_);
            cw_ = cw_min_;
            finish(MessageFate::acknowledged);
        } else {
            attempt_failed();
        }
    }
    if (frame.kind == FrameKind::unicast && for_this_station) {
        response_ = Response::waiting_sifs;
        const Mode* mode = &modes_.response_mode(*transmission.mode);
        simulator_.schedule_after(timing_.sifs,
                                  [this, receiver = frame.transmitter, mode] { send_ack(receiver, *mode); });
        if (!duplicates_.is_duplicate(frame)) {
            listener_.message_received(frame.transmitter, frame.payload);
        }
    } else if (frame.kind == FrameKind::broadcast) {
        listener_.message_received(frame.transmitter, frame.payload);
    }
}

void Dcf::frame_corrupted() {
    contention_.frame_corrupted();
    if (exchange_ == Exchange::awaiting_ack && !simulator_.is_pending(ack_timeout_)) {
        attempt_failed();
    }
}

void Dcf::send_ack(NodeId receiver, const Mode& mode) {
    response_ = Response::sending;
    Frame ack;
    ack.kind = FrameKind::ack;
    ack.transmitter = radio_.id();
    ack.receiver = receiver;
    ack.psdu_bytes = ack_bytes;
    transmit(std::make_shared<const Frame>(std::move(ack)), mode);
}

void Dcf::attempt_failed() {
    simulator_.cancel(ack_timeout_);
    if (++failures_ >= retry_limit_) {
        cw_ = cw_min_;
        finish(MessageFate::retry_limit);
        return;
    }
    cw_ = std::min(2 * cw_ + 1, cw_max_);
    if (!in_progress_->retry) {
        Frame again = *in_progress_;
        again.retry = true;
        in_progress_ = std::make_shared<const Frame>(std::move(again));
    }
    exchange_ = Exchange::none;
    contend_for_next();
}

void Dcf::finish(MessageFate fate) {
    fates_.book(message_kind(*in_progress_), fate);
    in_progress_.reset();
    failures_ = 0;
    exchange_ = Exchange::none;
    contend_for_next();
}

void Dcf::set_nav(SimTime duration) {
    const SimTime end = simulator_.now() + duration;
    if (duration <= SimTime{} || end <= nav_end_) {
        return;
    }
    nav_end_ = end;
    simulator_.cancel(nav_event_);
    nav_event_ = simulator_.schedule_at(end, [this] { update_contention(); });
    update_contention();
}

void Dcf::channel_busy_changed(bool) {
    update_contention();
}

void Dcf::update_contention() {
    const bool busy = radio_.is_channel_busy() || nav_end_ > simulator_.now();
    if (busy != contention_sees_busy_) {
        contention_sees_busy_ = busy;
        contention_.channel_busy_changed(busy);
    }
}

}  // namespace netsim
