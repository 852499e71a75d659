// A scenario and a script of commands read from any bytes: positions, times, powers, ranges and texts of every size.
//
// What the configurations refuse is no scenario, and what a node refuses is no command; everything else has to run
// without a crash and without end, and its ledgers have to balance when all is quiet. Used by the fuzzer
// (tests/fuzz), which searches for bytes that break it, and by a test that tries random ones.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <span>
#include <string>

#include "netsim/error.hpp"
#include "netsim/node/network.hpp"

namespace netsim::test {

// Numbers taken from bytes, zeros when they have run out.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool empty() const { return bytes_.empty(); }
    std::uint8_t byte() {
        if (bytes_.empty()) {
            return 0;
        }
        const std::uint8_t first = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return first;
    }
    bool flag() { return (byte() & 1) != 0; }
    std::uint32_t below(std::uint32_t count) {
        return (static_cast<std::uint32_t>(byte()) << 8 | byte()) % count;
    }
    // Any double there is, if the bytes say so; otherwise the usual one times a power of ten.
    double number(double usual) {
        const std::uint8_t kind = byte();
        if (kind < 128) {
            return usual;
        }
        if (kind < 240) {
            constexpr double tenth = 0.1;
            double value = usual;
            for (int power = kind % 16; power > 0; --power) {
                value *= (kind & 16) != 0 ? 1 / tenth : tenth;
            }
            return value * (1 + byte() / 256.0);
        }
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) {
            bits = bits << 8 | byte();
        }
        double value = 0;
        std::memcpy(&value, &bits, sizeof value);
        return value;
    }
    int integer(int usual) {
        constexpr double most = 1e9;
        const double value = number(usual);
        return value >= -most && value <= most ? static_cast<int>(value) : usual;
    }
    template <typename Names>
    std::string name(const Names& names) {
        return std::string(names[below(static_cast<std::uint32_t>(names.size()))]);
    }

private:
    std::span<const std::uint8_t> bytes_;
};

