// Fixture of the tests of a radio: a receiver, and senders around it whose frames arrive with a
// given power.
#pragma once

#include <cstddef>

#include <gtest/gtest.h>

#include "support/air.hpp"

namespace netsim::test {

inline constexpr double sensitivity_w = 3.1622776601683794e-12;
inline constexpr double strong_w = 1e-10;

// The receiver is in the middle; a frame takes a microsecond to reach it.
class RadioAmongSenders : public testing::Test {
protected:
    BareRadio& add_receiver(const RadioConfig& config = RadioConfig()) {
        return air.add_radio({0, 0, 0}, config);
    }

    BareRadio& add_sender(double received_w) {
        constexpr Position directions[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
        RadioConfig config;
        config.tx_power_w = power_for(received_w, light_microsecond_m);
        return air.add_radio(directions[senders_++] * light_microsecond_m, config);
    }

    // The frame is at the receiver from `start` for `duration`.
    void arrives(BareRadio& sender, SimTime start, SimTime duration) {
        air.at(start - us(1), [&sender, duration] { sender.send(duration); });
    }

    Air air;

private:
    std::size_t senders_ = 0;
};

}  // namespace netsim::test
