#include "netsim/propagation/antennas.hpp"

#include <gtest/gtest.h>

#include "support/air.hpp"

namespace netsim {
namespace {

// Ten times the gain along its x axis, a tenth in the opposite half.
class Beam final : public AntennaPattern {
public:
    double gain(const Position& direction) const override { return direction.x > 0 ? 10 : 0.1; }
    double max_gain() const override { return 10; }
};

MountedAntenna heading(const AntennaPattern& pattern, double heading_rad) {
    return {&pattern, Attitude(), Orientation(EulerAngles{.heading_rad = heading_rad})};
}

TEST(Antennas, MultiplyTheGainsOfBothEndsTowardsEachOther) {
    const Beam beam;
    const Trajectory here({0, 0, 0});
    const Trajectory there({100, 0, 0});
    Antennas antennas;
    antennas.add(heading(beam, 0), here);
    antennas.add(heading(beam, 0), there);     // looks away
    antennas.add(heading(beam, 3.14), there);  // looks back
    antennas.add(MountedAntenna(), there);
    Transmission sent;
    sent.origin = {0, 0, 0};
    EXPECT_DOUBLE_EQ(antennas.gain(sent, 1, {100, 0, 0}), 1);
    EXPECT_DOUBLE_EQ(antennas.gain(sent, 2, {100, 0, 0}), 100);
    EXPECT_DOUBLE_EQ(antennas.gain(sent, 3, {100, 0, 0}), 10);
    EXPECT_FALSE(antennas.all_isotropic());
    EXPECT_EQ(antennas.max_gain(0), 10);
    EXPECT_EQ(antennas.max_gain(3), 1);
}

TEST(Antennas, OfRadiosReachTheMedium) {
    test::Air air;
    RadioConfig config = test::radio_of_power(0.02);
    config.antenna.type_name = "ConstantGainAntenna";
    config.antenna.gain = 4;
    test::BareRadio& sender = air.add_radio({0, 0, 0}, config);
    test::Sniffer& sniffer = air.add_sniffer({50, 0, 0});
    air.at(SimTime::from_us(10), [&] { sender.send(SimTime::from_us(100)); });
    air.run();
    EXPECT_NEAR(sniffer.heard.at(0).power_w, 4 * 7.8264e-10, 4e-14);  // 13.0103 dBm − 74.0747 dB, times 4
}

TEST(Antennas, CarryFartherThanIsotropicOnes) {
    // -85 dBm from 20 mW: 790 m; with 10 dB on both sides 7.9 km.
    RadioConfig config = test::radio_of_power(0.02);
    for (const double gain : {1.0, 10.0}) {
        test::Air air;
        config.antenna.type_name = "ConstantGainAntenna";
        config.antenna.gain = gain;
        test::BareRadio& sender = air.add_radio({0, 0, 0}, config);
        test::BareRadio& receiver = air.add_radio({7000, 0, 0}, config);
        air.at(SimTime::from_us(10), [&] { sender.send(SimTime::from_us(100)); });
        air.at(SimTime::from_us(60), [&] { EXPECT_EQ(receiver.radio.is_receiving(), gain > 1); });
        air.run();
    }
}

}  // namespace
}  // namespace netsim
