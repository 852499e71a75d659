// A protocol that records its callbacks, and executes actions of the test.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "netsim/node/network.hpp"

namespace netsim::test {

class Recorder final : public Protocol {
public:
    struct Told {
        SimTime time;
        std::string text;

        bool operator==(const Told&) const = default;
    };

    explicit Recorder(Node& owner) : node(owner) {}

    Node& node;
    std::vector<Told> initialized, timers, packets, finished;
    std::vector<Position> telemetry;
    std::vector<SimTime> telemetry_times;
    std::function<void(Recorder&)> on_initialize, on_telemetry, on_finish;
    std::function<void(Recorder&, const std::string&)> on_timer, on_packet;

    std::vector<std::string> timer_names() const { return texts_of(timers); }
    std::vector<std::string> packet_texts() const { return texts_of(packets); }
    void broadcast(const std::string& text, std::int32_t interface = 0) {
        node.broadcast(std::make_shared<const std::string>(text), interface);
    }
    void send(NodeId destination, const std::string& text, std::int32_t interface = 0) {
        node.send(destination, std::make_shared<const std::string>(text), interface);
    }

    void initialize() override {
        initialized.push_back({node.now(), ""});
        if (on_initialize) on_initialize(*this);
    }
    void handle_timer(const std::string& timer) override {
        timers.push_back({node.now(), timer});
        if (on_timer) on_timer(*this, timer);
    }
    void handle_packet(const Payload& message) override {
        packets.push_back({node.now(), *message});
        if (on_packet) on_packet(*this, *message);
    }
    void handle_telemetry(const Position& position) override {
        telemetry.push_back(position);
        telemetry_times.push_back(node.now());
        if (on_telemetry) on_telemetry(*this);
    }
    void finish() override {
        finished.push_back({node.now(), ""});
        if (on_finish) on_finish(*this);
    }

private:
    static std::vector<std::string> texts_of(const std::vector<Told>& told) {
        std::vector<std::string> texts;
        for (const Told& one : told) {
            texts.push_back(one.text);
        }
        return texts;
    }
};

inline Recorder& add_recorder(Network& network, const NodeConfig& config) {
    Node& node = network.add_node(config);
    auto recorder = std::make_unique<Recorder>(node);
    Recorder& reference = *recorder;
    node.set_protocol(std::move(recorder));
    return reference;
}

}  // namespace netsim::test
