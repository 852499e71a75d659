#include "netsim/phy/radio.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/phy/receiver_options.hpp"

// GCC warns of offsetof in classes with virtual functions, but computes it.
#pragma GCC diagnostic ignored "-Winvalid-offsetof"

namespace netsim {

Radio::Radio(InterfaceId interface, std::shared_ptr<const RadioModel> model, double tx_power_w,
             const Trajectory& trajectory, const Attitude& attitude, PpduFormats formats)
    : has_options_(ReceiverOptions::are_on(*model)),
      stream_(interface.stream()),
      model_(*model),
      tx_power_w_(tx_power_w),
      owned_model_(std::move(model)),
      options_(has_options_ ? std::make_unique<ReceiverOptions>(*this) : nullptr) {
    id_ = medium().attach(interface,
                          Receiver{this,
                                   &trajectory,
                                   {model_.band, model_.sensitivity_w, model_.energy_detection_w,
                                    model_.reception.noise_w, model_.preamble_detection.duration(), formats}},
                          MountedAntenna{model_.antenna.get(), attitude, model_.antenna_offset});
    // The compiler uses the padding of present_.
    static_assert(offsetof(Radio, id_) == cache_line_bytes);
}

Radio::~Radio() = default;

bool Radio::is_receiving_data() const {
    return is_receiving() && !(has_options_ && options_->awaits_header());
}

void Radio::transmit(std::shared_ptr<const Frame> frame, FrameLabel label, int psdu_bytes, const Mode& mode,
                     SimTime duration) {
    NETSIM_ASSERT(!transmitting_);
    give_up_reception();
    transmitting_ = true;
    turned_ = false;
    stop_watching_energy();  // while it transmits, its channel is busy anyway
    Transmission transmission;
    transmission.sender = interface();
    transmission.radio = id_;
    transmission.duration = duration;
    transmission.power_w = model_.tx_power_w(mode, tx_power_w_);
    transmission.band = model_.band;
    transmission.label = label;
    transmission.psdu_bytes = psdu_bytes;
    transmission.format = mode.format;
    transmission.mode = &mode;
    transmission.frame = std::move(frame);
    if (is_observed_) {
        transmission.start = simulator().now();
        observer_->transmitted(transmission);
    }
    medium().transmit(std::move(transmission));
    simulator().schedule_after(duration, [this] { transmission_over(); });
    update_busy();
}

void Radio::turn_to_transmit() {
    NETSIM_ASSERT(!transmitting_);
    give_up_reception();
    turned_ = true;
}

void Radio::give_up_reception() {
    if (has_options_) {
        options_->give_up(FrameOutcome::receiver_transmitting);
    }
    if (present_.is_locked()) {
        book(present_.unlock(), FrameOutcome::receiver_transmitting);
    }
}

void Radio::transmission_over() {
    listener_->transmission_ended();
    if (watches_channel()) {  // before its channel could be found free
        watch_energy(simulator().now());
    }
    transmitting_ = false;
    update_busy();
}

void Radio::arrival_started(const Arrival& arrival) {
    present_.add({arrival.transmission, arrival.power_w});
    if (arrival.lockable) {
        if (transmitting_ || turned_) {
            if (has_options_) {
                options_->missed_a_frame();
            }
            book(*arrival.transmission, FrameOutcome::receiver_transmitting);
        } else if (!present_.is_locked()) {
            begin_reception(arrival);
        } else if (!has_options_ || !options_->captures(arrival)) {
            book(*arrival.transmission, FrameOutcome::receiver_locked);
        }
    }
    update_busy();
}

void Radio::begin_reception(const Arrival& arrival) {
    if (has_options_) {
        options_->begin_reception(arrival);
    } else {
        present_.lock_on(arrival.transmission);
    }
}

void Radio::arrival_ended(const Arrival& arrival) {
    if (present_.locked() == arrival.transmission) {
        present_.unlock();
        present_.remove(arrival.transmission);
        reports_ = true;
        try {
            end_reception(arrival);
        } catch (...) {  // thrown by a protocol: still update the channel state
            end_report();
            throw;
        }
        end_report();
        return;
    }
    present_.remove(arrival.transmission);
    if (has_options_) {
        options_->arrival_ended(arrival);
    }
    update_busy();
}

void Radio::end_report() {
    reports_ = false;
    update_busy();
}

void Radio::end_reception(const Arrival& arrival) {
    const Transmission& transmission = *arrival.transmission;
    InterferenceSum* interference = nullptr;
    const FrameOutcome outcome =
        model_.by_chunks ? options_->decide_data(arrival, interference) : decide(arrival, interference);
    const bool decoded = outcome == FrameOutcome::delivered;
    add_to_fingerprint(transmission, outcome);
    if (is_observed_) {
        observer_->received(arrival, model_.reception.noise_w + other_systems_w(arrival), decoded);
    }
    if (decoded) {
        book(transmission, outcome);
        listener_->frame_received(transmission);
    } else {
        book_loss(arrival, outcome, interference);
        const double most_w = model_.reception.noise_w + medium().max_interference_w(arrival);
        listener_->frame_corrupted({.others_are_weak = most_w < model_.energy_detection_w * (1 - 1e-6)});
    }
}

// One random number decides both cases, with and without interference. A frame counts as lost to
// noise if it would be lost without interference by the same number.
FrameOutcome Radio::decide(const Arrival& arrival, InterferenceSum*& cause) {
    // In a large network, some transmission is always on the air, usually far away. Then a bound of
    // the interference suffices, usually even without drawing the number.
    const double systems_w = other_systems_w(arrival);
    const double min_success =
        model_.reception.min_success(arrival, medium().max_interference_w(arrival) + systems_w);
    if (min_success == 1) {
        ++drawn_;  // skips the number
        return FrameOutcome::delivered;
    }
    const double draw = this->draw();
    if (draw < min_success ||
        draw < model_.reception.min_success(arrival, medium().max_interference_w(id_, arrival) + systems_w)) {
        return FrameOutcome::delivered;
    }
    listener_->prefetch_for_corrupted_frame();  // meanwhile, the sum is computed
    medium().outcomes().prefetch(node(), arrival.transmission->label.kind, FrameOutcome::interference);
    InterferenceSum& interference = interference_in(arrival, {arrival.start, arrival.end});
    const double interference_w = interference.worst_w();
    if (model_.reception.survives(draw, arrival, interference_w)) {
        return FrameOutcome::delivered;
    }
    if (interference_w > systems_w && model_.reception.survives(draw, arrival, systems_w)) {
        cause = &interference;
        return FrameOutcome::interference;
    }
    return FrameOutcome::noise;
}

void Radio::add_to_fingerprint(const Transmission& transmission, FrameOutcome outcome) {
    medium().fingerprint().add((transmission.id() << 8) ^ static_cast<std::uint64_t>(outcome));
    medium().fingerprint().add(std::uint64_t{stream_});
}

void Radio::book(const Transmission& transmission, FrameOutcome outcome) {
    medium().outcomes().book(node(), transmission.label, outcome);
}

void Radio::book_loss(const Arrival& arrival, FrameOutcome outcome, InterferenceSum* interference) {
    tell_loss(arrival, outcome, interference);
    const Transmission& lost = *arrival.transmission;
    if (outcome == FrameOutcome::interference) {
        medium().outcomes().book_interference(node(), lost.label, interference->interferers());
    } else {
        book(lost, outcome);
    }
}

void Radio::tell_loss(const Arrival& arrival, FrameOutcome outcome, InterferenceSum* interference) {
    const Transmission& lost = *arrival.transmission;
    FrameObserver* const observer = medium().outcomes().observer();
    if (observer == nullptr || !observer->explains(lost.sender.node, node())) {
        return;
    }
    FrameObserver::Loss loss{
        .receiver = node(),
        .power_w = arrival.power_w,
        .budget = medium().power_budget(id_, arrival),
        .noise_w = model_.reception.noise_w +
                   (interference == nullptr ? other_systems_w(arrival) : interference->worst_noise_w())};
    if (outcome == FrameOutcome::header_error) {
        loss.needed = model_.needed_header_snir(*lost.mode);
    } else if (outcome != FrameOutcome::preamble_undetected) {
        loss.needed = model_.needed_snir(*lost.mode, lost.psdu_bytes);
    } else if (arrival.power_w < model_.preamble_detection.minimum_power_w()) {
        loss.needed = model_.preamble_detection.minimum_power_w();
        loss.noise_w = 0;
    } else {
        loss.needed = model_.preamble_detection.threshold();
    }
    if (interference != nullptr && loss.noise_w > 0) {
        loss.interference_w = interference->worst_frames_w();
        for (const NodeId interferer : interference->interferers()) {
            loss.interferers.push_back({interferer, interference->worst_w_of(interferer)});
        }
    }
    observer->frame_lost(lost.id(), loss);
}

void Radio::update_busy() {
    bool busy = transmitting_ || reports_ || present_.is_locked();
    if (!busy && !present_.empty() && !(has_options_ && options_->ignores_energy())) {
        double energy_w = model_.reception.noise_w;
        busy = energy_w >= model_.energy_detection_w;
        for (const PresentArrival& present : present_.all()) {
            if (busy) {  // more arrivals cannot change that
                break;
            }
            if (!has_options_ || !options_->is_in_detection(present.transmission)) {
                energy_w += present.power_w;
                busy = energy_w >= model_.energy_detection_w;
            }
        }
    }
    if (busy != busy_) {
        busy_ = busy;
        if (!busy) {
            free_since_ = simulator().now();
        }
        if (watch_ != ChannelWatch::off) {
            listener_->channel_busy_changed(busy);
        }
    }
}

}  // namespace netsim
