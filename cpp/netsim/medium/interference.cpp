#include "netsim/medium/interference.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

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
        worst_moment_ = noise_.empty() ? find_worst_moment() : find_worst_moment_with_noise();
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

double InterferenceSum::noise_w_at(SimTime moment) const {
    const auto next = std::ranges::upper_bound(noise_, moment, {}, &InterferenceStep::start);
    return next == noise_.begin() ? 0 : std::prev(next)->power_w;
}

double InterferenceSum::max_noise_w() const {
    return noise_.empty() ? 0 : std::ranges::max(noise_, {}, &InterferenceStep::power_w).power_w;
}

// The sum rises only where a frame starts or the noise changes.
SimTime InterferenceSum::find_worst_moment_with_noise() const {
    SimTime worst = std::max(others_.front().start, start_);
    double largest_w = 0;
    const auto compare = [&](SimTime moment) {
        const double frames_w = sum_w_at(moment);
        if (frames_w > 0 && frames_w + noise_w_at(moment) > largest_w) {
            largest_w = frames_w + noise_w_at(moment);
            worst = moment;
        }
    };
    for (const Other& other : others_) {
        compare(std::max(other.start, start_));
    }
    for (const InterferenceStep& noise : noise_) {
        compare(noise.start);
    }
    return worst;
}

double InterferenceSum::worst_w() {
    const double with_frames_w = others_.empty() ? 0 : worst_frames_w() + noise_w_at(worst_moment());
    return std::max(with_frames_w, max_noise_w());
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
    if (!noise_.empty()) {
        add_noise_to_steps();
    }
    return steps_;
}

void InterferenceSum::add_noise_to_steps() {
    frame_steps_.swap(steps_);
    steps_.clear();
    std::size_t frame = 0;
    std::size_t noise = 0;
    while (frame < frame_steps_.size() || noise < noise_.size()) {
        const bool is_frame_next =
            noise == noise_.size() ||
            (frame < frame_steps_.size() && frame_steps_[frame].start <= noise_[noise].start);
        const SimTime time = is_frame_next ? frame_steps_[frame].start : noise_[noise].start;
        for (; frame < frame_steps_.size() && frame_steps_[frame].start == time; ++frame) {
        }
        for (; noise < noise_.size() && noise_[noise].start == time; ++noise) {
        }
        const double sum_w =
            (frame == 0 ? 0 : frame_steps_[frame - 1].power_w) + (noise == 0 ? 0 : noise_[noise - 1].power_w);
        if (steps_.empty() || sum_w != steps_.back().power_w) {
            steps_.push_back({time, sum_w});
        }
    }
}

}  // namespace netsim
