#include "netsim/trace/frame_outcomes.hpp"

#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr FrameLabel broadcast{FrameKind::broadcast, broadcast_id};
constexpr FrameLabel unicast_to_1{FrameKind::unicast, 1};

FrameOutcomes outcomes_of_nodes(int count) {
    FrameOutcomes outcomes;
    for (int node = 0; node < count; ++node) {
        outcomes.add_node();
    }
    return outcomes;
}

std::uint64_t count_of(const FrameOutcomes::Counts& counts, FrameOutcome outcome) {
    return counts[static_cast<std::size_t>(outcome)];
}

TEST(FrameLabel, ABroadcastIsForEverybody) {
    EXPECT_TRUE(broadcast.is_for(0));
    EXPECT_TRUE(broadcast.is_for(7));
}

TEST(FrameLabel, AUnicastIsForItsDestination) {
    EXPECT_TRUE(unicast_to_1.is_for(1));
    EXPECT_FALSE(unicast_to_1.is_for(0));
}

TEST(FrameOutcomes, EveryOutcomeAndKindHasANameOfItsOwn) {
    const std::set<std::string> outcomes(frame_outcome_names.begin(), frame_outcome_names.end());
    const std::set<std::string> kinds(frame_kind_names.begin(), frame_kind_names.end());
    EXPECT_EQ(outcomes.size(), frame_outcome_count);
    EXPECT_EQ(kinds.size(), frame_kind_count);
    EXPECT_STREQ(frame_outcome_names[static_cast<std::size_t>(FrameOutcome::in_air)], "in_air");
}

TEST(FrameOutcomes, NothingHappenedAtFirst) {
    const FrameOutcomes outcomes = outcomes_of_nodes(2);
    EXPECT_EQ(outcomes.frames(FrameKind::broadcast), 0U);
    EXPECT_EQ(outcomes.counts(FrameKind::broadcast, false), FrameOutcomes::Counts{});
}

TEST(FrameOutcomes, CopiesWithoutAnOutcomeAreInTheAir) {
    FrameOutcomes outcomes = outcomes_of_nodes(4);
    outcomes.book_transmission(broadcast, {.made = 3, .too_weak = 1}, {});
    const auto counts = outcomes.counts(FrameKind::broadcast, false);
    EXPECT_EQ(outcomes.frames(FrameKind::broadcast), 1U);
    EXPECT_EQ(outcomes.copies(FrameKind::broadcast, false), 3U);
    EXPECT_EQ(count_of(counts, FrameOutcome::below_sensitivity), 1U);
    EXPECT_EQ(count_of(counts, FrameOutcome::in_air), 2U);
}

TEST(FrameOutcomes, ABookedCopyIsNoLongerInTheAir) {
    FrameOutcomes outcomes = outcomes_of_nodes(4);
    outcomes.book_transmission(broadcast, {.made = 3}, {});
    outcomes.book(1, broadcast, FrameOutcome::delivered);
    outcomes.book(2, broadcast, FrameOutcome::noise);
    const auto counts = outcomes.counts(FrameKind::broadcast, false);
    EXPECT_EQ(count_of(counts, FrameOutcome::delivered), 1U);
    EXPECT_EQ(count_of(counts, FrameOutcome::noise), 1U);
    EXPECT_EQ(count_of(counts, FrameOutcome::in_air), 1U);
}

TEST(FrameOutcomes, OverheardCopiesAreCountedApart) {
    FrameOutcomes outcomes = outcomes_of_nodes(4);
    outcomes.book_transmission(unicast_to_1, {.made = 1}, {.made = 2, .too_weak = 1});
    outcomes.book(1, unicast_to_1, FrameOutcome::delivered);
    outcomes.book(2, unicast_to_1, FrameOutcome::receiver_locked);
    const auto addressed = outcomes.counts(FrameKind::unicast, false);
    const auto overheard = outcomes.counts(FrameKind::unicast, true);
    EXPECT_EQ(outcomes.copies(FrameKind::unicast, true), 2U);
    EXPECT_EQ(count_of(addressed, FrameOutcome::delivered), 1U);
    EXPECT_EQ(count_of(overheard, FrameOutcome::delivered), 0U);
    EXPECT_EQ(count_of(overheard, FrameOutcome::receiver_locked), 1U);
    EXPECT_EQ(count_of(overheard, FrameOutcome::below_sensitivity), 1U);
    EXPECT_EQ(count_of(overheard, FrameOutcome::in_air), 0U);
}

TEST(FrameOutcomes, KindsAreCountedApart) {
    FrameOutcomes outcomes = outcomes_of_nodes(2);
    outcomes.book_transmission({FrameKind::ack, 1}, {.made = 1}, {});
    EXPECT_EQ(outcomes.frames(FrameKind::ack), 1U);
    EXPECT_EQ(outcomes.frames(FrameKind::unicast), 0U);
    EXPECT_EQ(outcomes.frames(FrameKind::broadcast), 0U);
}

TEST(FrameOutcomes, CountsAtOneReceiver) {
    FrameOutcomes outcomes = outcomes_of_nodes(3);
    outcomes.book_transmission(broadcast, {.made = 2}, {});
    outcomes.book(1, broadcast, FrameOutcome::delivered);
    outcomes.book(2, broadcast, FrameOutcome::noise);
    EXPECT_EQ(count_of(outcomes.counts_at(1, FrameKind::broadcast), FrameOutcome::delivered), 1U);
    EXPECT_EQ(count_of(outcomes.counts_at(1, FrameKind::broadcast), FrameOutcome::noise), 0U);
    EXPECT_EQ(count_of(outcomes.counts_at(2, FrameKind::broadcast), FrameOutcome::noise), 1U);
}

TEST(FrameOutcomes, InterferenceNamesItsInterferers) {
    FrameOutcomes outcomes = outcomes_of_nodes(5);
    outcomes.book_transmission(broadcast, {.made = 4}, {});
    outcomes.book_transmission(broadcast, {.made = 4}, {});
    outcomes.book_interference(1, broadcast, std::vector<NodeId>{2, 4});
    outcomes.book_interference(1, broadcast, std::vector<NodeId>{4});
    EXPECT_EQ(count_of(outcomes.counts(FrameKind::broadcast, false), FrameOutcome::interference), 2U);
    EXPECT_EQ(outcomes.interferers_at(1), (std::map<NodeId, std::uint64_t>{{2, 1}, {4, 2}}));
    EXPECT_TRUE(outcomes.interferers_at(0).empty());
}

TEST(FrameOutcomesDeathTest, MoreOutcomesThanCopiesIsAnInternalError) {
    FrameOutcomes outcomes = outcomes_of_nodes(2);
    outcomes.book(1, broadcast, FrameOutcome::delivered);
    EXPECT_DEATH(outcomes.counts(FrameKind::broadcast, false), "internal error");
}

}  // namespace
}  // namespace netsim
