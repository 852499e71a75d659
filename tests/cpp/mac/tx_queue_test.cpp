#include "netsim/mac/tx_queue.hpp"

#include <memory>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace netsim
