// A scenario and a script of commands decoded from bytes: all models, positions, times, powers,
// ranges and payload sizes.
//
// Rejected configurations and commands are skipped. Everything else must run without a crash, no
// message may wait for nothing, and outcomes must balance. Used by the fuzzer (tests/fuzz), which
// searches for bytes that break it, and by a test with random bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>

#include "netsim/error.hpp"
#include "netsim/node/network.hpp"
#include "support/byte_reader.hpp"
#include "support/fuzzed_config.hpp"

namespace netsim::test {

class FuzzedScenario {
public:
    explicit FuzzedScenario(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    // Return the error, or "". Crashes if the engine does.
    std::string run() {
        try {
            const MediumConfig medium = configs_.medium();
            Network network(medium, bytes_.byte());
            add_nodes(network);
            network.initialize();
            follow_script(network);
            const std::string_view unrest = is_done_ ? come_to_rest(network) : "";
            network.finish();
            return unrest.empty() ? imbalance(network) : std::string(unrest);
        } catch (const ConfigError&) {
            return "";
        }
    }

private:
    static constexpr std::uint64_t max_events = 20'000;
    static constexpr int max_commands = 60;
    static constexpr double longest_wait_s = 1.1e6;  // 2^20 backoff periods of a second, plus a margin

    void add_nodes(Network& network) {
        for (std::uint32_t count = 1 + bytes_.below(6); count > 0; --count) {
            try {
                network.add_node(configs_.node());
            } catch (const ConfigError&) {  // the others may be valid
            }
        }
    }

    void follow_script(Network& network) {
        SimTime now;
        for (int command = 0; command < max_commands && !bytes_.empty(); ++command) {
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
                    if (!network.run_until(now, max_events)) {
                        return;
                    }
                }
            }
        }
        is_done_ = true;
    }

    // Run until everything has ended. A message that waits for nothing is an error; very slow ones
    // need not end.
    std::string_view come_to_rest(Network& network) {
        if (!run_for(network, 100)) {
            return "";
        }
        if (waiting_messages(network) > 0) {
            const std::uint64_t events = network.event_count();
            if (!run_for(network, longest_wait_s)) {
                return "";
            }
            if (network.event_count() == events) {
                return "messages wait for nothing";
            }
        }
        // A frame and its response, over the largest distance, with the longest intervals.
        is_at_rest_ =
            waiting_messages(network) == 0 && run_for(network, 10) && waiting_messages(network) == 0;
        return "";
    }

    static bool run_for(Network& network, double seconds) {
        return network.run_until(network.now() + SimTime::from_seconds(seconds), max_events);
    }

    static std::uint64_t waiting_messages(Network& network) {
        std::uint64_t count = 0;
        for (NodeId id = 0; id < network.node_count(); ++id) {
            for (const auto& interface : network.node(id).interfaces()) {
                count += interface->queued_messages();
            }
        }
        return count;
    }

    void act(Node& node) {
        switch (bytes_.below(7)) {
            case 0:
                return node.broadcast(text(), interface());
            case 1:
            case 2:
                return node.send(bytes_.integer(bytes_.byte() % 6), text(), interface());
            case 3:
                return node.go_to(configs_.position());
            case 4:
                return node.set_speed(bytes_.number(10));
            case 5:
                return node.schedule_timer(bytes_.flag() ? "a" : "b",
                                           node.now() + SimTime::from_us(bytes_.byte()));
            default:
                return node.cancel_timer(bytes_.flag() ? "a" : "b");
        }
    }

    std::int32_t interface() { return bytes_.flag() ? 0 : static_cast<std::int32_t>(bytes_.below(4)); }

    Payload text() { return std::make_shared<const std::string>(bytes_.below(70'000), 'x'); }

    // Every message has an outcome or waits in a queue. With nothing on the air, every reception has
    // an outcome, too.
    std::string imbalance(Network& network) const {
        for (std::size_t index = 0; is_at_rest_ && index < frame_kind_count; ++index) {
            for (const bool overheard : {false, true}) {
                const auto kind = static_cast<FrameKind>(index);
                const FrameOutcomes::Counts counts = network.frame_outcomes().counts(kind, overheard);
                if (counts[static_cast<std::size_t>(FrameOutcome::in_air)] != 0 ||
                    std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) !=
                        network.frame_outcomes().copies(kind, overheard)) {
                    return std::string("copies of ") + frame_kind_names[index];
                }
            }
        }
        std::uint64_t queued = 0;
        for (const MessageKind kind : {MessageKind::broadcast, MessageKind::unicast}) {
            const MessageOutcomes::Counts counts = network.message_outcomes().counts(kind);
            queued += counts[static_cast<std::size_t>(MessageOutcome::queued)];
            if (std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) !=
                network.message_outcomes().accepted(kind)) {
                return std::string("messages: ") + message_kind_names[static_cast<std::size_t>(kind)];
            }
        }
        return queued == waiting_messages(network) ? "" : "messages that wait";
    }

    ByteReader bytes_;
    FuzzedConfig configs_{bytes_};
    bool is_done_ = false;     // the script has ended, within its limit of events
    bool is_at_rest_ = false;  // and so has everything that it started
};

}  // namespace netsim::test
