#include "netsim/mac/csma_ca_802154.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/phy/oqpsk_mode.hpp"

namespace netsim {

namespace {

BackoffMethod backoff_method_of(const std::string& name) {
    constexpr Factory<BackoffMethod> methods[] = {
        {"exponential", BackoffMethod::exponential},
        {"linear", BackoffMethod::linear},
        {"constant", BackoffMethod::constant},
    };
    static_assert(makes_all(methods, backoff_methods));
    return factory_of(name, methods);
}

}  // namespace

CsmaCa802154::CsmaCa802154(Simulator& simulator, Radio& radio, const CsmaConfig& config, std::uint64_t seed)
    : simulator_(simulator),
      radio_(radio),
      config_(config),
      backoff_method_(backoff_method_of(config.backoff_method)),
      unit_backoff_(SimTime::from_seconds(config.unit_backoff_s)),
      cca_(SimTime::from_seconds(config.cca_s)),
      turnaround_(SimTime::from_seconds(config.turnaround_s)),
      sifs_(SimTime::from_seconds(config.sifs_s)),
      lifs_(SimTime::from_seconds(config.lifs_s)),
      ack_wait_(SimTime::from_seconds(config.ack_wait_s)),
      draws_(seed, radio.interface().stream(), Purpose::csma_backoff),
      queue_(radio.node(), config.queue_capacity, config.queue_when_full == block_when_full) {
    radio_.set_listener(*this);
    radio_.stop_watching_channel();
}

void CsmaCa802154::send(NodeId destination, Payload payload, CauseId cause) {
    if (payload->size() > longest_message_bytes()) {
        throw SimulationError(
            "a message of " + std::to_string(payload->size()) + " bytes does not fit: the longest is " +
            std::to_string(longest_message_bytes()) + " bytes (an 802.15.4 frame of " +
            std::to_string(narrowband_longest_psdu_bytes) + " bytes less MAC, IPv4 and UDP headers)");
    }
    const int psdu_bytes = narrowband_psdu_bytes(static_cast<int>(payload->size()));
    Frame frame = queue_.frame_of(destination, std::move(payload), psdu_bytes, simulator_.now());
    frame.cause = cause;
    if (destination != broadcast_id && config_.use_acks) {
        frame.duration_field = sifs_ + oqpsk_250_kbps.duration(narrowband_ack_bytes);
    }
    if (!queue_.add(frame)) {
        report_failure(frame, MessageOutcome::queue_overflow);
        return;
    }
    if (queue_.has_one_in_front()) {
        report_blocking(true);
    }
    if (state_ == State::idle) {
        go_on();
    }
}

void CsmaCa802154::go_on() {
    const bool resumes = std::exchange(interrupted_by_ack_, false);
    if (queue_.empty()) {
        state_ = State::idle;
        return;
    }
    if (!resumes) {
        failed_assessments_ = 0;
    }
    back_off();
}

// The ends of backoff and assessment are the last events of their instants, so that they see all
// other events of the same instant.
void CsmaCa802154::back_off() {
    state_ = State::backing_off;
    const SimTime begin = std::max(simulator_.now(), earliest_wait_);
    timer_ = simulator_.schedule_at(
        begin + unit_backoff_ * backoff_periods(), [this] { assess(); }, Priority::last);
}

int CsmaCa802154::backoff_periods() {
    const auto draw_below = [this](int count) {
        return static_cast<int>(draws_.uniform_int(static_cast<std::uint32_t>(count)));
    };
    if (backoff_method_ == BackoffMethod::exponential) {
        return draw_below(1 << std::min(config_.min_be + failed_assessments_, config_.max_be));
    }
    const bool grows = backoff_method_ == BackoffMethod::linear;
    return 1 + draw_below(config_.contention_window + (grows ? failed_assessments_ : 0));
}

void CsmaCa802154::assess() {
    state_ = State::assessing;
    radio_.watch_channel(simulator_.now());
    was_busy_ = radio_.is_channel_busy();
    timer_ = simulator_.schedule_after(cca_, [this] { assessed(); }, Priority::last);
}

void CsmaCa802154::channel_busy_changed(bool busy) {
    was_busy_ |= busy;
}

void CsmaCa802154::assessed() {
    radio_.stop_watching_channel();
    if (radio_.is_channel_busy() || (config_.cca_whole_window && was_busy_)) {
        channel_is_busy();
        return;
    }
    begin_next();
    state_ = State::turning;
    radio_.turn_to_transmit();
    timer_ = simulator_.schedule_after(turnaround_, [this] {
        state_ = State::sending;
        transmit(queue_.in_progress());
    });
}

void CsmaCa802154::channel_is_busy() {
    if (++failed_assessments_ <= config_.max_backoffs) {
        back_off();
        return;
    }
    begin_next();
    fail(MessageOutcome::channel_access_failure);
}

void CsmaCa802154::begin_next() {
    if (queue_.begin_next()) {
        report_blocking(false);
    }
}

void CsmaCa802154::fail(MessageOutcome outcome) {
    report_failure(*queue_.in_progress(), outcome);
    finish(outcome);
}

void CsmaCa802154::transmit(std::shared_ptr<const Frame> frame) {
    const FrameLabel label{frame->kind, frame->receiver};
    const int psdu_bytes = frame->psdu_bytes;
    radio_.transmit(std::move(frame), label, psdu_bytes, oqpsk_250_kbps, oqpsk_250_kbps.duration(psdu_bytes));
}

void CsmaCa802154::transmission_ended() {
    if (state_ == State::sending_ack) {
        go_on();
        return;
    }
    NETSIM_ASSERT(state_ == State::sending);
    if (queue_.in_progress()->receiver == broadcast_id || !config_.use_acks) {
        earliest_wait_ = simulator_.now() + lifs_;
        finish(MessageOutcome::sent);
        return;
    }
    state_ = State::awaiting_ack;
    timer_ = simulator_.schedule_after(ack_wait_, [this] { ack_timed_out(); });
}

void CsmaCa802154::ack_timed_out() {
    if (retries_ >= config_.max_frame_retries) {
        fail(MessageOutcome::retry_limit);
        return;
    }
    ++retries_;
    queue_.set_retry();
    go_on();
}

void CsmaCa802154::finish(MessageOutcome outcome) {
    queue_.finish(outcome);
    retries_ = 0;
    go_on();
}

void CsmaCa802154::frame_received(const Transmission& transmission) {
    const Frame& frame = *transmission.frame;
    if (frame.kind == FrameKind::broadcast) {
        pass_on_message(frame);
    } else if (frame.receiver != radio_.node()) {
        return;
    } else if (frame.kind == FrameKind::unicast) {
        unicast_received(frame);
    } else if (frame.kind == FrameKind::ack && state_ == State::awaiting_ack &&
               frame.transmitter == queue_.in_progress()->receiver &&
               frame.sequence == queue_.in_progress()->sequence) {
        simulator_.cancel(timer_);
        earliest_wait_ = simulator_.now() + lifs_;
        finish(MessageOutcome::acknowledged);
    }
}

void CsmaCa802154::unicast_received(const Frame& frame) {
    if (asks_for_ack(frame) && state_ != State::awaiting_ack) {
        acknowledge(frame);
    }
    if (!duplicates_.is_duplicate(frame)) {
        pass_on_message(frame);
    }
}

void CsmaCa802154::acknowledge(const Frame& frame) {
    if (state_ != State::idle) {
        NETSIM_ASSERT(state_ == State::backing_off || state_ == State::assessing);
        simulator_.cancel(timer_);
        radio_.stop_watching_channel();
        interrupted_by_ack_ = true;
    }
    state_ = State::waiting_sifs;
    ack_ = std::make_shared<const Frame>(make_narrowband_ack(frame));
    radio_.turn_to_transmit();
    timer_ = simulator_.schedule_after(sifs_, [this] {
        state_ = State::sending_ack;
        transmit(std::exchange(ack_, nullptr));
    });
}

}  // namespace netsim
