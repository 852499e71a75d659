#include "netsim/mac/frame_fifo.hpp"

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

TEST(FrameFifo, IsEmptyAtFirst) {
    const FrameFifo queue;
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.size(), 0U);
}

TEST(FrameFifo, FirstInFirstOut) {
    FrameFifo queue;
    for (std::uint32_t number = 1; number <= 3; ++number) {
        queue.push(frame_number(number));
    }
    for (std::uint32_t number = 1; number <= 3; ++number) {
        EXPECT_EQ(queue.front()->sequence, number);
        queue.pop();
    }
    EXPECT_TRUE(queue.empty());
}

// Compared with a plain queue, for all lengths and back.
TEST(FrameFifo, MatchesAPlainQueue) {
    FrameFifo queue;
    std::deque<std::uint32_t> plain;
    RandomStream draws(1, 0, Purpose::protocol);
    for (std::uint32_t number = 0; number < 5'000; ++number) {
        const bool grows = number / 100 % 2 == 0;
        if (draws.uniform() < (grows ? 0.6 : 0.4)) {
            queue.push(frame_number(number));
            plain.push_back(number);
        } else if (!plain.empty()) {
            queue.pop();
            plain.pop_front();
        }
        ASSERT_EQ(queue.size(), plain.size());
        ASSERT_EQ(queue.empty(), plain.empty());
        if (!plain.empty()) {
            ASSERT_EQ(queue.front()->sequence, plain.front());
        }
    }
}

}  // namespace
}  // namespace netsim
