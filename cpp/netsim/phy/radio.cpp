#include "netsim/phy/radio.hpp"

#include <algorithm>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/phy/antenna.hpp"

namespace netsim {

Radio::Radio(Simulator& simulator, Medium& medium, const RadioConfig& config, const Trajectory& trajectory,
             std::uint64_t seed, FrameFates& fates, Fingerprint& fingerprint, const Attitude& attitude)
    : simulator_(simulator),
      medium_(medium),
      config_(config),
      error_model_(error_model(config.error_model)),
      antenna_(make_antenna(config.antenna, config.carrier_hz)),
      fates_(fates),
      fingerprint_(fingerprint),
      id_(medium.attach(
          Receiver{this, &trajectory, Band{config.carrier_hz, config.bandwidth_hz}, config.sensitivity_w,
                   config.energy_detection_w,
                   MountedAntenna{antenna_.get(), attitude, Orientation(config.antenna.offset)}})),
      reception_draws_(seed, static_cast<std::uint32_t>(id_), Purpose::reception) {}

void Radio::transmit(std::shared_ptr<const Frame> frame, FrameLabel label, int psdu_bytes, const Mode& mode,
                     SimTime duration) {
    NETSIM_ASSERT(!transmitting_);
    give_up_reception();
    transmitting_ = true;
    turned_ = false;
    Transmission transmission;
    transmission.sender = id_;
    transmission.duration = duration;
    transmission.power_w = config_.tx_power_w;
    transmission.band = Band{config_.carrier_hz, config_.bandwidth_hz};
    transmission.label = label;
    transmission.psdu_bytes = psdu_bytes;
    transmission.mode = &mode;
    transmission.frame = std::move(frame);
    if (observer_ != nullptr) {
        transmission.start = simulator_.now();
        observer_->transmitted(transmission);
    }
    medium_.transmit(std::move(transmission));
    simulator_.schedule_after(duration, [this] { transmission_over(); });
    update_busy();
}

void Radio::turn_to_transmit() {
    NETSIM_ASSERT(!transmitting_);
    give_up_reception();
    turned_ = true;
}

void Radio::give_up_reception() {
    if (locked_ != nullptr) {
        book(*std::exchange(locked_, nullptr), FrameFate::receiver_transmitting);
    }
}

void Radio::transmission_over() {
    transmitting_ = false;
    listener_->transmission_ended();
    update_busy();
}

void Radio::arrival_started(const Arrival& arrival) {
    present_.push_back(Present{arrival.transmission, arrival.power_w});
    if (arrival.power_w >= config_.sensitivity_w) {
        if (transmitting_ || turned_) {
            book(*arrival.transmission, FrameFate::receiver_transmitting);
        } else if (locked_ != nullptr) {
            book(*arrival.transmission, FrameFate::receiver_locked);
        } else {
            locked_ = arrival.transmission;
        }
    }
    update_busy();
}

void Radio::arrival_ended(const Arrival& arrival) {
    const auto ended = std::find_if(present_.begin(), present_.end(), [&arrival](const Present& present) {
        return present.transmission == arrival.transmission;
    });
    NETSIM_ASSERT(ended != present_.end());
    present_.erase(ended);
    if (locked_ == arrival.transmission) {
        locked_ = nullptr;
        const Interference& interference = medium_.interference_with(id_, arrival).worst();
        FrameFate fate = FrameFate::delivered;
        const bool decoded = decide(arrival, interference, fate);
        if (observer_ != nullptr) {
            observer_->received(arrival, medium_.background_noise_w(), decoded);
        }
        if (decoded) {
            book(*arrival.transmission, fate);
            listener_->frame_received(*arrival.transmission);
        } else {
            if (fate == FrameFate::interference) {
                fates_.book_interference(id_, arrival.transmission->label, interference.interferers);
            } else {
                book(*arrival.transmission, fate);
            }
            listener_->frame_corrupted();
        }
    }
    update_busy();
}

bool Radio::decide(const Arrival& arrival, const Interference& interference, FrameFate& fate) {
    // One draw decides for both cases, with interference and without: a frame counts as lost to noise if the same
    // draw would have lost it on a channel without interference.
    const double draw = reception_draws_.uniform();
    const auto decoded_at = [&](double noise_w) {
        const double snir = arrival.power_w / noise_w;
        return snir > config_.snir_threshold &&
               draw < error_model_.success_probability(*arrival.transmission->mode, snir,
                                                       arrival.transmission->psdu_bytes);
    };
    const double noise_w = medium_.background_noise_w();
    const bool disturbed = interference.max_power_w > 0;
    const bool decoded = decoded_at(noise_w + interference.max_power_w);
    if (decoded) {
        fate = FrameFate::delivered;
    } else {
        fate = disturbed && decoded_at(noise_w) ? FrameFate::interference : FrameFate::noise;
    }
    fingerprint_.add((arrival.transmission->id << 8) ^ static_cast<std::uint64_t>(fate));
    fingerprint_.add(static_cast<std::uint64_t>(id_));
    return decoded;
}

void Radio::book(const Transmission& transmission, FrameFate fate) {
    fates_.book(id_, transmission.label, fate);
}

void Radio::update_busy() {
    bool busy = transmitting_ || locked_ != nullptr;
    if (!busy && !present_.empty()) {
        double energy_w = medium_.background_noise_w();
        for (const Present& present : present_) {
            energy_w += present.power_w;
        }
        busy = energy_w >= config_.energy_detection_w;
    }
    if (busy != busy_) {
        busy_ = busy;
        listener_->channel_busy_changed(busy);
    }
}

}  // namespace netsim
