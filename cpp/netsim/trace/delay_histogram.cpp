#include "netsim/trace/delay_histogram.hpp"

#include <numeric>

namespace netsim {

std::uint64_t DelayHistogram::count() const {
    return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

std::vector<DelayHistogram::Bin> DelayHistogram::bins() const {
    std::vector<Bin> all;
    for (std::size_t index = 0; index < counts_.size(); ++index) {
        if (counts_[index] != 0) {
            all.push_back({begin_of(index), begin_of(index + 1), counts_[index]});
        }
    }
    return all;
}

}  // namespace netsim
