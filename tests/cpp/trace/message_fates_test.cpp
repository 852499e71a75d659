#include "netsim/trace/message_fates.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace netsim {
namespace {

std::uint64_t count_of(const auto& fates, MessageKind kind, MessageFate fate) {
    return fates.counts(kind)[static_cast<std::size_t>(fate)];
}

TEST(MessageFates, EveryFateHasANameOfItsOwn) {
    const std::set<std::string> names(message_fate_names.begin(), message_fate_names.end());
    EXPECT_EQ(names.size(), message_fate_count);
    EXPECT_STREQ(message_fate_names[static_cast<std::size_t>(MessageFate::queued)], "queued");
}

TEST(MessageFates, WhatHasNoFateIsQueued) {
    MessageFates fates;
    fates.accept(MessageKind::unicast);
    fates.accept(MessageKind::unicast);
    EXPECT_EQ(fates.accepted(MessageKind::unicast), 2U);
    EXPECT_EQ(count_of(fates, MessageKind::unicast, MessageFate::queued), 2U);
}

TEST(MessageFates, AFateEndsTheWaiting) {
    MessageFates fates;
    fates.accept(MessageKind::unicast);
    fates.accept(MessageKind::unicast);
    fates.book(MessageKind::unicast, MessageFate::retry_limit);
    EXPECT_EQ(count_of(fates, MessageKind::unicast, MessageFate::retry_limit), 1U);
    EXPECT_EQ(count_of(fates, MessageKind::unicast, MessageFate::queued), 1U);
}

TEST(MessageFates, KindsAreCountedApart) {
    MessageFates fates;
    fates.accept(MessageKind::broadcast);
    fates.book(MessageKind::broadcast, MessageFate::sent);
    EXPECT_EQ(fates.accepted(MessageKind::unicast), 0U);
    EXPECT_EQ(fates.counts(MessageKind::unicast), MessageFates::Counts{});
    EXPECT_EQ(count_of(fates, MessageKind::broadcast, MessageFate::sent), 1U);
}

TEST(MessageFateSums, AreThoseOfAllInterfaces) {
    MessageFates fates;
    fates.accept(MessageKind::unicast);
    fates.accept(MessageKind::unicast);
    fates.book(MessageKind::unicast, MessageFate::acknowledged);
    MessageFateSums sums;
    sums.add(fates);
    sums.add(fates);
    EXPECT_EQ(sums.accepted(MessageKind::unicast), 4U);
    EXPECT_EQ(count_of(sums, MessageKind::unicast, MessageFate::acknowledged), 2U);
    EXPECT_EQ(count_of(sums, MessageKind::unicast, MessageFate::queued), 2U);
    EXPECT_EQ(sums.counts(MessageKind::broadcast), MessageFateSums::Counts{});
}

}  // namespace
}  // namespace netsim
