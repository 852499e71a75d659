// The arrivals currently at one radio. They are in the order of their transmissions, so that the
// rounding of their sum does not depend on the order of notifications. The radio may be locked on to
// one of them.
//
// A single arrival, the usual case, is stored in the radio itself, in a cache line that the medium
// prefetches. Several arrivals are stored on the heap.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "netsim/error.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

struct PresentArrival {
    const Transmission* transmission = nullptr;
    double power_w = 0;
};

class PresentArrivals {
public:
    PresentArrivals() = default;
    PresentArrivals(const PresentArrivals&) = delete;
    PresentArrivals& operator=(const PresentArrivals&) = delete;
    ~PresentArrivals() {
        if (count_ == Count::several) {
            delete content_.several;
        }
    }

    bool empty() const { return count_ == Count::none; }
    std::span<const PresentArrival> all() const {
        return count_ == Count::several ? std::span<const PresentArrival>(content_.several->arrivals)
                                        : std::span(&content_.one, count_ == Count::one ? 1 : 0);
    }

    void add(const PresentArrival& arrival) {
        if (count_ == Count::none) {
            content_.one = arrival;
            count_ = Count::one;
            return;
        }
        if (count_ == Count::one) {
            content_.several = new Several{.arrivals = {content_.one}, .locked = content_.one.transmission};
            count_ = Count::several;
        }
        // Usually inserted at the end.
        const auto is_later = [](std::uint64_t id, const PresentArrival& other) {
            return id < other.transmission->id();
        };
        std::vector<PresentArrival>& all = content_.several->arrivals;
        all.insert(std::upper_bound(all.begin(), all.end(), arrival.transmission->id(), is_later), arrival);
    }

    // Removes the arrival of `transmission`. It must be present, and the radio not locked on to it.
    void remove(const Transmission* transmission) {
        if (count_ == Count::one) {
            NETSIM_ASSERT(content_.one.transmission == transmission && !is_locked_);
            count_ = Count::none;
            return;
        }
        NETSIM_ASSERT(count_ == Count::several && locked() != transmission);
        std::vector<PresentArrival>& all = content_.several->arrivals;
        const auto found = std::ranges::find(all, transmission, &PresentArrival::transmission);
        NETSIM_ASSERT(found != all.end());
        all.erase(found);
        if (all.size() == 1) {
            const PresentArrival last = all.front();
            delete content_.several;
            content_.one = last;
            count_ = Count::one;
        }
    }

    // Locks on to a present arrival. Only while the radio is not locked.
    void lock_on(const Transmission* transmission) {
        NETSIM_ASSERT(!is_locked_);
        is_locked_ = true;
        if (count_ == Count::several) {
            content_.several->locked = transmission;
        } else {
            NETSIM_ASSERT(count_ == Count::one && content_.one.transmission == transmission);
        }
    }
    // Returns the transmission that the radio was locked on to. Only while it is locked.
    const Transmission& unlock() {
        const Transmission* const was_locked = locked();
        NETSIM_ASSERT(was_locked != nullptr);
        is_locked_ = false;
        return *was_locked;
    }
    bool is_locked() const { return is_locked_; }
    // The transmission that the radio is locked on to, or null.
    const Transmission* locked() const {
        if (!is_locked_) {
            return nullptr;
        }
        return count_ == Count::several ? content_.several->locked : content_.one.transmission;
    }

private:
    enum class Count : std::uint8_t { none, one, several };
    struct Several {
        std::vector<PresentArrival> arrivals;
        const Transmission* locked = nullptr;  // ignored while the radio is not locked
    };

    union Content {
        PresentArrival one{};
        Several* several;  // owned
    };

    Content content_;
    Count count_ = Count::none;
    bool is_locked_ = false;
};

}  // namespace netsim
