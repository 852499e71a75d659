#include "netsim/medium/interference.hpp"

#include <algorithm>
#include <cmath>

namespace netsim {
namespace {

// A sum from which terms are also subtracted. The rounding error is stored separately, so that the
// power of a weak frame is still exact after a strong one ended. A. Neumaier, "Rundungsfehleranalyse
// einiger Verfahren zur Summation endlicher Summen", 1974.
class CompensatedSum {
public:
    void add(double term) {
        const double sum = sum_ + term;
        lost_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
        sum_ = sum;
    }
    double value() const { return sum_ + lost_; }

private:
    double sum_ = 0;
    double lost_ = 0;
};

}  // namespace

void InterferenceSum::find_changes() {
    starts_.clear();
    ends_.clear();
    for (const Other& other : others_) {
        starts_.push_back({std::max(other.start, start_), other.power_w});
        if (other.end < end_) {
            ends_.push_back({other.end, other.power_w});
        }
    }
    // Usually sorted already: frames that began earlier end earlier.
    const auto sort_by_time = [](std::vector<Change>& changes) {
        if (!std::ranges::is_sorted(changes, {}, &Change::time)) {
            std::ranges::sort(changes, {}, &Change::time);
        }
    };
    sort_by_time(starts_);
    sort_by_time(ends_);
}

void InterferenceSum::find_moments() {
    find_changes();
    moments_.clear();
    double sum_w = 0;
    auto end = ends_.begin();
    for (const Change& start : starts_) {
        for (; end != ends_.end() && end->time <= start.time; ++end) {
            sum_w -= end->power_w;
        }
        sum_w += start.power_w;
        if (moments_.empty() || moments_.back().time != start.time) {
            moments_.push_back({start.time, 0});
        }
        moments_.back().sum_w = sum_w;
    }
}

double InterferenceSum::sum_w_at(SimTime moment) const {
    double sum_w = 0;
    for (const Other& other : others_) {
        if (other.start <= moment && moment < other.end) {
            sum_w += other.power_w;
        }
    }
    return sum_w;
}

SimTime InterferenceSum::worst_moment() {
    if (!worst_moment_) {
        worst_moment_ = find_worst_moment();
    }
    return *worst_moment_;
}

SimTime InterferenceSum::find_worst_moment() {
    if (others_.size() == 1) {
        return std::max(others_.front().start, start_);
    }
    find_moments();  // one of them is the worst moment: the sum rises only where a frame starts
    const double max_w = std::ranges::max(moments_, {}, &Moment::sum_w).sum_w;
    // Moments whose sums differ only by rounding are compared by their exact sums.
    constexpr double nearly = 1 - 1e-9;
    std::erase_if(moments_, [max_w](const Moment& moment) { return moment.sum_w < max_w * nearly; });
    if (moments_.size() == 1) {
        return moments_.front().time;
    }
    SimTime worst = start_;
    double largest_w = 0;
    for (const Other& candidate : others_) {
        const SimTime time = std::max(candidate.start, start_);
        const auto found = std::ranges::find(moments_, time, &Moment::time);
        if (found == moments_.end()) {
            continue;
        }
        moments_.erase(found);
        const double sum_w = sum_w_at(time);
        if (sum_w > largest_w) {
            largest_w = sum_w;
            worst = time;
        }
    }
    return worst;
}

double InterferenceSum::worst_w() {
    return others_.empty() ? 0 : sum_w_at(worst_moment());
}

const std::vector<NodeId>& InterferenceSum::interferers() {
    interferers_.clear();
    if (others_.empty()) {
        return interferers_;
    }
    strongest_.clear();
    const SimTime worst = worst_moment();
    for (const Other& other : others_) {
        if (other.start <= worst && worst < other.end) {
            strongest_.push_back(&other);
        }
    }
    std::ranges::sort(strongest_, [](const Other* a, const Other* b) {
        return a->power_w != b->power_w ? a->power_w > b->power_w
                                        : a->transmission->id() < b->transmission->id();
    });
    const double all_w = sum_w_at(worst);
    double named_w = 0;
    double last_w = 0;
    for (const Other* other : strongest_) {
        if (named_w > all_w - named_w && other->power_w < last_w) {
            break;
        }
        named_w += other->power_w;
        last_w = other->power_w;
        const NodeId sender = other->transmission->sender.node;
        if (std::ranges::find(interferers_, sender) == interferers_.end()) {
            interferers_.push_back(sender);
        }
    }
    return interferers_;
}

double InterferenceSum::worst_w_of(NodeId node) {
    const SimTime worst = worst_moment();
    double sum_w = 0;
    for (const Other& other : others_) {
        if (other.transmission->sender.node == node && other.start <= worst && worst < other.end) {
            sum_w += other.power_w;
        }
    }
    return sum_w;
}

const std::vector<InterferenceStep>& InterferenceSum::steps() {
    steps_.assign(1, InterferenceStep{start_, 0});
    find_changes();
    CompensatedSum sum;
    int count = 0;
    auto start = starts_.begin();
    auto end = ends_.begin();
    while (start != starts_.end() || end != ends_.end()) {
        const SimTime time = end == ends_.end() || (start != starts_.end() && start->time < end->time)
                                 ? start->time
                                 : end->time;
        for (; start != starts_.end() && start->time == time; ++start) {
            sum.add(start->power_w);
            ++count;
        }
        for (; end != ends_.end() && end->time == time; ++end) {
            sum.add(-end->power_w);
            --count;
        }
        if (count == 0) {
            sum = CompensatedSum();  // exactly 0
        }
        if (time == start_) {
            steps_.front().power_w = sum.value();
        } else if (sum.value() != steps_.back().power_w) {
            steps_.push_back({time, sum.value()});
        }
    }
    return steps_;
}

}  // namespace netsim
