#include "netsim/phy/present_arrivals.hpp"

#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

// Their powers, in order.
std::vector<double> powers_w(const PresentArrivals& present) {
    std::vector<double> powers;
    for (const PresentArrival& arrival : present.all()) {
        powers.push_back(arrival.power_w);
    }
    return powers;
}

TEST(PresentArrivals, AreNoneAtFirst) {
    const PresentArrivals present{};
    EXPECT_TRUE(present.empty());
    EXPECT_TRUE(present.all().empty());
}

TEST(PresentArrivals, HaveTheOrderOfTheirTransmissions) {
    std::array<Transmission, 5> sent;
    PresentArrivals present;
    for (const std::size_t i : {3, 1, 4, 0, 2}) {
        sent[i].label.number = i;
        present.add({&sent[i], static_cast<double>(i)});
    }
    present.remove(&sent[1]);
    EXPECT_EQ(powers_w(present), (std::vector<double>{0, 2, 3, 4}));
}

TEST(PresentArrivals, ComeBackFromManyToFew) {
    const std::array<Transmission, 3> sent;
    PresentArrivals present;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        present.add({&sent[i], static_cast<double>(i)});
    }
    present.remove(&sent[0]);
    EXPECT_EQ(powers_w(present), (std::vector<double>{1, 2}));
    present.remove(&sent[2]);
    EXPECT_EQ(powers_w(present), (std::vector<double>{1}));
}

TEST(PresentArrivals, KeepWhatTheRadioIsLockedOnToWhileOthersComeAndGo) {
    std::array<Transmission, 3> sent;
    PresentArrivals present;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        sent[i].label.number = i;
    }
    present.add({&sent[1], 1});
    present.lock_on(&sent[1]);
    EXPECT_EQ(present.locked(), &sent[1]);
    present.add({&sent[0], 1});
    present.add({&sent[2], 1});
    EXPECT_EQ(present.locked(), &sent[1]);
    present.remove(&sent[0]);
    present.remove(&sent[2]);
    EXPECT_EQ(present.locked(), &sent[1]);
    EXPECT_EQ(&present.unlock(), &sent[1]);
    EXPECT_EQ(present.locked(), nullptr);
    EXPECT_FALSE(present.is_locked());
}

TEST(PresentArrivals, LetTheRadioLockOnToALaterOne) {
    std::array<Transmission, 2> sent;
    PresentArrivals present;
    sent[1].label.number = 1;
    present.add({&sent[0], 1});
    present.lock_on(&sent[0]);
    present.add({&sent[1], 1});
    present.unlock();
    present.lock_on(&sent[1]);
    present.remove(&sent[0]);
    EXPECT_EQ(present.locked(), &sent[1]);
}

// Random starts and ends, compared with a vector.
class PresentArrivalsOracle : public testing::TestWithParam<unsigned> {};

TEST_P(PresentArrivalsOracle, AgreeWithAVector) {
    std::mt19937 random(GetParam());
    const std::vector<Transmission> sent(2000);
    PresentArrivals present;
    std::vector<const Transmission*> oracle;
    for (const Transmission& transmission : sent) {
        present.add({&transmission, 1});
        oracle.push_back(&transmission);
        for (std::size_t ends = random() % 3; ends > 0 && !oracle.empty(); --ends) {
            const auto victim = oracle.begin() + static_cast<std::ptrdiff_t>(random() % oracle.size());
            present.remove(*victim);
            oracle.erase(victim);
        }
        ASSERT_EQ(present.empty(), oracle.empty());
        ASSERT_EQ(present.all().size(), oracle.size());
        for (std::size_t i = 0; i < oracle.size(); ++i) {
            ASSERT_EQ(present.all()[i].transmission, oracle[i]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PresentArrivalsOracle, testing::Range(1U, 11U));

}  // namespace
}  // namespace netsim
