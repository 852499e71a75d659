// Log of a radio's notifications to the layer above.
#pragma once

#include <ostream>
#include <vector>

#include "netsim/kernel/simulator.hpp"
#include "netsim/phy/radio.hpp"

namespace netsim::test {

enum class RadioWord { busy, free, received, corrupted, sent };

struct RadioEvent {
    RadioWord word;
    SimTime time;

    bool operator==(const RadioEvent&) const = default;
    friend std::ostream& operator<<(std::ostream& out, const RadioEvent& event) {
        constexpr const char* names[] = {"busy", "free", "received", "corrupted", "sent"};
        return out << names[static_cast<int>(event.word)] << " at " << event.time.ps() << " ps";
    }
};

class RadioLog final : public RadioListener {
public:
    explicit RadioLog(const Simulator& simulator) : simulator_(simulator) {}

    std::vector<RadioEvent> events;
    std::vector<NodeId> received_from;
    std::vector<CorruptedFrame> corrupted;

    std::vector<SimTime> times_of(RadioWord word) const {
        std::vector<SimTime> times;
        for (const RadioEvent& event : events) {
            if (event.word == word) {
                times.push_back(event.time);
            }
        }
        return times;
    }

    void channel_busy_changed(bool busy) override { note(busy ? RadioWord::busy : RadioWord::free); }
    void frame_received(const Transmission& transmission) override {
        received_from.push_back(transmission.sender.node);
        note(RadioWord::received);
    }
    void frame_corrupted(CorruptedFrame frame) override {
        corrupted.push_back(frame);
        note(RadioWord::corrupted);
    }
    void transmission_ended() override { note(RadioWord::sent); }

private:
    void note(RadioWord word) { events.push_back({word, simulator_.now()}); }

    const Simulator& simulator_;
};

}  // namespace netsim::test
