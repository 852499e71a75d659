#include "netsim/mac/tx_queue.hpp"

#include <deque>
#include <memory>

#include <gtest/gtest.h>

#include "netsim/kernel/random.hpp"

namespace netsim {
namespace {

std::shared_ptr<const Frame> frame_number(std::uint32_t sequence) {
    Frame frame;
    frame.sequence = sequence;
    return std::make_shared<const Frame>(frame);
}

TEST(TxQueue, IsEmptyAtFirst) {
    const TxQueue queue(3);
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.size(), 0U);
}

TEST(TxQueue, FirstInFirstOut) {
    TxQueue queue(3);
    for (std::uint32_t number = 1; number <= 3; ++number) {
        EXPECT_TRUE(queue.push(frame_number(number)));
    }
    for (std::uint32_t number = 1; number <= 3; ++number) {
        EXPECT_EQ(queue.pop()->sequence, number);
    }
    EXPECT_TRUE(queue.empty());
}

TEST(TxQueue, AFullQueueDropsTheNewcomer) {
    TxQueue queue(2);
    queue.push(frame_number(1));
    queue.push(frame_number(2));
    EXPECT_FALSE(queue.push(frame_number(3)));
    EXPECT_EQ(queue.size(), 2U);
    EXPECT_EQ(queue.pop()->sequence, 1U);
}

TEST(TxQueue, HasRoomAgainAfterAPop) {
    TxQueue queue(1);
    queue.push(frame_number(1));
    queue.pop();
    EXPECT_TRUE(queue.push(frame_number(2)));
}

// Beside a plain queue, through all lengths and back.
TEST(TxQueue, IsTheSameAsAPlainQueue) {
    constexpr std::size_t capacity = 20;
    TxQueue queue(capacity);
    std::deque<std::uint32_t> plain;
    RandomStream draws(1, 0, Purpose::protocol);
    for (std::uint32_t number = 0; number < 5'000; ++number) {
        const bool grows = number / 100 % 2 == 0;
        if (draws.uniform() < (grows ? 0.6 : 0.4)) {
            ASSERT_EQ(queue.push(frame_number(number)), plain.size() < capacity);
            if (plain.size() < capacity) {
                plain.push_back(number);
            }
        } else if (!plain.empty()) {
            ASSERT_EQ(queue.pop()->sequence, plain.front());
            plain.pop_front();
        }
        ASSERT_EQ(queue.size(), plain.size());
        ASSERT_EQ(queue.empty(), plain.empty());
    }
}

}  // namespace
}  // namespace netsim
