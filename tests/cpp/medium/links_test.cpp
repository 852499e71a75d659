#include "netsim/medium/links.hpp"

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "netsim/medium/arrival.hpp"
#include "netsim/phy/antenna.hpp"
#include "netsim/units.hpp"

namespace netsim {
namespace {

ReceiverParameters usual() {
    return {.band = {2.412e9, 20e6}, .sensitivity_w = 3e-12, .energy_detection_w = 3e-12, .noise_w = 1e-14};
}

ReceiverParameters with_sensitivity(double sensitivity_w) {
    ReceiverParameters kind = usual();
    kind.sensitivity_w = sensitivity_w;
    return kind;
}

ReceiverParameters elsewhere() {
    ReceiverParameters kind = usual();
    kind.band.carrier_hz = 2.437e9;
    return kind;
}

class LinksTest : public testing::Test {
protected:
    RadioId add(Position place, const ReceiverParameters& kind = usual(), std::uint8_t interface = 0) {
        if (interface == 0) {
            places.emplace_back(place);
        }
        const auto node = static_cast<NodeId>(places.size()) - 1;
        return links.add(InterfaceId{node, interface}, {.trajectory = &places.back(), .parameters = kind},
                         MountedAntenna(), SimTime());
    }
    Transmission sent_by(RadioId radio, double power_w = 1e-3) const {
        Transmission sent;
        sent.sender = links.interface(radio);
        sent.radio = radio;
        sent.start = SimTime::from_us(10);
        sent.duration = SimTime::from_us(100);
        sent.power_w = power_w;
        sent.band = links.receiver(radio).band;
        sent.origin = links.position(radio, sent.start);
        return sent;
    }

