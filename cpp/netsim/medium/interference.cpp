#include "netsim/medium/interference.hpp"

#include <algorithm>
#include <cmath>

namespace netsim {
namespace {

// A sum that also loses terms again. What rounding takes from it is kept beside it, so that a weak frame that outlasts
// a strong one is still right when that has gone. A. Neumaier, "Rundungsfehleranalyse einiger Verfahren zur Summation
// endlicher Summen", 1974.
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

void InterferenceSum::begin(SimTime start, SimTime end) {
    start_ = start;
    end_ = end;
    others_.clear();
}

void InterferenceSum::add(const Arrival& other) {
    if (other.start < end_ && other.end > start_ && other.power_w > 0) {
        others_.push_back(other);
    }
}

template <typename Visitor>
void InterferenceSum::sweep(Visitor&& visitor) {
    changes_.clear();
    for (const Arrival& other : others_) {
        changes_.push_back({std::max(other.start, start_), true, other.power_w});
        if (other.end < end_) {
            changes_.push_back({other.end, false, other.power_w});
        }
    }
    std::sort(changes_.begin(), changes_.end(),
              [](const Change& a, const Change& b) { return a.time < b.time; });
    CompensatedSum sum;
    int count = 0;
    for (auto change = changes_.begin(); change != changes_.end();) {
        const SimTime time = change->time;
        for (; change != changes_.end() && change->time == time; ++change) {
            sum.add(change->is_start ? change->power_w : -change->power_w);
            count += change->is_start ? 1 : -1;
        }
        if (count == 0) {
            sum = CompensatedSum();  // exactly nothing
        }
        visitor(time, sum.value());
    }
}

double InterferenceSum::sum_w_at(SimTime moment) const {
    double sum_w = 0;
    for (const Arrival& other : others_) {
        if (other.start <= moment && moment < other.end) {
            sum_w += other.power_w;
        }
    }
    return sum_w;
}

const Interference& InterferenceSum::worst() {
    worst_.max_power_w = 0;
    worst_.interferers.clear();
    if (others_.empty()) {
        return worst_;
    }
    SimTime worst = std::max(others_.front().start, start_);
    if (others_.size() > 1) {
        // Moments that differ by no more than rounding are told apart by their exact sums.
        constexpr double nearly = 1 - 1e-9;
        double most_w = 0;
        sweep([&](SimTime, double sum_w) { most_w = std::max(most_w, sum_w); });
        moments_.clear();
        sweep([&](SimTime time, double sum_w) {
            if (sum_w >= most_w * nearly) {
                moments_.push_back(time);
            }
        });
        if (moments_.size() == 1) {
            worst = moments_.front();
        } else {
            double largest_w = 0;
            for (const Arrival& candidate : others_) {
                const SimTime moment = std::max(candidate.start, start_);
                const auto found = std::find(moments_.begin(), moments_.end(), moment);
                if (found == moments_.end()) {
                    continue;
                }
                moments_.erase(found);
                const double sum_w = sum_w_at(moment);
                if (sum_w > largest_w) {
                    largest_w = sum_w;
                    worst = moment;
                }
            }
        }
    }
    for (const Arrival& other : others_) {
        if (other.start > worst || worst >= other.end) {
            continue;
        }
        worst_.max_power_w += other.power_w;
        const NodeId sender = other.transmission->sender.node;
        auto& interferers = worst_.interferers;
        if (std::find(interferers.begin(), interferers.end(), sender) == interferers.end()) {
            interferers.push_back(sender);
        }
    }
    return worst_;
}

const std::vector<InterferenceStep>& InterferenceSum::steps() {
    steps_.assign(1, InterferenceStep{start_, 0});
    sweep([this](SimTime time, double power_w) {
        if (time == start_) {
            steps_.front().power_w = power_w;
        } else if (power_w != steps_.back().power_w) {
            steps_.push_back({time, power_w});
        }
    });
    return steps_;
}

}  // namespace netsim
