// Tracked variables: named values that a protocol adds to the results of a run, as in Python.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace netsim {

using TrackedValue = std::variant<bool, std::int64_t, double, std::string>;

class TrackedVariables {
public:
    // Called for each assignment, even if the value does not change.
    using OnSet = std::function<void(std::string_view name, const TrackedValue& value)>;

    void observe(OnSet on_set) { on_set_ = std::move(on_set); }
    // Sets a variable, or appends a new one. Linear search: there are few.
    void set(std::string_view name, TrackedValue value) {
        if (on_set_) {
            on_set_(name, value);
        }
        for (auto& [known, old] : values_) {
            if (known == name) {
                old = std::move(value);
                return;
            }
        }
        values_.emplace_back(name, std::move(value));
    }
    const std::vector<std::pair<std::string, TrackedValue>>& values() const { return values_; }

private:
    std::vector<std::pair<std::string, TrackedValue>> values_;
    OnSet on_set_;
};

}  // namespace netsim
