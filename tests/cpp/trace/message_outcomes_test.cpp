#include "netsim/trace/message_outcomes.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace netsim {
namespace {

std::uint64_t count_of(const auto& outcomes, MessageKind kind, MessageOutcome outcome) {
    return outcomes.counts(kind)[static_cast<std::size_t>(outcome)];
}

TEST(MessageOutcomes, EveryOutcomeHasANameOfItsOwn) {
    const std::set<std::string> names(message_outcome_names.begin(), message_outcome_names.end());
    EXPECT_EQ(names.size(), message_outcome_count);
    EXPECT_STREQ(message_outcome_names[static_cast<std::size_t>(MessageOutcome::queued)], "queued");
}

TEST(MessageOutcomes, WhatHasNoOutcomeIsQueued) {
    MessageOutcomes outcomes;
    outcomes.accept(MessageKind::unicast);
    outcomes.accept(MessageKind::unicast);
    EXPECT_EQ(outcomes.accepted(MessageKind::unicast), 2U);
    EXPECT_EQ(count_of(outcomes, MessageKind::unicast, MessageOutcome::queued), 2U);
}

TEST(MessageOutcomes, AnOutcomeEndsTheWaiting) {
    MessageOutcomes outcomes;
    outcomes.accept(MessageKind::unicast);
    outcomes.accept(MessageKind::unicast);
    outcomes.book(MessageKind::unicast, MessageOutcome::retry_limit);
    EXPECT_EQ(count_of(outcomes, MessageKind::unicast, MessageOutcome::retry_limit), 1U);
    EXPECT_EQ(count_of(outcomes, MessageKind::unicast, MessageOutcome::queued), 1U);
}

TEST(MessageOutcomes, KindsAreCountedApart) {
    MessageOutcomes outcomes;
    outcomes.accept(MessageKind::broadcast);
    outcomes.book(MessageKind::broadcast, MessageOutcome::sent);
    EXPECT_EQ(outcomes.accepted(MessageKind::unicast), 0U);
    EXPECT_EQ(outcomes.counts(MessageKind::unicast), MessageOutcomes::Counts{});
    EXPECT_EQ(count_of(outcomes, MessageKind::broadcast, MessageOutcome::sent), 1U);
}

TEST(MessageOutcomeSums, AreThoseOfAllInterfaces) {
    MessageOutcomes outcomes;
    outcomes.accept(MessageKind::unicast);
    outcomes.accept(MessageKind::unicast);
    outcomes.book(MessageKind::unicast, MessageOutcome::acknowledged);
    MessageOutcomeSums sums;
    sums.add(outcomes);
    sums.add(outcomes);
    EXPECT_EQ(sums.accepted(MessageKind::unicast), 4U);
    EXPECT_EQ(count_of(sums, MessageKind::unicast, MessageOutcome::acknowledged), 2U);
    EXPECT_EQ(count_of(sums, MessageKind::unicast, MessageOutcome::queued), 2U);
    EXPECT_EQ(sums.counts(MessageKind::broadcast), MessageOutcomeSums::Counts{});
}

}  // namespace
}  // namespace netsim
