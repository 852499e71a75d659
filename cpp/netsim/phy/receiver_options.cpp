#include "netsim/phy/receiver_options.hpp"

#include <algorithm>

#include "netsim/error.hpp"

namespace netsim {

void ReceiverOptions::begin_reception(const Arrival& arrival) {
    const PreambleDetection& detection = radio_.model_.preamble_detection;
    if (!detection.is_on()) {
        lock_on(arrival);
        return;
    }
    const auto end = [this, transmission = arrival.transmission] { end_detection(transmission); };
    in_detection_.push_back({arrival, radio_.simulator().schedule_after(detection.duration(), end)});
}

std::vector<ReceiverOptions::Detection>::iterator ReceiverOptions::find(const Transmission* transmission) {
    return std::ranges::find(in_detection_, transmission,
                             [](const Detection& detection) { return detection.arrival.transmission; });
}

void ReceiverOptions::end_detection(const Transmission* transmission) {
    const auto ended = find(transmission);
    NETSIM_ASSERT(ended != in_detection_.end());
    const Arrival arrival = ended->arrival;
    in_detection_.erase(ended);
    ignores_energy_ = false;
    if (is_detected(arrival)) {
        stop_detections(FrameOutcome::receiver_locked);
        lock_on(arrival);
    } else {
        if (radio_.medium().outcomes().observer() != nullptr) {
            radio_.tell_loss(arrival, FrameOutcome::preamble_undetected,
                             &radio_.interference_in(arrival, {arrival.start, radio_.simulator().now()}));
        }
        radio_.book(*transmission, FrameOutcome::preamble_undetected);
    }
    radio_.update_busy();
}

bool ReceiverOptions::is_detected(const Arrival& arrival) {
    if (std::ranges::any_of(in_detection_, [&arrival](const Detection& other) {
            return other.arrival.power_w > arrival.power_w;
        })) {
        return false;
    }
    const auto& steps = radio_.interference_in(arrival, {arrival.start, radio_.simulator().now()}).steps();
    return radio_.model_.preamble_detection.detects(
        arrival.power_w, radio_.model_.reception.snir(arrival, steps.back().power_w));
}

void ReceiverOptions::stop_detections(FrameOutcome outcome) {
    for (const Detection& detection : in_detection_) {
        radio_.simulator().cancel(detection.end);
        radio_.book(*detection.arrival.transmission, outcome);
    }
    in_detection_.clear();
}

void ReceiverOptions::lock_on(const Arrival& arrival) {
    radio_.present_.lock_on(arrival.transmission);
    began_in_header_ = false;
    locked_ = arrival;
    if (radio_.model_.by_chunks) {
        const SimTime end = std::max(period_of(FramePart::header, arrival).end, radio_.simulator().now());
        header_end_ = radio_.simulator().schedule_at(end, [this] { end_header(); });
    }
}

bool ReceiverOptions::captures(const Arrival& later) {
    if (!radio_.model_.frame_capture.captures(locked_, later)) {
        began_in_header_ = began_in_header_ || is_receiving_header();
        return false;
    }
    radio_.simulator().cancel(header_end_);
    radio_.book(radio_.present_.unlock(), FrameOutcome::captured);
    radio_.listener_->frame_corrupted({});
    begin_reception(later);
    return true;
}

void ReceiverOptions::give_up(FrameOutcome outcome) {
    stop_detections(outcome);
    radio_.simulator().cancel(header_end_);
}

void ReceiverOptions::arrival_ended(const Arrival& arrival) {
    if (const auto undetected = find(arrival.transmission); undetected != in_detection_.end()) {
        radio_.simulator().cancel(undetected->end);
        in_detection_.erase(undetected);
        radio_.book(*arrival.transmission, FrameOutcome::preamble_undetected);
    }
}

bool ReceiverOptions::awaits_header() const {
    return radio_.simulator().is_pending(header_end_);
}

bool ReceiverOptions::is_receiving_header() const {
    return radio_.model_.preamble_detection.frees_channel() && awaits_header() &&
           radio_.simulator().now() >= period_of(FramePart::header, locked_).start;
}

void ReceiverOptions::end_header() {
    InterferenceSum* interference = nullptr;
    if (header_survives(interference)) {
        return;
    }
    radio_.add_to_fingerprint(radio_.present_.unlock(), FrameOutcome::header_error);
    radio_.book_loss(locked_, FrameOutcome::header_error, interference);
    radio_.listener_->frame_corrupted({.header_lost = true});
    ignores_energy_ = radio_.model_.preamble_detection.frees_channel() && !began_in_header_;
    radio_.update_busy();
}

bool ReceiverOptions::header_survives(InterferenceSum*& interference) {
    interference = &radio_.interference_in(locked_, period_of(FramePart::header, locked_));
    return radio_.draw() < radio_.model_.reception.success(FramePart::header, locked_, *interference);
}

FrameOutcome ReceiverOptions::decide_data(const Arrival& arrival, InterferenceSum*& cause) {
    if (radio_.simulator().cancel(header_end_)) {  // the frame ends with its header
        if (!header_survives(cause)) {
            return FrameOutcome::header_error;
        }
        cause = nullptr;
    }
    const double draw = radio_.draw();
    const Period period = period_of(FramePart::data, arrival);
    InterferenceSum& interference = radio_.interference_in(arrival, period);
    const ReceptionModel& reception = radio_.model_.reception;
    if (draw < reception.success(FramePart::data, arrival, interference)) {
        return FrameOutcome::delivered;
    }
    InterferenceSum systems;
    systems.begin(period.start, period.end);
    radio_.medium().other_systems().add_to(systems, radio_.stream_, period.start, period.end);
    if (draw < reception.success(FramePart::data, arrival, systems)) {
        cause = &interference;
        return FrameOutcome::interference;
    }
    return FrameOutcome::noise;
}

}  // namespace netsim
