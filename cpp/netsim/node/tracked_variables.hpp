// What a protocol wants to be seen: named values that end up in the results of a run, as the tracked variables of a
// protocol in Python.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace netsim {

using TrackedValue = std::variant<bool, std::int64_t, double, std::string>;

class TrackedVariables {
public:
    // A new variable comes after those that are there; there are few of them.
    void set(std::string_view name, TrackedValue value) {
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
};

}  // namespace netsim
