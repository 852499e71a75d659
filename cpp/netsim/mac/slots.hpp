// Objects with numbers, which events refer to: the lambda of an event captures only pointers and numbers.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace netsim {

template <typename Object>
class Slots {
public:
    // Returns the number of the object. Numbers of objects that were taken are used again.
    std::size_t add(Object object) {
        if (free_.empty()) {
            objects_.push_back(std::move(object));
            return objects_.size() - 1;
        }
        const std::size_t slot = free_.back();
        free_.pop_back();
        objects_[slot] = std::move(object);
        return slot;
    }
    Object& operator[](std::size_t slot) { return objects_[slot]; }
    // Removes the object and returns it.
    Object take(std::size_t slot) {
        free_.push_back(slot);
        return std::move(objects_[slot]);
    }

private:
    std::vector<Object> objects_;
    std::vector<std::size_t> free_;
};

}  // namespace netsim