    std::deque<Trajectory> places;
    Links links{MediumConfig(), 1};
};

TEST_F(LinksTest, GroupsReceiversOfOneBandAndSimilarSensitivity) {
    const RadioId one = add({0, 0, 0});
    const RadioId like = add({10, 0, 0}, with_sensitivity(2.9e-12));
    EXPECT_EQ(links.group_of(one), links.group_of(like));
    EXPECT_EQ(links.groups().size(), 1U);
    EXPECT_EQ(links.groups()[0].min_power_w, 2.9e-12);
}

TEST_F(LinksTest, SeparatesReceiversOfOtherBandsOrSensitivities) {
    const RadioId one = add({0, 0, 0});
    const RadioId keen = add({10, 0, 0}, with_sensitivity(1e-15));
    const RadioId other = add({10, 0, 0}, elsewhere());
    EXPECT_NE(links.group_of(one), links.group_of(keen));
    EXPECT_NE(links.group_of(one), links.group_of(other));
}

TEST_F(LinksTest, AnArrivalIsDelayedAndLockableIfStrongEnough) {
    const RadioId sender = add({0, 0, 0});
    const RadioId receiver = add({300, 0, 0});
    const Position place{300, 0, 0};
    const double received_w = links.power_w(sent_by(sender), 1, receiver, place, 300);
    const double enough = usual().sensitivity_w / received_w;
    for (const bool is_enough : {false, true}) {
        const Transmission sent = sent_by(sender, 1e-3 * enough * (is_enough ? 1.001 : 0.999));
        const Arrival arrival = links.arrival(sent, 1, receiver, place);
        EXPECT_EQ(arrival.start, sent.start + propagation_delay(300));
        EXPECT_EQ(arrival.end, arrival.start + sent.duration);
        EXPECT_EQ(arrival.lockable, is_enough);
    }
}

TEST_F(LinksTest, AShareOfTheBandGetsThatShareOfThePower) {
    const RadioId sender = add({0, 0, 0});
    const RadioId receiver = add({300, 0, 0});
    const Position place{300, 0, 0};
    EXPECT_DOUBLE_EQ(links.power_w(sent_by(sender), 0.25, receiver, place, 300),
                     links.power_w(sent_by(sender), 1, receiver, place, 300) / 4);
}

TEST_F(LinksTest, NoReceiverBeyondTheReachGetsThePower) {
    const RadioId sender = add({0, 0, 0});
    const RadioId receiver = add({300, 0, 0});
    const Transmission sent = sent_by(sender);
    ReceiverGroup& group = links.groups()[0];
    const double reach_m = links.reach_m(group, sent);
    EXPECT_EQ(reach_m, links.reach_of_power_m(sent, group, group.min_noticed_w(sent)));
    EXPECT_LT(links.power_w(sent, 1, receiver, {reach_m, 0, 0}, reach_m), group.min_power_w);
    EXPECT_GT(links.power_w(sent, 1, receiver, {0.999 * reach_m, 0, 0}, 0.999 * reach_m), group.min_power_w);
    EXPECT_EQ(links.reach_of_power_m(sent, group, 0), std::numeric_limits<double>::infinity());
}

TEST_F(LinksTest, ReceiversWithinTheEdRadiusExceedTheThreshold) {
    const RadioId sender = add({0, 0, 0});
    const RadioId receiver = add({300, 0, 0});
    const Transmission sent = sent_by(sender);
    const double loud_m = links.ed_radius_m(sent, links.groups()[0]);
    ASSERT_GT(loud_m, 0);
    EXPECT_TRUE(usual().surely_exceeds_ed(links.power_w(sent, 1, receiver, {loud_m, 0, 0}, loud_m)));
}

TEST_F(LinksTest, TheAddresseeIsTheInterfaceThatCanDecodeIt) {
    const RadioId sender = add({0, 0, 0});
    add({10, 0, 0}, elsewhere());
    const RadioId second = add({10, 0, 0}, usual(), 1);
    add({20, 0, 0}, elsewhere());
    Transmission sent = sent_by(sender);
    const auto addressee_of_frame_to = [&](NodeId node) {
        sent.label.destination = node;
        return links.addressee_of(sent);
    };
    EXPECT_EQ(addressee_of_frame_to(1), second);
    EXPECT_EQ(addressee_of_frame_to(2), -1);  // on another channel
    EXPECT_EQ(addressee_of_frame_to(0), -1);  // the sender itself
    EXPECT_EQ(addressee_of_frame_to(3), -1);  // not to any node
    EXPECT_EQ(addressee_of_frame_to(broadcast_id), -1);
}

struct Environment {
    const char* name;
    void (*change)(MediumConfig& config);
};

ObstacleConfig wall(double x, const char* material) {
    ObstacleConfig obstacle;
    obstacle.rings = {{{x, -50}, {x + 0.2, -50}, {x + 0.2, 50}, {x, 50}}};
    obstacle.top_m = 20;
    obstacle.material = material;
    return obstacle;
}

constexpr Environment environments[] = {
    {"FreeSpace", [](MediumConfig& /*config*/) {}},
    {"Breakpoint", [](MediumConfig& config) { config.path_loss = "BreakpointPathLoss"; }},
    {"GroundReflection", [](MediumConfig& config) { config.path_loss = "TwoRayGroundReflection"; }},
    {"TwoRays", [](MediumConfig& config) { config.path_loss = "TwoRayInterference"; }},
    {"Rayleigh", [](MediumConfig& config) { config.path_loss = "RayleighFading"; }},
    {"Shadowing", [](MediumConfig& config) { config.shadowing_standard_deviation_db = 6; }},
    {"Walls",
     [](MediumConfig& config) {
         config.obstacle_loss = "DielectricObstacleLoss";
         config.obstacles = {wall(-30, "metal"), wall(10, "brick"), wall(20, "glass")};
     }},
    {"Everything",
     [](MediumConfig& config) {
         config.path_loss = "NakagamiFading";
         config.shadowing_standard_deviation_db = 6;
         config.obstacle_loss = "DielectricObstacleLoss";
         config.obstacles = {wall(-30, "metal"), wall(10, "brick"), wall(20, "glass")};
     }},
};

class PowerBudgetIn : public testing::TestWithParam<Environment> {};

TEST_P(PowerBudgetIn, HasTheFactorsOfThePowerOfTheRun) {
    MediumConfig config;
    GetParam().change(config);
    AntennaConfig dish;
    dish.type_name = "ParabolicAntenna";
    dish.max_gain = 30;
    dish.beam_width_rad = 0.5;
    Links links(config, 7);
    const auto pattern = make_antenna(dish, usual().band.carrier_hz);
    const Position places[] = {{0, 0, 5}, {40, 10, 9}, {25, -7, 3}, {300, 4, 12}};
    std::deque<Trajectory> paths;
    for (NodeId node = 0; node < 4; ++node) {
        const MountedAntenna antenna{node == 0 ? pattern.get() : nullptr, Attitude(), Orientation()};
        links.add(InterfaceId{node, 0},
                  {.trajectory = &paths.emplace_back(places[node]), .parameters = usual()}, antenna,
                  SimTime());
    }
    for (RadioId radio = 1; radio < 4; ++radio) {
        Transmission sent;
        sent.power_w = 0.02;
        sent.band = usual().band;
        sent.start = SimTime::from_us(10);
        sent.origin = places[0];
        const double power_w =
            links.power_w(sent, 1, radio, places[radio], distance(places[0], places[radio]));
        const PowerBudget budget = links.power_budget(sent, radio, places[radio]);
        EXPECT_NEAR(db_from_ratio(budget.received_w() / power_w), 0, 1e-9);
        EXPECT_EQ(budget.sent_w, 0.02);
        EXPECT_NE(budget.sender_antenna, 1);
        EXPECT_EQ(budget.receiver_antenna, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Links, PowerBudgetIn, testing::ValuesIn(environments),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(PowerBudget, NamesTheObstaclesByTheirPlaceInTheConfiguration) {
    MediumConfig config;
    config.obstacle_loss = "DielectricObstacleLoss";
    config.obstacles = {wall(-30, "metal"), wall(20, "glass"), wall(60, "metal"), wall(10, "brick")};
    Links links(config, 7);
    const Trajectory here({0, 0, 5});
    const Trajectory there({40, 0, 5});
    links.add(InterfaceId{0, 0}, {.trajectory = &here, .parameters = usual()}, {}, SimTime());
    links.add(InterfaceId{1, 0}, {.trajectory = &there, .parameters = usual()}, {}, SimTime());
    Transmission sent;
    sent.power_w = 0.02;
    sent.band = usual().band;
    sent.origin = {0, 0, 5};
    std::map<std::size_t, double> crossed;
    for (const auto& [index, gain] : links.power_budget(sent, 1, {40, 0, 5}).obstacles) {
        crossed[index] = gain;
    }
    ASSERT_EQ(crossed.size(), 2U);
    EXPECT_GT(crossed.at(1), crossed.at(3));  // glass lets more through than brick
}

}  // namespace
}  // namespace netsim
