// A medium and its context, for tests of single radios and stations without a Network.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "netsim/mac/dcf.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/medium.hpp"
#include "netsim/phy/radio.hpp"
#include "support/radio_log.hpp"

namespace netsim::test {

constexpr SimTime us(std::int64_t microseconds) {
    return SimTime::from_us(microseconds);
}

// The distance that light covers in a microsecond, so that propagation takes exactly that long.
inline constexpr double light_microsecond_m = 299.792458;

inline RadioConfig radio_of_power(double tx_power_w) {
    RadioConfig config;
    config.tx_power_w = tx_power_w;
    return config;
}

// The transmission power that arrives as `received_w` over free space at 2.412 GHz.
inline double power_for(double received_w, double distance_m) {
    return received_w / make_path_loss(MediumConfig()).gain(distance_m, RadioConfig().carrier_hz);
}

// A reception of a frame at one place.
struct Heard {
    SimTime start;
    SimTime end;
    FrameKind kind;
    NodeId sender;
    double power_w;
};

// Receives every frame of its band at its place and records the instants. It does not transmit or
// interfere.
class Sniffer final : public MediumListener {
public:
    explicit Sniffer(Position place) : trajectory(place) {}

    Trajectory trajectory;
    std::vector<Heard> heard;  // by end

    void arrival_started(const Arrival&) override {}
    void arrival_ended(const Arrival& arrival) override {
        const Transmission& transmission = *arrival.transmission;
        heard.push_back(
            {arrival.start, arrival.end, transmission.label.kind, transmission.sender.node, arrival.power_w});
    }
};

inline std::shared_ptr<const RadioModel> model_of(const RadioConfig& config, Medium& medium,
                                                  std::uint64_t seed) {
    return std::make_shared<const RadioModel>(config, medium, seed);
}

// A radio without a MAC.
struct BareRadio {
    BareRadio(Simulator& simulator, Medium& medium, InterfaceId interface, const RadioConfig& config,
              Position place, std::uint64_t seed)
        : trajectory(place),
          radio(interface, model_of(config, medium, seed), config.tx_power_w, trajectory),
          log(simulator) {
        radio.set_listener(log);
    }

    NodeId id() const { return radio.node(); }
    // Broadcasts a frame of the slowest OFDM mode.
    void send(SimTime duration, int psdu_bytes = 100) { send(duration, FrameLabel(), psdu_bytes); }
    void send(SimTime duration, FrameLabel label, int psdu_bytes = 100) {
        Frame frame;
        frame.kind = label.kind;
        frame.transmitter = id();
        frame.receiver = label.destination;
        frame.payload = std::make_shared<const std::string>();
        radio.transmit(std::make_shared<const Frame>(std::move(frame)), label, psdu_bytes,
                       mode_set("a").slowest_mandatory(), duration);
    }
    // An RTS or CTS, in the mode that g has for it by default.
    void send_control(FrameKind kind, NodeId receiver, SimTime duration_field) {
        const Mode& mode = mode_set("g(mixed)").fastest_mandatory();
        Frame frame;
        frame.kind = kind;
        frame.transmitter = id();
        frame.receiver = receiver;
        frame.psdu_bytes = kind == FrameKind::rts ? rts_bytes : cts_bytes;
        frame.duration_field = duration_field;
        const FrameLabel label{kind, receiver};
        const int psdu_bytes = frame.psdu_bytes;
        radio.transmit(std::make_shared<const Frame>(std::move(frame)), label, psdu_bytes, mode,
                       mode.duration(psdu_bytes));
    }

    Trajectory trajectory;
    Radio radio;
    RadioLog log;
};

struct Received {
    SimTime time;
    NodeId source;
    std::string text;
};

// A radio with a MAC.
struct Station final : NetworkInterfaceListener {
    Station(Simulator& simulator_, Medium& medium, InterfaceId interface, const RadioConfig& radio_config,
            const MacConfig& mac_config, Position place, std::uint64_t seed)
        : simulator(simulator_),
          trajectory(place),
          radio(interface, model_of(radio_config, medium, seed), radio_config.tx_power_w, trajectory),
          dcf(radio, std::make_shared<const DcfParameters>(simulator_, mac_config), seed) {
        dcf.set_listener(this);
    }

