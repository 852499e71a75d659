// What is made from a configuration, once for all who have the same one: mostly all nodes, or one of a few groups.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <utility>

namespace netsim {

template <typename Config, typename Kind>
class SharedKinds {
public:
    // `make(config)` makes one, if that of an equal configuration is not at hand.
    template <typename Make>
    std::shared_ptr<const Kind> of(const Config& config, const Make& make) {
        const auto known = std::ranges::find(
            latest_, config, [](const Known& latest) -> const Config& { return latest.config; });
        if (known != latest_.end()) {
            return known->kind;
        }
        // A few are enough for groups of nodes, and quick to look through where each node has its own.
        constexpr std::size_t most = 16;
        if (latest_.size() == most) {
            latest_.pop_back();
        }
        latest_.push_front({config, make(config)});
        return latest_.front().kind;
    }

private:
    struct Known {
        Config config;
        std::shared_ptr<const Kind> kind;
    };

    std::deque<Known> latest_;  // the newest first
};

}  // namespace netsim
