// The arrivals that last at one radio at the moment, in the order of their transmissions, whenever the radio is told of them:
// how their sum is rounded must not depend on that.
//
// Mostly there is one. That lies in the radio itself: a store to memory that is in no cache holds up what
// comes after it, and in a large network any memory beside the radio is in none.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "netsim/error.hpp"
#include "netsim/medium/transmission.hpp"

namespace netsim {

struct PresentArrival {
    const Transmission* transmission = nullptr;
    double power_w = 0;
};

class PresentArrivals {
public:
    bool empty() const { return count_ == 0; }
    std::span<const PresentArrival> all() const { return {begin(), count_}; }

    void add(const PresentArrival& arrival) {
        if (count_ < few_.size()) {
            few_[count_] = arrival;
        } else {
            if (count_ == few_.size()) {
                move_to_many();
            }
            // Mostly the last place.
            const auto is_later = [](std::uint64_t id, const PresentArrival& other) {
                return id < other.transmission->id;
            };
            many_->insert(std::upper_bound(many_->begin(), many_->end(), arrival.transmission->id, is_later),
                          arrival);
        }
        ++count_;
    }

    // That of `transmission`, which is among them.
    void remove(const Transmission* transmission) {
        PresentArrival* const end = begin() + count_;
        PresentArrival* const found = std::find_if(
            begin(), end,
            [transmission](const PresentArrival& present) { return present.transmission == transmission; });
        NETSIM_ASSERT(found != end);
        std::copy(found + 1, end, found);
        if (count_ > few_.size()) {
            many_->pop_back();
            if (many_->size() == few_.size()) {
                std::ranges::copy(*many_, few_.begin());
            }
        }
        --count_;
    }

private:
    static constexpr std::size_t few = 1;

    const PresentArrival* begin() const { return count_ > few ? many_->data() : few_.data(); }
    PresentArrival* begin() { return count_ > few ? many_->data() : few_.data(); }
    void move_to_many() {
        if (!many_) {
            many_ = std::make_unique<std::vector<PresentArrival>>();
        }
        many_->assign(few_.begin(), few_.end());
    }

    std::array<PresentArrival, few> few_;                // all of them, if they are not more
    std::unique_ptr<std::vector<PresentArrival>> many_;  // all of them otherwise
    std::uint32_t count_ = 0;
};

}  // namespace netsim
