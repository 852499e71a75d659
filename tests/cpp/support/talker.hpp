// A protocol that sends at random through all its interfaces: bursts of messages at random times,
// and changes of course, from a separate stream.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "netsim/kernel/random.hpp"
#include "netsim/node/node.hpp"

namespace netsim::test {

struct Delivery {
    SimTime time;
    NodeId receiver;
    std::string text;

    bool operator==(const Delivery&) const = default;
};

struct Talk {
    std::uint64_t seed = 0;
    std::int32_t node_count = 0;
    SimTime until;             // no messages from then on
    std::uint32_t rounds = 1;  // bursts per node
    std::uint32_t longest_burst = 1;
    std::uint32_t longest_text = 100;
    double broadcast_share = 0.5;
    double area_m = 0;
    Position corner;  // of the area of its flights
    double top_speed_mps = 300;
    bool moves = false;
    double movers = 1;  // the ratio of nodes that fly
    SimTime beat;       // if not zero, bursts are at multiples of it, so that nodes start at the same instant
    double late = 0;    // the ratio of bursts whose timer is set a beat earlier, after events due then
    double answers = 0;  // the ratio of messages that it answers with a burst, at once
};

class Talker final : public Protocol {
public:
    Talker(Node& node, const Talk& talk, std::vector<Delivery>& deliveries)
        : node_(node),
          talk_(talk),
          deliveries_(deliveries),
          draws_(talk.seed, static_cast<std::uint32_t>(node.id()), Purpose{1000}),
          moves_(talk.moves && (talk.movers >= 1 || draws_.uniform() < talk.movers)) {}

    void initialize() override {
        for (std::uint32_t round = 0; round < talk_.rounds; ++round) {
            const double part = draws_.uniform();
            SimTime time =
                SimTime::from_ps(static_cast<std::int64_t>(part * static_cast<double>(talk_.until.ps())));
            if (talk_.beat > SimTime()) {
                time = SimTime::from_ps(time.ps() / talk_.beat.ps() * talk_.beat.ps());
            }
            if (time >= talk_.beat && draws_below(talk_.late)) {
                node_.schedule_timer("set", SimTime::from_ps(time.ps() - talk_.beat.ps()));
            } else {
                node_.schedule_timer("talk", time);
            }
        }
    }
    void handle_timer(const std::string& timer) override {
        if (timer == "set") {
            node_.schedule_timer("talk", node_.now() + talk_.beat);
        } else {
            speak();
        }
    }
    void handle_packet(const Payload& message) override {
        deliveries_.push_back({node_.now(), node_.id(), *message});
        if (node_.now() < talk_.until && draws_below(talk_.answers)) {
            speak();
        }
    }
    void handle_telemetry(const Position&) override {}
    void finish() override {}

    // Messages through all interfaces.
    std::uint64_t sent() const { return sent_; }

private:
    void speak() {
        if (moves_) {
            node_.set_speed(draws_.uniform() * talk_.top_speed_mps);
            node_.go_to(talk_.corner +
                        Position{draws_.uniform() * talk_.area_m, draws_.uniform() * talk_.area_m, 0});
        }
        const std::uint32_t messages = 1 + draws_.uniform_int(talk_.longest_burst);
        for (std::uint32_t i = 0; i < messages; ++i) {
            std::string text = std::to_string(node_.id()) + ":" + std::to_string(sent_++) + " ";
            text.resize(text.size() + draws_.uniform_int(talk_.longest_text + 1), '.');
            auto payload = std::make_shared<const std::string>(std::move(text));
            if (draws_.uniform() < talk_.broadcast_share) {
                node_.broadcast(std::move(payload), interface());
            } else {
                const auto other = static_cast<NodeId>(draws_.uniform_int(talk_.node_count - 1));
                node_.send(other < node_.id() ? other : other + 1, std::move(payload), interface());
            }
        }
    }
    // Draws nothing for a ratio of 0, so that scenarios without that feature do not change.
    bool draws_below(double share) { return share > 0 && draws_.uniform() < share; }
    // With only one choice it draws nothing, either.
    std::int32_t interface() {
        const auto count = static_cast<std::uint32_t>(node_.interfaces().size());
        return count == 1 ? 0 : static_cast<std::int32_t>(draws_.uniform_int(count));
    }

    Node& node_;
    Talk talk_;
    std::vector<Delivery>& deliveries_;
    RandomStream draws_;
    bool moves_;
    std::uint64_t sent_ = 0;
};

}  // namespace netsim::test
