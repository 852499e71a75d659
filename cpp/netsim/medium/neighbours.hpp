// Who is near a place: a grid over the positions of radios.
//
// The plane is cut into square cells (heights do not count here), and the cells are folded on to a table of fixed
// size, row by row, so that coordinates of any size will do: cells far from each other may share a place in the table,
// which costs time but no truth. The radios of a row of cells lie side by side in memory.
//
// Nodes move without telling the grid. It keeps the places where they were when it was laid out, looks so much
// farther than it is asked to as they can have moved since, and is laid out anew when that is too much.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/medium/interface_id.hpp"
#include "netsim/medium/odometer.hpp"

namespace netsim {

class Neighbours {
public:
    // The trajectory must be watched by the odometer that `prepare` gets.
    void add(RadioId radio, const Trajectory& trajectory);
    std::size_t size() const { return radios_.size(); }

    // Before each instant's `visit` and `farthest_m`. `reach_m` is a distance that will be asked for: the size of
    // the cells follows those that are usual.
    void prepare(SimTime now, Odometer& odometer, double reach_m);

    // Calls visitor(radio, position now) for all radios within `radius_m` of `centre`, and some others near by, in an
    // order that depends on nothing but the nodes' positions. An infinite radius visits all.
    template <typename Visitor>
    void visit(const Position& centre, double radius_m, Visitor&& visitor) const;

    // No node is farther away from there.
    double farthest_m(const Position& from) const;

private:
    struct Radio {
        RadioId id;
        const Trajectory* trajectory;
    };
    struct Entry {
        Position place;  // where it was when the grid was laid out
        RadioId id = 0;
        const Trajectory* trajectory = nullptr;
    };

    void lay_out(SimTime now, double reach_m);
    // Cells are much smaller or larger than they had better be.
    bool is_of_wrong_size() const;

    std::int64_t cell_of(double coordinate_m) const {
        constexpr double most = 1e15;  // so that all differences fit
        return static_cast<std::int64_t>(std::clamp(std::floor(coordinate_m / cell_m_), -most, most));
    }
    std::size_t column_of(std::int64_t cell) const {
        return static_cast<std::size_t>(cell) & (columns_ - 1);  // a power of two
    }
    // Has those of a row brought into the cache; which of them are near is not known before they are there.
    void fetch_row(std::size_t row, std::size_t first, std::size_t end) const {
        const Entry* const last = entries_.data() + first_entry_[row * columns_ + end];
        for (const Entry* entry = entries_.data() + first_entry_[row * columns_ + first]; entry < last;
             ++entry) {
            __builtin_prefetch(entry);
        }
    }
    template <typename Visitor>
    void visit_row(std::size_t row, std::size_t first, std::size_t end, const Position& centre,
                   double squared_radius_m2, Visitor&& visitor) const;

    std::vector<Radio> radios_;
    std::vector<Entry> entries_;              // by place in the table
    std::vector<std::uint32_t> first_entry_;  // of each place in the table, and the end
    std::size_t columns_ = 1;                 // and as many rows
    double cell_m_ = 1;
    Position lowest_;
    Position highest_;
    double rounding_m_ = 0;  // of coordinates as large as those of the nodes
    SimTime now_;

    // Of the time when it was laid out, and of what happened since.
    double slack_m_ = -1;  // how far nodes may have moved; less than 0: not laid out
    double reading_m_ = 0;
    std::uint64_t course_changes_ = 0;
    bool stood_ = false;      // all nodes, then
    double moved_m_ = 0;      // at most, since then
    bool all_stand_ = false;  // where they were then, exactly
    double reaches_m_ = 0;    // sum of those asked for
    std::uint64_t asked_ = 0;
};

template <typename Visitor>
void Neighbours::visit(const Position& centre, double radius_m, Visitor&& visitor) const {
    const double far_m = std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)});
    const double search_m = (radius_m + moved_m_) * (1 + 1e-9) + rounding_m_ + 1e-12 * far_m;
    const double squared_m2 = search_m * search_m;
    const auto rows = static_cast<std::int64_t>(columns_);
    const std::int64_t first_row = cell_of(centre.y - search_m);
    const std::int64_t last_row = cell_of(centre.y + search_m);
    // Also if the radius is infinite or no number.
    if (!(squared_m2 < 1e300) || last_row - first_row >= rows) {
        for (std::size_t row = 0; row < columns_; ++row) {
            visit_row(row, 0, columns_, centre, squared_m2, visitor);
        }
        return;
    }
    const std::int64_t first = cell_of(centre.x - search_m);
    const std::int64_t last = cell_of(centre.x + search_m);
    if (last - first < rows) {
        const std::size_t begin = column_of(first);
        const std::size_t end = std::min(begin + static_cast<std::size_t>(last - first) + 1, columns_);
        for (std::int64_t row = first_row; row <= last_row; ++row) {
            fetch_row(column_of(row), begin, end);
        }
    }
    for (std::int64_t row = first_row; row <= last_row; ++row) {
        if (last - first >= rows) {
            visit_row(column_of(row), 0, columns_, centre, squared_m2, visitor);
            continue;
        }
        const std::size_t begin = column_of(first);
        const std::size_t end = begin + static_cast<std::size_t>(last - first) + 1;
        visit_row(column_of(row), begin, std::min(end, columns_), centre, squared_m2, visitor);
        if (end > columns_) {
            visit_row(column_of(row), 0, end - columns_, centre, squared_m2, visitor);
        }
    }
}

template <typename Visitor>
void Neighbours::visit_row(std::size_t row, std::size_t first, std::size_t end, const Position& centre,
                           double squared_radius_m2, Visitor&& visitor) const {
    const Entry* entry = entries_.data() + first_entry_[row * columns_ + first];
    const Entry* const last = entries_.data() + first_entry_[row * columns_ + end];
    for (; entry != last; ++entry) {
        if (squared_distance(centre, entry->place) > squared_radius_m2) {
            continue;
        }
        visitor(entry->id, all_stand_ ? entry->place : entry->trajectory->position_at(now_));
    }
}

}  // namespace netsim