    NodeId id() const { return radio.node(); }
    void send(NodeId destination, const std::string& text) {
        dcf.send(destination, std::make_shared<const std::string>(text), 0);
    }
    void send(NodeId destination, int bytes) {
        send(destination, std::string(static_cast<std::size_t>(bytes), 'x'));
    }
    std::vector<std::string> texts() const {
        std::vector<std::string> all;
        for (const Received& message : received) {
            all.push_back(message.text);
        }
        return all;
    }

    void message_received(const Frame& frame) override {
        received.push_back({simulator.now(), frame.transmitter, *frame.payload});
    }

    Simulator& simulator;
    Trajectory trajectory;
    Radio radio;
    Dcf dcf;
    std::vector<Received> received;
};

class Air {
public:
    explicit Air(const MediumConfig& config = MediumConfig(), Culling culling = Culling::enabled,
                 std::uint64_t seed = 1)
        : medium(simulator, config, frame_outcomes, fingerprint, culling, seed), seed_(seed) {}

    // The first interface of another node.
    InterfaceId next_node() {
        frame_outcomes.add_node();
        return InterfaceId{node_count_++, 0};
    }
    BareRadio& add_radio(Position place, const RadioConfig& config = RadioConfig()) {
        return radios_.emplace_back(simulator, medium, next_node(), config, place, seed_);
    }
    // The channel has always been idle: the first frame is sent at once.
    Station& add_station(Position place, MacConfig mac = MacConfig(),
                         const RadioConfig& radio = RadioConfig()) {
        mac.initial_channel_busy = false;
        return stations_.emplace_back(simulator, medium, next_node(), radio, mac, place, seed_);
    }
    Sniffer& add_sniffer(Position place, const RadioConfig& radio = RadioConfig()) {
        Sniffer& sniffer = sniffers_.emplace_back(place);
        medium.attach(
            next_node(),
            Receiver{&sniffer, &sniffer.trajectory, {.band = {radio.carrier_hz, radio.bandwidth_hz}}});
        return sniffer;
    }

    void at(SimTime time, std::function<void()> what) {
        std::function<void()>* kept = &scheduled_.emplace_back(std::move(what));
        simulator.schedule_at(time, [kept] { (*kept)(); });
    }
    void run(SimTime limit = SimTime::from_seconds(100)) { simulator.run_until(limit); }

    std::uint64_t frame_count(FrameKind kind, FrameOutcome outcome, bool overheard = false) const {
        return frame_outcomes.counts(kind, overheard)[static_cast<std::size_t>(outcome)];
    }
    std::uint64_t broadcast_count_at(const BareRadio& receiver, FrameOutcome outcome) const {
        return frame_outcomes.counts_at(receiver.id(),
                                        FrameKind::broadcast)[static_cast<std::size_t>(outcome)];
    }
    // For all stations.
    std::uint64_t message_count(MessageKind kind, MessageOutcome outcome) const {
        MessageOutcomeSums sums;
        for (const Station& station : stations_) {
            sums.add(station.dcf.message_outcomes());
        }
        return sums.counts(kind)[static_cast<std::size_t>(outcome)];
    }

    Simulator simulator;
    FrameOutcomes frame_outcomes;
    Fingerprint fingerprint;
    Medium medium;

private:
    std::uint64_t seed_;
    NodeId node_count_ = 0;
    std::deque<BareRadio> radios_;
    std::deque<Station> stations_;
    std::deque<Sniffer> sniffers_;
    std::deque<std::function<void()>> scheduled_;
};

}  // namespace netsim::test
