#include "netsim/mac/dcf.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/mac/control_frames.hpp"

namespace netsim {

Dcf::Dcf(Radio& radio, std::shared_ptr<const DcfParameters> parameters, std::uint64_t seed)
    : channel_(radio, *parameters, RandomStream(seed, radio.interface().stream(), Purpose::backoff), queue_,
               *this),
      retry_(parameters->retry),
      queue_(radio.node(), parameters->config.queue_capacity,
             parameters->config.queue_when_full == block_when_full),
      parameters_(*parameters),
      radio_(radio),
      owned_parameters_(std::move(parameters)),
      rate_control_(make_rate_control(parameters_.config, seed, radio.interface())),
      frames_by_mode_(parameters_.has_adaptive_rate ? parameters_.modes.modes().size() : 0),
      data_mode_(&parameters_.initial_mode) {
    radio_.set_listener(*this);
}

void Dcf::send(NodeId destination, Payload payload, CauseId cause) {
    if (payload->size() > longest_message_bytes()) {
        throw SimulationError(
            "a message of " + std::to_string(payload->size()) + " bytes does not fit: the longest is " +
            std::to_string(longest_message_bytes()) + " bytes (an MTU of " +
            std::to_string(parameters_.config.mtu_bytes) + " bytes less IPv4 and UDP headers)");
    }
    const int psdu_bytes = data_psdu_bytes(static_cast<int>(payload->size()));
    Frame frame = queue_.frame_of(destination, std::move(payload), psdu_bytes, simulator().now());
    frame.cause = cause;
    if (destination != broadcast_id) {
        frame.duration_field = data_duration_field(parameters_.timing, parameters_.responses, *data_mode_);
    }
    if (!queue_.add(frame)) {
        report_failure(frame, MessageOutcome::queue_overflow);
        return;
    }
    if (queue_.has_one_in_front()) {
        report_blocking(true);
    }
    channel_.watch();
    if (exchange_ == Exchange::none) {
        if (parameters_.config.skip_backoff_if_idle && !channel_.is_contending()) {
            channel_.contend_without_backoff_if_free(retry_.contention_window());
        } else {
            contend_for_next();
        }
    }
}

void Dcf::contend_for_next() {
    if (!queue_.empty() && !channel_.is_contending()) {
        channel_.contend(retry_.contention_window());
    }
}

void Dcf::channel_granted() {
    if (queue_.empty()) {  // end of the post-backoff
        channel_.stop_watching();
        return;
    }
    NETSIM_ASSERT(exchange_ == Exchange::none && response_ == Response::none);
    if (queue_.begin_next()) {
        report_blocking(false);
    }
    if (in_progress().receiver != broadcast_id) {
        choose_data_mode();
    }
    if (needs_rts(in_progress())) {
        send_rts();
    } else {
        send_in_progress();
    }
}

RateAttempt Dcf::attempt() const {
    return {in_progress().receiver, in_progress().psdu_bytes, attempts_};
}

void Dcf::choose_data_mode() {
    data_mode_ = &rate_control_->mode_for(attempt(), simulator().now());
    const SimTime duration_field =
        data_duration_field(parameters_.timing, parameters_.responses, *data_mode_);
    queue_.set_duration_field(duration_field);
}

void Dcf::send_rts() {
    exchange_ = Exchange::sending_rts;
    rts_ = std::make_shared<const Frame>(make_rts(in_progress(), parameters_.timing, parameters_.responses,
                                                  parameters_.rts_mode, *data_mode_));
    transmit(rts_, parameters_.rts_mode);
}

void Dcf::send_in_progress() {
    exchange_ = Exchange::sending;
    if (in_progress().receiver == broadcast_id) {
        transmit(queue_.in_progress(), parameters_.broadcast_mode);
    } else {
        if (parameters_.has_adaptive_rate) {
            ++frames_by_mode_[parameters_.modes.index_of(*data_mode_)];
        }
        transmit(queue_.in_progress(), *data_mode_);
    }
}

void Dcf::transmit(std::shared_ptr<const Frame> frame, const Mode& mode) {
    const FrameLabel label{frame->kind, frame->receiver};
    const int psdu_bytes = frame->psdu_bytes;
    radio_.transmit(std::move(frame), label, psdu_bytes, mode, mode.duration(psdu_bytes));
}

void Dcf::transmission_ended() {
    if (response_ == Response::sending) {
        response_ = Response::none;
        own_frame_ended(*response_frame_);
    } else if (exchange_ == Exchange::sending_rts) {
        own_frame_ended(*rts_);
        await_answer(Exchange::awaiting_cts, parameters_.responses.to(parameters_.rts_mode));
    } else {
        NETSIM_ASSERT(exchange_ == Exchange::sending);
        if (in_progress().receiver == broadcast_id) {
            retry_.broadcast_sent();
            finish(MessageOutcome::sent);
            return;
        }
        own_frame_ended(in_progress());
        await_answer(Exchange::awaiting_ack, parameters_.responses.to(*data_mode_));
    }
}

void Dcf::await_answer(Exchange awaiting, const Mode& answer) {
    exchange_ = awaiting;
    answer_timeout_ = simulator().schedule_after(parameters_.timing.response_timeout(answer),
                                                 [this] { answer_timed_out(); });
}

bool Dcf::is_awaiting_answer() const {
    return exchange_ == Exchange::awaiting_cts || exchange_ == Exchange::awaiting_ack;
}

void Dcf::answer_timed_out() {
    // A frame that is being received may be the response. Its end decides.
    if (!radio_.is_receiving()) {
        attempt_failed();
    }
}

void Dcf::frame_received(const Transmission& transmission) {
    channel_.frame_received();
    const Frame& frame = *transmission.frame;
    const bool for_this_station = frame.receiver == channel_.node();
    if (!for_this_station) {
        channel_.frame_overheard(frame, *transmission.mode);
    }
    if (is_awaiting_answer()) {
        const FrameKind awaited = exchange_ == Exchange::awaiting_cts ? FrameKind::cts : FrameKind::ack;
        if (frame.kind == awaited && for_this_station) {
            answered();
        } else {
            attempt_failed();
        }
    }
    if (frame.kind == FrameKind::broadcast) {
        pass_on_message(frame);
    } else if (for_this_station) {
        addressed_here(frame, *transmission.mode);
    }
}

void Dcf::answered() {
    simulator().cancel(answer_timeout_);
    if (exchange_ == Exchange::awaiting_cts) {
        retry_.rts_answered();
        exchange_ = Exchange::waiting_sifs;
        simulator().schedule_after(parameters_.timing.sifs, [this] { send_in_progress(); });
    } else {
        rate_control_->succeeded(attempt(), *data_mode_, simulator().now());
        retry_.acknowledged(is_long(in_progress()));
        finish(MessageOutcome::acknowledged);
    }
}

void Dcf::addressed_here(const Frame& frame, const Mode& mode) {
    if (frame.kind == FrameKind::rts && !channel_.is_nav_set()) {
        const Mode& cts_mode = parameters_.responses.to(mode);
        respond_after_sifs(make_cts(frame, parameters_.timing, cts_mode), cts_mode);
    } else if (frame.kind == FrameKind::unicast) {
        respond_after_sifs(make_ack(frame), parameters_.responses.to(mode));
        if (!duplicates_.is_duplicate(frame)) {
            pass_on_message(frame);
        }
    }
}

void Dcf::frame_corrupted(CorruptedFrame frame) {
    channel_.frame_corrupted(frame);
    if (is_awaiting_answer() && !simulator().is_pending(answer_timeout_)) {
        attempt_failed();
    }
}

void Dcf::respond_after_sifs(Frame response, const Mode& mode) {
    NETSIM_ASSERT(response_ == Response::none);
    response_ = Response::waiting_sifs;
    response_frame_ = std::make_shared<const Frame>(std::move(response));
    response_mode_ = &mode;
    simulator().schedule_after(parameters_.timing.sifs, [this] {
        response_ = Response::sending;
        transmit(response_frame_, *response_mode_);
    });
}

void Dcf::attempt_failed() {
    simulator().cancel(answer_timeout_);
    const bool was_sent = exchange_ == Exchange::awaiting_ack;
    if (was_sent) {
        rate_control_->failed(attempt(), *data_mode_, simulator().now());
        ++attempts_;
    }
    const bool may_go_on = was_sent && is_long(in_progress()) ? retry_.long_failed() : retry_.short_failed();
    if (!may_go_on) {
        retry_.given_up();
        report_failure(in_progress(), MessageOutcome::retry_limit);
        finish(MessageOutcome::retry_limit);
        return;
    }
    if (was_sent) {
        queue_.set_retry();
    }
    exchange_ = Exchange::none;
    contend_for_next();
}

void Dcf::finish(MessageOutcome outcome) {
    queue_.finish(outcome);
    attempts_ = 0;
    exchange_ = Exchange::none;
    if (!queue_.empty() || parameters_.config.skip_backoff_if_idle) {
        channel_.contend(retry_.contention_window());
    }
    channel_.stop_watching();
}

std::map<std::int64_t, std::uint64_t> Dcf::frames_by_bitrate() const {
    std::map<std::int64_t, std::uint64_t> frames;
    if (parameters_.has_adaptive_rate) {
        for (const Mode& mode : parameters_.modes.modes()) {
            frames[mode.bitrate_bps] = frames_by_mode_[parameters_.modes.index_of(mode)];
        }
    }
    return frames;
}

void Dcf::own_frame_ended(const Frame& frame) {
    if (parameters_.config.own_frames_set_nav) {
        channel_.set_nav(frame.duration_field);
    }
}

}  // namespace netsim