class FuzzedScenario {
public:
    explicit FuzzedScenario(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    // Returns what is wrong, or "". Crashes, where the engine does.
    std::string run() {
        try {
            Network network(medium_config(), bytes_.byte());
            add_nodes(network);
            network.initialize();
            follow_script(network);
            network.finish();
            return went_quiet_ ? imbalance(network) : "";
        } catch (const ConfigError&) {
            return "";
        }
    }

private:
    static constexpr std::uint64_t most_events = 20'000;
    static constexpr int most_commands = 60;

    MediumConfig medium_config() {
        MediumConfig config(bytes_.name(medium_type_names));
        if (bytes_.flag()) {
            config.path_loss = bytes_.name(path_loss_names);
        }
        config.alpha = bytes_.number(config.alpha);
        config.breakpoint_distance_m = bytes_.number(config.breakpoint_distance_m);
        config.l02_db = bytes_.number(config.l02_db);
        config.background_noise_w = bytes_.number(config.background_noise_w);
        return config;
    }

    void add_nodes(Network& network) {
        const std::uint32_t count = 1 + bytes_.below(6);
        for (std::uint32_t id = 0; id < count; ++id) {
            NodeConfig config("node");
            config.initial_position = position();
            RadioConfig& radio = config.wlan[0].radio;
            MacConfig& mac = config.wlan[0].mac;
            radio.tx_power_w = bytes_.number(radio.tx_power_w);
            radio.sensitivity_w = bytes_.number(radio.sensitivity_w);
            radio.energy_detection_w = bytes_.number(radio.energy_detection_w);
            radio.snir_threshold = bytes_.number(radio.snir_threshold);
            radio.communication_range_m = bytes_.number(radio.communication_range_m);
            if (bytes_.flag()) {
                radio.snir_mode = bytes_.name(snir_mode_names);
                radio.preamble_detection = bytes_.name(preamble_detection_names);
                radio.preamble_threshold = bytes_.number(radio.preamble_threshold);
                radio.preamble_minimum_power_w = bytes_.number(radio.preamble_minimum_power_w);
                radio.preamble_duration_s = bytes_.number(radio.preamble_duration_s);
                radio.frame_capture = bytes_.name(frame_capture_names);
                radio.capture_margin = bytes_.number(radio.capture_margin);
                radio.capture_window_s = bytes_.number(radio.capture_window_s);
                mac.skip_backoff_if_idle = bytes_.flag();
            }
            radio.carrier_hz += 5e6 * bytes_.below(3);
            mac.op_mode = bytes_.name(op_mode_names);
            mac.rts_threshold_bytes = bytes_.integer(mac.rts_threshold_bytes);
            mac.short_retry_limit = bytes_.integer(mac.short_retry_limit);
            mac.long_retry_limit = bytes_.integer(mac.long_retry_limit);
            mac.cw_min = bytes_.integer(mac.cw_min);
            mac.cw_max = bytes_.integer(mac.cw_max);
            mac.queue_capacity = bytes_.integer(mac.queue_capacity);
            mac.backoff_optimization = bytes_.flag();
            mac.own_frames_set_nav = bytes_.flag();
            while (bytes_.below(4) == 1) {
                InterfaceConfig further = config.wlan[0];
                further.radio.carrier_hz += 5e6 * bytes_.below(6);
                further.radio.bandwidth_hz = bytes_.number(further.radio.bandwidth_hz);
                config.wlan.push_back(further);
            }
            config.mobility.speed_mps = bytes_.number(config.mobility.speed_mps);
            config.mobility.telemetry_interval_s = bytes_.flag() ? bytes_.number(1) : 0;
            try {
                network.add_node(config);
            } catch (const ConfigError&) {  // the others may do
            }
        }
    }

    void follow_script(Network& network) {
        SimTime now;
        for (int command = 0; command < most_commands && !bytes_.empty(); ++command) {
            if (network.node_count() == 0) {
                return;
            }
            Node& node = network.node(static_cast<NodeId>(bytes_.below(network.node_count())));
            try {
                act(node);
            } catch (const SimulationError&) {
            }
            if (bytes_.flag()) {
                const double step_s = bytes_.number(1e-4);
                if (step_s >= 0 && step_s < 1e3) {
                    now = now + SimTime::from_seconds(step_s);
                    if (!network.run_until(now, most_events)) {
                        return;
                    }
                }
            }
        }
        went_quiet_ = network.run_until(now + SimTime::from_seconds(100), most_events);
    }

    void act(Node& node) {
        switch (bytes_.below(7)) {
            case 0:
                return node.broadcast(text(), interface());
            case 1:
            case 2:
                return node.send(bytes_.integer(bytes_.byte() % 6), text(), interface());
            case 3:
                return node.go_to(position());
            case 4:
                return node.set_speed(bytes_.number(10));
            case 5:
                return node.schedule_timer(bytes_.flag() ? "a" : "b",
                                           node.now() + SimTime::from_us(bytes_.byte()));
            default:
                return node.cancel_timer(bytes_.flag() ? "a" : "b");
        }
    }

    Position position() {
        const double x = bytes_.number(10.0 * bytes_.byte());
        const double y = bytes_.number(10.0 * bytes_.byte());
        return {x, y, bytes_.number(0)};
    }

    std::int32_t interface() { return bytes_.flag() ? 0 : static_cast<std::int32_t>(bytes_.below(4)); }

    Payload text() { return std::make_shared<const std::string>(bytes_.below(70'000), 'x'); }

    // With nothing on the air and nothing left to send, every copy and every message has met its fate.
    static std::string imbalance(const Network& network) {
        for (std::size_t index = 0; index < frame_kind_count; ++index) {
            for (const bool overheard : {false, true}) {
                const auto kind = static_cast<FrameKind>(index);
                const FrameFates::Counts counts = network.frame_fates().counts(kind, overheard);
                if (counts[static_cast<std::size_t>(FrameFate::in_air)] != 0 ||
                    std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) !=
                        network.frame_fates().copies(kind, overheard)) {
                    return std::string("copies of ") + frame_kind_names[index];
                }
            }
        }
        for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
            const MessageFates::Counts counts = network.message_fates().counts(kind);
            if (counts[static_cast<std::size_t>(MessageFate::queued)] != 0 ||
                std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) !=
                    network.message_fates().accepted(kind)) {
                return std::string("messages: ") + message_kind_names[static_cast<std::size_t>(kind)];
            }
        }
        return "";
    }

    ByteReader bytes_;
    bool went_quiet_ = false;
};

}  // namespace netsim::test
