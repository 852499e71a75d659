#include "netsim/mac/ideal_interface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "netsim/error.hpp"
#include "netsim/propagation/transmission.hpp"
#include "netsim/units.hpp"

namespace netsim {

namespace {

Links& links_of(IdealChannel& channel) {
    NETSIM_ASSERT(channel.links.has_value());
    return *channel.links;
}

}  // namespace

IdealInterface::IdealInterface(Simulator& simulator, IdealChannel& channel, InterfaceId interface,
                               double range_m, std::optional<IdealRadio> radio, IdealTiming timing,
                               const Trajectory& trajectory, FrameOutcomes& frame_outcomes,
                               Fingerprint& fingerprint, std::uint64_t seed)
    : simulator_(simulator),
      channel_(channel),
      range_m_(range_m),
      radio_(std::move(radio)),
      timing_(timing),
      trajectory_(trajectory),
      frame_outcomes_(frame_outcomes),
      fingerprint_(fingerprint),
      seed_(seed),
      id_(interface.node),
      stream_(interface.stream()),
      delays_(seed, stream_, Purpose::backoff) {
    if (interface.index == 0) {
        NETSIM_ASSERT(interface.node == static_cast<NodeId>(channel.interfaces.size()));
        channel.interfaces.push_back(this);
    }
    if (radio_) {
        const RadioModel& model = *radio_->model;
        radio_id_ = links_of(channel).add(
            interface,
            Receiver{nullptr,
                     &trajectory,
                     {model.band, model.sensitivity_w, model.energy_detection_w, model.reception.noise_w,
                      model.preamble_detection.duration(), radio_->formats}},
            MountedAntenna{model.antenna.get(), radio_->attitude, model.antenna_offset}, simulator.now());
        channel.by_radio.push_back(this);
    }
}

void IdealInterface::send(NodeId destination, Payload payload, CauseId cause) {
    if (timing_.is_instant() && sent_.exceeds(simulator_.now())) {
        throw SimulationError("node " + std::to_string(id_) + " has sent " + std::to_string(max_per_instant) +
                              " messages at " + std::to_string(simulator_.now().seconds()) +
                              " s on a medium without delay: time stands still; expected answers that end");
    }
    const int psdu_bytes = timing_.psdu_bytes(static_cast<int>(payload->size()));
    auto frame = std::make_shared<const Frame>(
        Frame{.kind = destination == broadcast_id ? FrameKind::broadcast : FrameKind::unicast,
              .transmitter = id_,
              .receiver = destination,
              .psdu_bytes = psdu_bytes,
              .payload = std::move(payload),
              .cause = cause,
              .accepted = simulator_.now()});
    const MessageKind kind = message_kind(*frame);
    message_outcomes_.accept(kind);
    if (!timing_.has_queue()) {
        ++on_air_;
        transmit(exchanges_.add({.frame = frame}));
    } else if (is_full() && !timing_.blocks()) {
        message_outcomes_.book(kind, MessageOutcome::queue_overflow);
        report_failure(*frame, MessageOutcome::queue_overflow);
    } else {
        queue_.push(std::move(frame));
        if (has_one_in_front()) {
            report_blocking(true);
        }
        wait_for_channel();
    }
}

bool IdealInterface::is_full() const {
    return timing_.senses_channel() && queue_.size() >= static_cast<std::size_t>(timing_.queue_capacity());
}

bool IdealInterface::has_one_in_front() const {
    return timing_.senses_channel() && timing_.blocks() &&
           queue_.size() == static_cast<std::size_t>(timing_.queue_capacity()) + 1;
}

void IdealInterface::wait_for_channel() {
    if (waits_ || queue_.empty()) {
        return;
    }
    waits_ = true;
    simulator_.schedule_at(std::max(free_at(), simulator_.now()), [this] { access_channel(); });
}

void IdealInterface::access_channel() {
    waits_ = false;
    if (free_at() > simulator_.now()) {
        wait_for_channel();
        return;
    }
    const std::shared_ptr<const Frame> frame = queue_.front();
    if (has_one_in_front()) {
        report_blocking(false);
    }
    queue_.pop();
    ++on_air_;
    transmit(exchanges_.add({.frame = frame}));
    // In two events, so that senders that start waiting during this transmission come first.
    if (!queue_.empty()) {
        waits_ = true;
        simulator_.schedule_at(free_at(), [this] {
            waits_ = false;
            wait_for_channel();
        });
    }
}

Transmission IdealInterface::transmission_of(const std::shared_ptr<const Frame>& frame, SimTime airtime) {
    Transmission sent;
    sent.start = simulator_.now();
    sent.duration = airtime;
    sent.sender = {id_, 0};
    sent.label = {frame->kind, frame->receiver, channel_.frame_count++};
    sent.frame = frame;
    if (!timing_.is_instant() || radio_) {
        const Mode& mode = timing_.mode(frame->kind);
        sent.psdu_bytes = frame->psdu_bytes;
        sent.mode = &mode;
        sent.format = mode.format;
    }
    if (radio_) {
        sent.sender = InterfaceId::of_stream(stream_);
        sent.origin = trajectory_.position_at(sent.start);
        sent.power_w = radio_->model->tx_power_w(timing_.mode(frame->kind), radio_->tx_power_w);
        sent.band = radio_->model->band;
        sent.radio = radio_id_;
    }
    return sent;
}

IdealInterface::Reach IdealInterface::reach_at(const IdealInterface& first_of_node,
                                               const Transmission& sent) const {
    Reach reach;
    double distance_m = 0;
    if (radio_) {
        const Links& links = links_of(channel_);
        const RadioId radio = links.decoder_at(first_of_node.id_, sent);
        if (radio < 0) {
            return reach;
        }
        reach.receiver = channel_.by_radio[radio];
        const Position place = links.position(radio, sent.start);
        reach.arrival = links.arrival(sent, 1, radio, place);
        reach.is_heard = reach.arrival.lockable;
        reach.occupies = reach.is_heard || links.receiver(radio).exceeds_ed(reach.arrival.power_w);
        distance_m = distance(sent.origin, place);
    } else {
        // Squared, as in prototype mode: with rounded square roots, nodes exactly at the range would differ.
        const double squared_m2 = squared_distance(first_of_node.trajectory_.position_at(sent.start),
                                                   trajectory_.position_at(sent.start));
        reach.receiver = channel_.interfaces[first_of_node.id_];
        reach.is_heard = squared_m2 <= range_m_ * range_m_;
        reach.occupies = reach.is_heard;
        distance_m = std::sqrt(squared_m2);
    }
    if (!timing_.is_instant()) {
        reach.delay = SimTime::from_seconds(distance_m / speed_of_light_mps);
    }
    reach.arrival.start = sent.start + reach.delay;
    reach.arrival.end = reach.arrival.start + sent.duration;
    return reach;
}

void IdealInterface::transmit(std::size_t exchange) {
    const std::shared_ptr<const Frame> frame = exchanges_[exchange].frame;
    const SimTime airtime = timing_.airtime(frame->kind, frame->psdu_bytes);
    const SimTime occupied = airtime + timing_.response(frame->kind);
    const auto sent = std::make_shared<const Transmission>(transmission_of(frame, airtime));
    const FrameLabel& label = sent->label;
    fingerprint_.add(static_cast<std::uint64_t>(simulator_.now().ps()));
    fingerprint_.add(static_cast<std::uint64_t>(id_));
    ++exchanges_[exchange].attempts;
    if (timing_.has_queue()) {
        free_at() = std::max(free_at(), simulator_.now() + occupied + timing_.gap());
    }
    if (timing_.collides()) {
        channel_.longest_airtime = std::max(channel_.longest_airtime, airtime);
        add_stretch(shared_channel().own_, {sent->start, sent->start + airtime, 0, id_, label.number});
    }
    FrameObserver* const observer = frame_outcomes_.observer();
    std::vector<FrameObserver::Loss> missed;
    CopyCount addressed;
    SimTime last_end = simulator_.now();
    for (IdealInterface* const node : channel_.interfaces) {
        const bool is_addressed = node->id_ != id_ && label.is_for(node->id_);
        if (node->id_ == id_ || (!is_addressed && !timing_.has_queue())) {
            continue;
        }
        const Reach reach = reach_at(*node, *sent);
        if (reach.receiver == nullptr) {
            continue;
        }
        if (timing_.senses_channel() && reach.occupies) {
            node->free_at_ = std::max(node->free_at_, simulator_.now() + occupied + timing_.gap());
        }
        if (timing_.collides() && (radio_ || reach.is_heard)) {
            add_stretch(reach.receiver->arrived_,
                        {reach.arrival.start, reach.arrival.end, reach.arrival.power_w, id_, label.number});
        }
        if (!is_addressed) {
            continue;
        }
        ++addressed.made;
        if (!reach.is_heard) {
            ++addressed.too_weak;
            if (radio_ && observer != nullptr && observer->explains(id_, node->id_)) {
                add_missed(*sent, *reach.receiver, reach.arrival.place, missed);
            }
            continue;
        }
        const std::size_t flight = flights_.add({exchange, sent, reach.receiver, reach.arrival});
        last_end = std::max(last_end, reach.arrival.end);
        simulator_.schedule_at(reach.arrival.end, [this, flight] { deliver(flight); });
    }
    exchanges_[exchange].is_heard = addressed.made > addressed.too_weak;
    if (observer != nullptr) {
        observer->frame_begins(*sent, addressed.made - addressed.too_weak, addressed.too_weak, missed);
    }
    frame_outcomes_.book_transmission(label, addressed, CopyCount{});
    if (timing_.is_instant() && !radio_) {
        exchanges_[exchange].is_received = exchanges_[exchange].is_heard;
        end_exchange(exchange);
    } else {
        simulator_.schedule_at(std::max(simulator_.now() + occupied, last_end),
                               [this, exchange] { end_exchange(exchange); });
    }
}

void IdealInterface::add_missed(const Transmission& sent, const IdealInterface& receiver,
                                const Position& place, std::vector<FrameObserver::Loss>& missed) const {
    const Links& links = links_of(channel_);
    const RadioId radio = receiver.radio_id_;
    if (sent.label.destination == receiver.id_ || links.is_in_steady_reach(sent, radio, place)) {
        if (auto loss = links.below_sensitivity(sent, radio, place)) {
            missed.push_back(std::move(*loss));
        }
    }
}

void IdealInterface::end_exchange(std::size_t number) {
    const Exchange& exchange = exchanges_[number];
    const MessageKind kind = message_kind(*exchange.frame);
    MessageOutcome outcome = MessageOutcome::sent;
    if (exchange.frame->kind != FrameKind::broadcast) {
        outcome = exchange.is_received ? MessageOutcome::acknowledged : MessageOutcome::out_of_range;
        if (exchange.is_heard && !exchange.is_received) {
            if (exchange.attempts < timing_.most_attempts()) {
                SimTime delay;
                if (timing_.collides()) {
                    const double most = std::ldexp(1, std::min(exchange.attempts, 10));
                    delay = SimTime::from_seconds(
                        delays_.uniform(0, most) *
                        timing_.airtime(exchange.frame->kind, exchange.frame->psdu_bytes).seconds());
                }
                simulator_.schedule_after(delay, [this, number] { transmit(number); });
                return;
            }
            outcome = MessageOutcome::retry_limit;
        }
    }
    const bool has_failed = outcome == MessageOutcome::out_of_range || outcome == MessageOutcome::retry_limit;
    const std::shared_ptr<const Frame> failed = has_failed ? exchange.frame : nullptr;
    exchanges_.take(number);
    --on_air_;
    message_outcomes_.book(kind, outcome);
    if (failed) {
        report_failure(*failed, outcome);
    }
}

void IdealInterface::add_stretch(std::vector<Stretch>& stretches, const Stretch& added) const {
    constexpr SimTime longest_way = SimTime::from_us(10'000);
    const SimTime oldest = simulator_.now() - channel_.longest_airtime * 2 - longest_way;
    std::erase_if(stretches, [oldest](const Stretch& other) { return other.end < oldest; });
    stretches.push_back(added);
}

// Called at the receiver.
FrameOutcome IdealInterface::outcome_of(const Flight& flight) {
    const auto overlaps = [&flight](const Stretch& other) {
        return other.number != flight.sent->label.number && other.start < flight.arrival.end &&
               other.end > flight.arrival.start;
    };
    double interference_w = 0;
    std::vector<FrameObserver::Interferer> interferers;
    if (timing_.collides()) {
        if (std::ranges::any_of(shared_channel().own_, overlaps)) {
            return FrameOutcome::receiver_transmitting;
        }
        std::vector<Stretch> others;
        std::ranges::copy_if(arrived_, std::back_inserter(others), overlaps);
        // The sum changes only when a frame begins.
        for (const Stretch& at : others) {
            const SimTime time = std::max(at.start, flight.arrival.start);
            double sum_w = 0;
            for (const Stretch& other : others) {
                sum_w += other.start <= time && other.end > time ? other.power_w : 0;
            }
            interference_w = std::max(interference_w, sum_w);
            if (std::ranges::find(interferers, at.sender, &FrameObserver::Interferer::node) ==
                interferers.end()) {
                interferers.push_back({at.sender, at.power_w});
            }
        }
    }
    FrameOutcome outcome = FrameOutcome::delivered;
    if (!radio_) {
        outcome = interferers.empty() ? FrameOutcome::delivered : FrameOutcome::interference;
    } else {
        const ReceptionModel& reception = radio_->model->reception;
        const PreambleDetection& preamble = radio_->model->preamble_detection;
        const double systems_w = other_systems_w(flight.arrival);
        const double disturbance_w = interference_w + systems_w;
        if (preamble.is_on() &&
            !preamble.detects(flight.arrival.power_w, reception.snir(flight.arrival, disturbance_w))) {
            return FrameOutcome::preamble_undetected;
        }
        Arrival arrival = flight.arrival;
        arrival.transmission = flight.sent.get();
        if (const double draw = this->draw(); !reception.survives(draw, arrival, disturbance_w)) {
            const bool is_collision = interference_w > 0 && reception.survives(draw, arrival, systems_w);
            outcome = is_collision ? FrameOutcome::interference : FrameOutcome::noise;
        }
    }
    if (outcome != FrameOutcome::delivered) {
        if (outcome == FrameOutcome::noise) {
            interferers.clear();
        }
        book_loss(flight, outcome, interference_w, interferers);
    }
    return outcome;
}

void IdealInterface::book_loss(const Flight& flight, FrameOutcome outcome, double interference_w,
                               std::span<const FrameObserver::Interferer> interferers) {
    const Transmission& sent = *flight.sent;
    if (FrameObserver* const observer = frame_outcomes_.observer();
        observer != nullptr && observer->explains(sent.sender.node, id_)) {
        FrameObserver::Loss loss{.receiver = id_,
                                 .power_w = flight.arrival.power_w,
                                 .interference_w = outcome == FrameOutcome::noise ? 0 : interference_w,
                                 .interferers = {interferers.begin(), interferers.end()}};
        if (radio_) {
            loss.budget = links_of(channel_).power_budget(sent, radio_id_, flight.arrival.place);
            loss.needed = radio_->model->needed_snir(*sent.mode, sent.psdu_bytes);
            loss.noise_w = radio_->model->reception.noise_w + other_systems_w(flight.arrival);
        }
        observer->frame_lost(sent.id(), loss);
    }
    if (outcome == FrameOutcome::interference) {
        std::vector<NodeId> nodes;
        for (const FrameObserver::Interferer& interferer : interferers) {
            nodes.push_back(interferer.node);
        }
        frame_outcomes_.book_interference(id_, sent.label, nodes);
    }
}

void IdealInterface::deliver(std::size_t flight) {
    const Flight landed = flights_.take(flight);
    IdealInterface& receiver = *landed.receiver;
    const FrameOutcome outcome = receiver.outcome_of(landed);
    if (outcome != FrameOutcome::interference) {
        frame_outcomes_.book(receiver.id_, landed.sent->label, outcome);
    }
    if (outcome != FrameOutcome::delivered) {
        return;
    }
    exchanges_[landed.exchange].is_received = true;
    receiver.pass_on_message(*landed.sent->frame);
}

}  // namespace netsim
