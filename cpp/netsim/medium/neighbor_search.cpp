#include "netsim/medium/neighbor_search.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "netsim/kernel/prefetch.hpp"

namespace netsim {

void NeighborSearch::add(RadioId radio, const Trajectory& trajectory) {
    radios_.push_back(Radio{radio, &trajectory});
    slack_m_ = -1;
}

void NeighborSearch::prepare(SimTime now, DisplacementBound& displacement, double reach_m) {
    now_ = now;
    if (std::isfinite(reach_m)) {
        reaches_m_ += reach_m;
        ++requests_;
    }
    moved_m_ = displacement.total_m(now) - total_m_;
    if (!(moved_m_ <= slack_m_) || is_of_wrong_size()) {
        displacement.refresh(now);
        build(now, requests_ > 0 ? reaches_m_ / static_cast<double>(requests_) : 0);
        total_m_ = displacement.total_m(now);
        course_changes_ = displacement.course_changes();
        stood_ = displacement.all_stand();
        rounding_m_ += 1e-12 * total_m_;
        moved_m_ = 0;
    }
    all_stand_ = stood_ && displacement.course_changes() == course_changes_;
}

bool NeighborSearch::is_of_wrong_size() const {
    const double wanted_m = reaches_m_ / static_cast<double>(requests_) / 2;
    return columns_ > 1 && requests_ > 1000 + 10 * radios_.size() &&
           (wanted_m < cell_m_ / 2 || wanted_m > cell_m_ * 2);
}

void NeighborSearch::build(SimTime now, double reach_m) {
    reaches_m_ = 0;
    requests_ = 0;
    // Half the reach: few cells to read, and most of the radios in them are within the reach.
    const bool is_small = radios_.size() < 32 || !(reach_m > 0);
    cell_m_ = reach_m > 0 ? std::max(reach_m / 2, 1e-3) : 1000;
    slack_m_ = cell_m_ / 4;
    columns_ = is_small ? 1 : std::bit_ceil(static_cast<std::size_t>(std::sqrt(radios_.size())));

    constexpr double infinite = std::numeric_limits<double>::infinity();
    lowest_ = {infinite, infinite, infinite};
    highest_ = {-infinite, -infinite, -infinite};
    std::vector<Position> places;
    std::vector<std::uint32_t> table_places;
    places.reserve(radios_.size());
    table_places.reserve(radios_.size());
    first_entry_.assign(columns_ * columns_ + 1, 0);
    for (const Radio& radio : radios_) {
        const Position place = radio.trajectory->position_at(now);
        lowest_ = {std::min(lowest_.x, place.x), std::min(lowest_.y, place.y), std::min(lowest_.z, place.z)};
        highest_ = {std::max(highest_.x, place.x), std::max(highest_.y, place.y),
                    std::max(highest_.z, place.z)};
        const std::size_t table_place = column_of(cell_of(place.y)) * columns_ + column_of(cell_of(place.x));
        places.push_back(place);
        table_places.push_back(static_cast<std::uint32_t>(table_place));
        ++first_entry_[table_place + 1];
    }
    for (std::size_t i = 1; i < first_entry_.size(); ++i) {
        first_entry_[i] += first_entry_[i - 1];
    }
    std::vector<std::uint32_t> next = first_entry_;
    entries_.resize(radios_.size() + batch - 1);  // the last batch is read to its end
    // Full batches, a partial one for each of the two ranges of a row, and those written after the
    // last one.
    batches_.resize(radios_.size() / batch + 2 * columns_ + usual_batches + 1);
    trajectories_.resize(radios_.size());
    for (std::size_t i = 0; i < radios_.size(); ++i) {
        const std::uint32_t entry = next[table_places[i]]++;
        entries_[entry] = {places[i], radios_[i].id};
        trajectories_[entry] = radios_[i].trajectory;
    }
    const Position largest{std::max(-lowest_.x, highest_.x), std::max(-lowest_.y, highest_.y),
                           std::max(-lowest_.z, highest_.z)};
    rounding_m_ = 1e-12 * std::max({largest.x, largest.y, largest.z, 0.0});
}

// Ranges are short and of unpredictable length. So the first loop has a fixed number of iterations,
// which the processor predicts. Only the rare longer ranges need the second.
NeighborSearch::Batch* NeighborSearch::add_batches(Batch* next, std::uint32_t first, std::uint32_t end) {
    for (std::uint32_t i = 0; i < usual_batches; ++i) {
        *next = {first + i * batch, end};
        next += first + i * batch < end ? 1 : 0;
    }
    for (std::uint32_t more = first + usual_batches * batch; more < end; more += batch) {
        *next++ = {more, end};
    }
    return next;
}

std::span<const NeighborSearch::Batch> NeighborSearch::batches_within(const Position& center,
                                                                      double radius_m) {
    Batch* const begin = batches_.data();
    const auto rows = static_cast<std::int64_t>(columns_);
    const std::int64_t first_row = cell_of(center.y - radius_m);
    const std::int64_t last_row = cell_of(center.y + radius_m);
    // Also true if the radius is infinite or NaN.
    if (!(radius_m < 1e150) || last_row - first_row >= rows) {
        return {begin, add_batches(begin, 0, static_cast<std::uint32_t>(radios_.size()))};
    }
    const std::int64_t first = cell_of(center.x - radius_m);
    const std::int64_t last = cell_of(center.x + radius_m);
    const bool is_all = last - first >= rows;
    const std::size_t from = is_all ? 0 : column_of(first);
    const std::size_t to = is_all ? columns_ : from + static_cast<std::size_t>(last - first) + 1;
    Batch* next = begin;
    for (std::int64_t row = first_row; row <= last_row; ++row) {
        const std::uint32_t* const first_entry = first_entry_.data() + column_of(row) * columns_;
        next = add_batches(next, first_entry[from], first_entry[std::min(to, columns_)]);
        if (to > columns_) {
            next = add_batches(next, first_entry[0], first_entry[to - columns_]);
        }
    }
    return {begin, next};
}

std::span<const NeighborSearch::Neighbor> NeighborSearch::near(const Position& center, double radius_m) {
    const double far_m = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    const double search_m = (radius_m + moved_m_) * (1 + 1e-9) + rounding_m_ + 1e-12 * far_m;
    const std::span<const Batch> batches = batches_within(center, search_m);
    const std::size_t needed = batches.size() * batch + 1;  // one more: the last write may not count
    if (near_.size() < needed) {
        near_.resize(needed);
        found_.resize(needed);
    }
    // Branch-free: half of the entries are too far away, and the processor cannot predict which.
    const double squared_m2 = search_m * search_m;
    std::size_t found = 0;
    const auto check_all = [&](const auto& store) {
        for (const Batch& each : batches) {
            for (std::uint32_t entry = each.first; entry < each.first + batch; ++entry) {
                store(entry);
                const bool is_too_far = squared_distance(center, entries_[entry].place) > squared_m2;
                found += static_cast<std::size_t>(!is_too_far) & static_cast<std::size_t>(entry < each.end);
            }
        }
    };
    if (all_stand_) {
        check_all([&](std::uint32_t entry) { near_[found] = entries_[entry]; });
        return {near_.data(), found};
    }
    check_all([&](std::uint32_t entry) { found_[found] = entry; });
    for (std::size_t i = 0; i < found; ++i) {
        prefetch_bytes(trajectories_[found_[i]], cache_line_bytes);
    }
    for (std::size_t i = 0; i < found; ++i) {
        near_[i] = {trajectories_[found_[i]]->position_at(now_), entries_[found_[i]].radio};
    }
    return {near_.data(), found};
}

double NeighborSearch::farthest_m(const Position& from) const {
    if (radios_.empty()) {
        return 0;
    }
    const Position to{std::max(from.x - lowest_.x, highest_.x - from.x),
                      std::max(from.y - lowest_.y, highest_.y - from.y),
                      std::max(from.z - lowest_.z, highest_.z - from.z)};
    return (distance({}, to) + moved_m_) * (1 + 1e-9) + rounding_m_;
}

}  // namespace netsim
