#include "netsim/mac/transmit_queue.hpp"

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

constexpr int capacity = 2;

class TransmitQueueTest : public testing::Test {
protected:
    bool add(NodeId destination) { return add_to(queue, destination); }
    bool add_to(TransmitQueue& to, NodeId destination) const {
        Frame frame = to.frame_of(destination, text, 164, SimTime{});
        return to.add(frame);
    }
    std::uint64_t booked(MessageKind kind, MessageOutcome outcome) const {
        return queue.message_outcomes().counts(kind)[static_cast<std::size_t>(outcome)];
    }

    Payload text = std::make_shared<const std::string>("text");
    TransmitQueue queue{7, capacity, false};
};

TEST_F(TransmitQueueTest, FramesHaveSequenceNumbersAndReceivers) {
    const Frame all = queue.frame_of(broadcast_id, text, 164, SimTime::from_us(7));
    EXPECT_EQ(all.kind, FrameKind::broadcast);
    EXPECT_EQ(all.transmitter, 7);
    EXPECT_EQ(all.sequence, 0U);
    EXPECT_EQ(all.accepted, SimTime::from_us(7));
    const Frame one = queue.frame_of(3, text, 200, SimTime{});
    EXPECT_EQ(one.kind, FrameKind::unicast);
    EXPECT_EQ(one.receiver, 3);
    EXPECT_EQ(one.sequence, 1U);
    EXPECT_EQ(one.psdu_bytes, 200);
    EXPECT_EQ(one.payload, text);
    EXPECT_FALSE(one.retry);
}

TEST_F(TransmitQueueTest, TheFrameInProgressDoesNotWait) {
    EXPECT_TRUE(queue.empty());
    EXPECT_TRUE(add(3));
    EXPECT_TRUE(add(4));
    queue.begin_next();
    EXPECT_TRUE(add(5));
    EXPECT_EQ(queue.size(), 3U);
    EXPECT_EQ(queue.in_progress()->receiver, 3);
}

TEST_F(TransmitQueueTest, AFrameStaysInProgressUntilItIsFinished) {
    add(3);
    add(4);
    queue.begin_next();
    queue.begin_next();
    EXPECT_EQ(queue.in_progress()->receiver, 3);
    queue.finish(MessageOutcome::acknowledged);
    EXPECT_FALSE(queue.is_in_progress());
    EXPECT_FALSE(queue.empty());
    queue.begin_next();
    EXPECT_EQ(queue.in_progress()->receiver, 4);
}

TEST_F(TransmitQueueTest, FinishedMessagesAreBooked) {
    add(3);
    queue.begin_next();
    EXPECT_EQ(booked(MessageKind::unicast, MessageOutcome::queued), 1U);
    queue.finish(MessageOutcome::retry_limit);
    EXPECT_EQ(booked(MessageKind::unicast, MessageOutcome::retry_limit), 1U);
    EXPECT_EQ(booked(MessageKind::unicast, MessageOutcome::queued), 0U);
}

TEST_F(TransmitQueueTest, OverflowIsBooked) {
    add(broadcast_id);
    add(broadcast_id);
    EXPECT_FALSE(add(broadcast_id));
    EXPECT_EQ(queue.size(), 2U);
    EXPECT_EQ(queue.message_outcomes().accepted(MessageKind::broadcast), 3U);
    EXPECT_EQ(booked(MessageKind::broadcast, MessageOutcome::queue_overflow), 1U);
}

TEST_F(TransmitQueueTest, WaitingFramesStayWhenANewOneIsDropped) {
    add(3);
    add(4);
    EXPECT_FALSE(add(5));
    queue.begin_next();
    EXPECT_EQ(queue.in_progress()->receiver, 3);
}

TEST_F(TransmitQueueTest, HasRoomAgainWhenAWaitingFrameIsInProgress) {
    add(3);
    add(4);
    queue.begin_next();
    EXPECT_TRUE(add(5));
    EXPECT_FALSE(add(6));
    queue.finish(MessageOutcome::acknowledged);
    EXPECT_FALSE(add(7));  // two wait, and none is in progress
    queue.begin_next();
    EXPECT_TRUE(add(8));
}

TEST_F(TransmitQueueTest, OneThatBlocksDropsNothing) {
    TransmitQueue blocking(7, capacity, true);
    add_to(blocking, 3);
    add_to(blocking, 4);
    EXPECT_FALSE(blocking.has_one_in_front());
    EXPECT_TRUE(add_to(blocking, 5));
    EXPECT_TRUE(blocking.has_one_in_front());
    EXPECT_TRUE(add_to(blocking, 6));
    EXPECT_FALSE(blocking.has_one_in_front());  // but two
    EXPECT_FALSE(blocking.begin_next());
    blocking.finish(MessageOutcome::sent);
    EXPECT_TRUE(blocking.begin_next());   // now all others fit in
    EXPECT_FALSE(blocking.begin_next());  // a retry
}

// Compared with a plain queue, for all lengths and back.
TEST(TransmitQueue, MatchesAPlainQueueOfThatCapacity) {
    constexpr std::size_t most = 20;
    TransmitQueue queue(7, most, false);
    std::deque<NodeId> waiting;
    std::optional<NodeId> in_progress;
    const Payload text = std::make_shared<const std::string>("text");
    RandomStream draws(1, 0, Purpose::protocol);
    for (NodeId receiver = 0; receiver < 5'000; ++receiver) {
        const bool grows = receiver / 100 % 2 == 0;
        if (draws.uniform() < (grows ? 0.6 : 0.4)) {
            Frame frame = queue.frame_of(receiver, text, 164, SimTime{});
            ASSERT_EQ(queue.add(frame), waiting.size() < most);
            if (waiting.size() < most) {
                waiting.push_back(receiver);
            }
        } else if (in_progress) {
            queue.finish(MessageOutcome::acknowledged);
            in_progress.reset();
        } else if (!waiting.empty()) {
            queue.begin_next();
            in_progress = waiting.front();
            waiting.pop_front();
        }
        ASSERT_EQ(queue.size(), waiting.size() + (in_progress ? 1 : 0));
        ASSERT_EQ(queue.is_in_progress(), in_progress.has_value());
        if (in_progress) {
            ASSERT_EQ(queue.in_progress()->receiver, *in_progress);
        }
    }
}

TEST_F(TransmitQueueTest, ChangesDoNotAffectAFrameOnTheAir) {
    add(3);
    queue.begin_next();
    const std::shared_ptr<const Frame> sent = queue.in_progress();
    queue.set_retry();
    queue.set_duration_field(SimTime::from_us(44));
    EXPECT_FALSE(sent->retry);
    EXPECT_EQ(sent->duration_field, SimTime());
    EXPECT_TRUE(queue.in_progress()->retry);
    EXPECT_EQ(queue.in_progress()->duration_field, SimTime::from_us(44));
    EXPECT_EQ(queue.in_progress()->sequence, sent->sequence);
}

TEST_F(TransmitQueueTest, ANoOpChangeKeepsTheFrame) {
    add(3);
    queue.begin_next();
    queue.set_retry();
    const std::shared_ptr<const Frame> retried = queue.in_progress();
    queue.set_retry();
    queue.set_duration_field(SimTime());
    EXPECT_EQ(queue.in_progress(), retried);
}

}  // namespace
}  // namespace netsim
