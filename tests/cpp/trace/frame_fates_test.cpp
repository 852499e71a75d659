#include "netsim/trace/frame_fates.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr FrameLabel broadcast{FrameKind::broadcast, broadcast_id};
constexpr FrameLabel unicast_to_1{FrameKind::unicast, 1};

FrameFates fates_of_nodes(int count) {
    FrameFates fates;
    for (int node = 0; node < count; ++node) {
        fates.add_node();
    }
    return fates;
}

std::uint64_t count_of(const FrameFates::Counts& counts, FrameFate fate) {
    return counts[static_cast<std::size_t>(fate)];
}

TEST(FrameLabel, ABroadcastIsForEverybody) {
    EXPECT_TRUE(broadcast.is_for(0));
    EXPECT_TRUE(broadcast.is_for(7));
}

TEST(FrameLabel, AUnicastIsForItsDestination) {
    EXPECT_TRUE(unicast_to_1.is_for(1));
    EXPECT_FALSE(unicast_to_1.is_for(0));
}

TEST(FrameFates, EveryFateAndKindHasANameOfItsOwn) {
    const std::set<std::string> fates(frame_fate_names.begin(), frame_fate_names.end());
    const std::set<std::string> kinds(frame_kind_names.begin(), frame_kind_names.end());
    EXPECT_EQ(fates.size(), frame_fate_count);
    EXPECT_EQ(kinds.size(), frame_kind_count);
    EXPECT_STREQ(frame_fate_names[static_cast<std::size_t>(FrameFate::in_air)], "in_air");
}

TEST(FrameFates, NothingHappenedAtFirst) {
    const FrameFates fates = fates_of_nodes(2);
    EXPECT_EQ(fates.frames(FrameKind::broadcast), 0U);
    EXPECT_EQ(fates.counts(FrameKind::broadcast, false), FrameFates::Counts{});
}

TEST(FrameFates, CopiesWithoutAFateAreInTheAir) {
    FrameFates fates = fates_of_nodes(4);
    fates.book_transmission(broadcast, {.made = 3, .too_weak = 1}, {});
    const auto counts = fates.counts(FrameKind::broadcast, false);
    EXPECT_EQ(fates.frames(FrameKind::broadcast), 1U);
    EXPECT_EQ(fates.copies(FrameKind::broadcast, false), 3U);
    EXPECT_EQ(count_of(counts, FrameFate::below_sensitivity), 1U);
    EXPECT_EQ(count_of(counts, FrameFate::in_air), 2U);
}

TEST(FrameFates, ABookedCopyIsNoLongerInTheAir) {
    FrameFates fates = fates_of_nodes(4);
    fates.book_transmission(broadcast, {.made = 3}, {});
    fates.book(1, broadcast, FrameFate::delivered);
    fates.book(2, broadcast, FrameFate::noise);
    const auto counts = fates.counts(FrameKind::broadcast, false);
    EXPECT_EQ(count_of(counts, FrameFate::delivered), 1U);
    EXPECT_EQ(count_of(counts, FrameFate::noise), 1U);
    EXPECT_EQ(count_of(counts, FrameFate::in_air), 1U);
}

TEST(FrameFates, OverheardCopiesAreCountedApart) {
    FrameFates fates = fates_of_nodes(4);
    fates.book_transmission(unicast_to_1, {.made = 1}, {.made = 2, .too_weak = 1});
    fates.book(1, unicast_to_1, FrameFate::delivered);
    fates.book(2, unicast_to_1, FrameFate::receiver_locked);
    const auto addressed = fates.counts(FrameKind::unicast, false);
    const auto overheard = fates.counts(FrameKind::unicast, true);
    EXPECT_EQ(fates.copies(FrameKind::unicast, true), 2U);
    EXPECT_EQ(count_of(addressed, FrameFate::delivered), 1U);
    EXPECT_EQ(count_of(overheard, FrameFate::delivered), 0U);
    EXPECT_EQ(count_of(overheard, FrameFate::receiver_locked), 1U);
    EXPECT_EQ(count_of(overheard, FrameFate::below_sensitivity), 1U);
    EXPECT_EQ(count_of(overheard, FrameFate::in_air), 0U);
}

TEST(FrameFates, KindsAreCountedApart) {
    FrameFates fates = fates_of_nodes(2);
    fates.book_transmission({FrameKind::ack, 1}, {.made = 1}, {});
    EXPECT_EQ(fates.frames(FrameKind::ack), 1U);
    EXPECT_EQ(fates.frames(FrameKind::unicast), 0U);
    EXPECT_EQ(fates.frames(FrameKind::broadcast), 0U);
}

TEST(FrameFates, CountsAtOneReceiver) {
    FrameFates fates = fates_of_nodes(3);
    fates.book_transmission(broadcast, {.made = 2}, {});
    fates.book(1, broadcast, FrameFate::delivered);
    fates.book(2, broadcast, FrameFate::noise);
    EXPECT_EQ(count_of(fates.counts_at(1, FrameKind::broadcast), FrameFate::delivered), 1U);
    EXPECT_EQ(count_of(fates.counts_at(1, FrameKind::broadcast), FrameFate::noise), 0U);
    EXPECT_EQ(count_of(fates.counts_at(2, FrameKind::broadcast), FrameFate::noise), 1U);
}

TEST(FrameFates, InterferenceNamesItsInterferers) {
    FrameFates fates = fates_of_nodes(5);
    fates.book_transmission(broadcast, {.made = 4}, {});
    fates.book_transmission(broadcast, {.made = 4}, {});
    fates.book_interference(1, broadcast, std::vector<NodeId>{2, 4});
    fates.book_interference(1, broadcast, std::vector<NodeId>{4});
    EXPECT_EQ(count_of(fates.counts(FrameKind::broadcast, false), FrameFate::interference), 2U);
    EXPECT_EQ(fates.interferers_at(1), (std::map<NodeId, std::uint64_t>{{2, 1}, {4, 2}}));
    EXPECT_TRUE(fates.interferers_at(0).empty());
}

TEST(FrameFatesDeathTest, MoreFatesThanCopiesIsAnInternalError) {
    FrameFates fates = fates_of_nodes(2);
    fates.book(1, broadcast, FrameFate::delivered);
    EXPECT_DEATH(fates.counts(FrameKind::broadcast, false), "internal error");
}

}  // namespace
}  // namespace netsim
