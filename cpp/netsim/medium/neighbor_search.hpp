// The radios near a place, found with a grid over their positions.
//
// The plane is divided into square cells; heights are ignored. Cells map to a table of fixed size,
// row by row, so coordinates of any size work. Distant cells may share a table slot, which costs
// time but does not change results. The radios of a row of cells are contiguous in memory.
//
// Nodes do not notify the grid when they move. It stores their positions at the time it was built,
// and widens each search by the distance that they may have moved since. When that gets too large,
// the grid is rebuilt.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "netsim/geometry/position.hpp"
#include "netsim/interface_id.hpp"
#include "netsim/medium/displacement_bound.hpp"

namespace netsim {

class NeighborSearch {
public:
    // The DisplacementBound passed to `prepare` must watch the trajectory.
    void add(RadioId radio, const Trajectory& trajectory);
    std::size_t size() const { return radios_.size(); }

    // Call it at each instant before `near` and `farthest_m`. `reach_m`: a typical radius of the
    // searches, which determines the cell size.
    void prepare(SimTime now, DisplacementBound& displacement, double reach_m);

    struct Neighbor {    // half a cache line: the data that transmissions read most
        Position place;  // now
        RadioId radio = 0;
    };
    // All radios within `radius_m` of `center`, and some others nearby; all radios if the radius is
    // infinite. The order depends only on the nodes' positions. Valid until the next call.
    std::span<const Neighbor> near(const Position& center, double radius_m);

    // An upper bound in m for the distance from `from` to any node.
    double farthest_m(const Position& from) const;

private:
    struct Radio {
        RadioId id;
        const Trajectory* trajectory;
    };

    void build(SimTime now, double reach_m);
    bool is_of_wrong_size() const;

    std::int64_t cell_of(double coordinate_m) const {
        constexpr double most = 1e15;  // so that all differences fit
        return static_cast<std::int64_t>(std::clamp(std::floor(coordinate_m / cell_m_), -most, most));
    }
    std::size_t column_of(std::int64_t cell) const {
        return static_cast<std::size_t>(cell) & (columns_ - 1);  // a power of two
    }
    // Entries are read in batches: `batch` contiguous ones, or fewer if `end` comes first.
    static constexpr std::uint32_t batch = 4;
    static constexpr std::uint32_t usual_batches = 4;  // enough for most ranges of entries
    struct Batch {
        std::uint32_t first = 0;
        std::uint32_t end = 0;
    };
    // The entries of the cells within the radius, row by row. Valid until the next call.
    std::span<const Batch> batches_within(const Position& center, double radius_m);
    // Writes the batches from `first` to before `end` to `next`. Returns the end of what it wrote.
    static Batch* add_batches(Batch* next, std::uint32_t first, std::uint32_t end);

    std::vector<Radio> radios_;
    std::vector<Neighbor> entries_;                // positions when the grid was built, by table slot
    std::vector<const Trajectory*> trajectories_;  // of the entries
    std::vector<std::uint32_t> first_entry_;       // of each table slot, and the end
    std::size_t columns_ = 1;                      // as many rows as columns
    double cell_m_ = 1;
    Position lowest_;
    Position highest_;
    double rounding_m_ = 0;  // rounding error of the nodes' coordinates
    SimTime now_;

    // State when the grid was built, and changes since.
    double slack_m_ = -1;  // how far nodes may move before a rebuild; < 0: not built
    double total_m_ = 0;   // DisplacementBound::total_m when built
    std::uint64_t course_changes_ = 0;
    bool stood_ = false;      // whether no node moved when the grid was built
    double moved_m_ = 0;      // bound for the displacement of any node since
    bool all_stand_ = false;  // whether no node has moved since
    double reaches_m_ = 0;    // sum of the requested radii
    std::uint64_t requests_ = 0;

    std::vector<Batch> batches_;        // result of batches_within, reused
    std::vector<std::uint32_t> found_;  // entries
    std::vector<Neighbor> near_;        // result of near, reused
};

}  // namespace netsim
