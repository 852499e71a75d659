// Fixture of the tests of CSMA/CA in 802.15.4: devices on one channel, and the durations and
// intervals of IEEE 802.15.4, from which instants are computed by hand.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/csma_ca_802154.hpp"
#include "netsim/phy/oqpsk_mode.hpp"
#include "support/air.hpp"

// A separate namespace: 802.11 has intervals of the same names.
namespace netsim::test::csma {

inline constexpr SimTime period = us(320);
inline constexpr SimTime cca = us(128);
inline constexpr SimTime turnaround = us(192);
inline constexpr SimTime sifs = us(192);
inline constexpr SimTime ack_duration = us(352);        // 192 µs + 5 B
inline constexpr SimTime data_duration = us(2'976);     // 192 µs + 87 B, of which 50 B are payload
inline constexpr SimTime longest_duration = us(4'256);  // 192 µs + 127 B
inline constexpr SimTime ack_wait = us(560);
inline constexpr SimTime flight = us(1);

inline RadioConfig narrowband() {
    return RadioConfig(ieee802154_interface);
}

inline CsmaConfig without_backoff() {
    CsmaConfig config;
    config.min_be = 0;
    config.max_be = 0;
    return config;
}

struct Device final : NetworkInterfaceListener {
    Device(Air& air_, Position place, const CsmaConfig& config, const RadioConfig& radio_config,
           std::uint64_t seed)
        : air(air_),
          trajectory(place),
          radio(air.next_node(), model_of(radio_config, air.medium, seed), radio_config.tx_power_w,
                trajectory),
          csma(air.simulator, radio, config, seed) {
        csma.set_listener(this);
    }

    NodeId id() const { return radio.node(); }
    void send(NodeId destination, std::size_t bytes) {
        csma.send(destination, std::make_shared<const std::string>(bytes, 'x'), 0);
    }
    void message_received(const Frame&) override { received.push_back(air.simulator.now()); }

    Air& air;
    Trajectory trajectory;
    Radio radio;
    CsmaCa802154 csma;
    std::vector<SimTime> received;
};

// Devices that draw their backoffs from streams of one seed, a sniffer, and a radio that keeps the
// channel busy.
class CsmaDevices : public testing::Test {
protected:
    static constexpr std::uint64_t seed = 7;

    Device& add_device(Position place, const CsmaConfig& config = CsmaConfig(),
                       const RadioConfig& radio = narrowband()) {
        return devices_.emplace_back(air, place, config, radio, seed);
    }
    Sniffer& add_sniffer(Position place) { return air.add_sniffer(place, narrowband()); }
    BareRadio& add_jammer(Position place) { return air.add_radio(place, narrowband()); }
    // Keeps the channel busy with a broadcast frame.
    static void jam(BareRadio& jammer, SimTime duration) {
        Frame frame;
        frame.transmitter = jammer.id();
        frame.payload = std::make_shared<const std::string>();
        jammer.radio.transmit(std::make_shared<const Frame>(std::move(frame)), FrameLabel(), 100,
                              oqpsk_250_kbps, duration);
    }
    // Random numbers of a device.
    static RandomStream draws_of(const Device& device) {
        return {seed, static_cast<std::uint32_t>(device.id()), Purpose::csma_backoff};
    }
    std::uint64_t messages(MessageKind kind, MessageOutcome outcome) const {
        MessageOutcomeSums sums;
        for (const Device& device : devices_) {
            sums.add(device.csma.message_outcomes());
        }
        return sums.counts(kind)[static_cast<std::size_t>(outcome)];
    }

    Air air;

private:
    std::deque<Device> devices_;
};

}  // namespace netsim::test::csma
