// The arrivals that last at one radio at the moment, in the order of their transmissions, whenever the radio is told of them:
// how their sum is rounded must not depend on that. The radio may be locked on to one of them.
//
// Mostly there is one. That lies in the radio itself, in a cache line that the medium fetches ahead: in a large network any
// memory beside that is in no cache. Several lie together elsewhere.
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
        // Mostly the last place.
        const auto is_later = [](std::uint64_t id, const PresentArrival& other) {
            return id < other.transmission->id;
        };
        std::vector<PresentArrival>& all = content_.several->arrivals;
        all.insert(std::upper_bound(all.begin(), all.end(), arrival.transmission->id, is_later), arrival);
    }

    // That of `transmission`, which is among them, and which the radio is not locked on to any more.
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

    // Only while the radio is not locked, on to one of them.
    void lock_on(const Transmission* transmission) {
        NETSIM_ASSERT(!is_locked_);
        is_locked_ = true;
        if (count_ == Count::several) {
            content_.several->locked = transmission;
        } else {
            NETSIM_ASSERT(count_ == Count::one && content_.one.transmission == transmission);
        }
    }
    // Returns what it was locked on to. Only while it is.
    const Transmission& unlock() {
        const Transmission* const was_locked = locked();
        NETSIM_ASSERT(was_locked != nullptr);
        is_locked_ = false;
        return *was_locked;
    }
    bool is_locked() const { return is_locked_; }
    // What the radio is locked on to; null if it is not.
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
        const Transmission* locked = nullptr;  // of no account while the radio is not
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
