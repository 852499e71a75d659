// Models created from configurations, one for all nodes with equal configurations.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <memory>
#include <utility>

namespace netsim {

template <typename Config, typename Model>
class SharedModels {
public:
    // The model of an equal configuration, or a new one from `make(config)`.
    template <typename Make>
    std::shared_ptr<const Model> of(const Config& config, const Make& make) {
        const auto known = std::ranges::find(
            latest_, config, [](const Known& latest) -> const Config& { return latest.config; });
        if (known != latest_.end()) {
            return known->model;
        }
        // A few suffice for groups of nodes. If each node has its own configuration, searching a few
        // is fast.
        constexpr std::size_t max_size = 16;
        if (latest_.size() == max_size) {
            latest_.pop_back();
        }
        latest_.push_front({config, make(config)});
        return latest_.front().model;
    }

private:
    struct Known {
        Config config;
        std::shared_ptr<const Model> model;
    };

    std::deque<Known> latest_;  // the newest first
};

}  // namespace netsim
