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
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/medium/odometer.hpp"

namespace netsim {

class Neighbours {
public:
    // The trajectory must be watched by the odometer that `prepare` gets.
    void add(RadioId radio, const Trajectory& trajectory);
    std::size_t size() const { return radios_.size(); }

    // Before each instant's `near` and `farthest_m`. `reach_m` is a distance that will be asked for: the size of
    // the cells follows those that are usual.
    void prepare(SimTime now, Odometer& odometer, double reach_m);

    struct Near {        // half a cache line: of all that is read for a transmission, this is read most often
        Position place;  // now
        RadioId radio = 0;
    };
    // All within `radius_m` of `centre`, and some others near by, in an order that depends on nothing but the nodes'
    // positions; everybody, if the radius is infinite. Valid until the next call.
    std::span<const Near> near(const Position& centre, double radius_m);

    // No node is farther away from there.
    double farthest_m(const Position& from) const;

private:
    struct Radio {
        RadioId id;
        const Trajectory* trajectory;
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
    // So many entries that lie side by side, or those of them before `end`.
    static constexpr std::uint32_t bunch = 4;
    static constexpr std::uint32_t usual_bunches = 4;  // no more for most runs of entries in a row
    struct Bunch {
        std::uint32_t first = 0;
        std::uint32_t end = 0;
    };
    // The entries of the cells that are within the radius, row by row. Valid until the next call.
    std::span<const Bunch> bunches_within(const Position& centre, double radius_m);
    // Those from `first` until before `end`, at `next` and after it; returns where they end.
    static Bunch* add_bunches(Bunch* next, std::uint32_t first, std::uint32_t end);

    std::vector<Radio> radios_;
    std::vector<Near> entries_;  // where they were when the grid was laid out, by place in the table
    std::vector<const Trajectory*> trajectories_;  // of theirs
    std::vector<std::uint32_t> first_entry_;       // of each place in the table, and the end
    std::size_t columns_ = 1;                      // and as many rows
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

    std::vector<Bunch> bunches_;        // the answer of bunches_within, reused
    std::vector<std::uint32_t> found_;  // entries
    std::vector<Near> near_;            // the answer of near, reused
};

}  // namespace netsim
