#include "netsim/propagation/ppdu_format.hpp"

#include <gtest/gtest.h>

namespace netsim {
namespace {

constexpr std::initializer_list<PpduFormat> every_format{PpduFormat::hr_dsss, PpduFormat::ofdm,
                                                         PpduFormat::erp_ofdm, PpduFormat::oqpsk};

TEST(PpduFormats, ContainWhatWasAddedAndNothingElse) {
    for (const PpduFormat one : every_format) {
        PpduFormats formats{};
        formats.add(one);
        for (const PpduFormat other : every_format) {
            EXPECT_EQ(formats.contains(other), one == other);
        }
    }
}

TEST(PpduFormats, AllAreAll) {
    for (const PpduFormat format : every_format) {
        EXPECT_TRUE(PpduFormats::all().contains(format));
    }
}

}  // namespace
}  // namespace netsim
