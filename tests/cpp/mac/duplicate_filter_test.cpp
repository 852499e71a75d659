#include "netsim/mac/duplicate_filter.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

Frame data_frame(NodeId transmitter, std::uint32_t sequence, bool retry = false) {
    Frame frame;
    frame.kind = FrameKind::unicast;
    frame.transmitter = transmitter;
    frame.sequence = sequence;
    frame.retry = retry;
    return frame;
}

TEST(DuplicateFilter, ARetryOfTheLastFrameIsADuplicate) {
    DuplicateFilter filter;
    EXPECT_FALSE(filter.is_duplicate(data_frame(1, 7)));
    EXPECT_TRUE(filter.is_duplicate(data_frame(1, 7, true)));
    EXPECT_TRUE(filter.is_duplicate(data_frame(1, 7, true)));
}

TEST(DuplicateFilter, ARetryOfAFrameThatNeverCameIsNone) {
    DuplicateFilter filter;
    EXPECT_FALSE(filter.is_duplicate(data_frame(1, 7, true)));
    EXPECT_TRUE(filter.is_duplicate(data_frame(1, 7, true)));
}

TEST(DuplicateFilter, ARetryOfTheNextFrameIsNone) {
    DuplicateFilter filter;
    filter.is_duplicate(data_frame(1, 7));
    EXPECT_FALSE(filter.is_duplicate(data_frame(1, 8, true)));
}

TEST(DuplicateFilter, TransmittersCountApart) {
    DuplicateFilter filter;
    filter.is_duplicate(data_frame(1, 7));
    EXPECT_FALSE(filter.is_duplicate(data_frame(2, 7, true)));
    EXPECT_TRUE(filter.is_duplicate(data_frame(1, 7, true)));
}

TEST(DuplicateFilter, SequenceZeroIsLikeAnyOther) {
    DuplicateFilter filter;
    EXPECT_FALSE(filter.is_duplicate(data_frame(1, 0)));
    EXPECT_TRUE(filter.is_duplicate(data_frame(1, 0, true)));
}

}  // namespace
}  // namespace netsim
