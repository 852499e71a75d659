// A node on a given path. A command to move it is an error of its protocol.
#pragma once

#include <memory>
#include <utility>

#include "netsim/mobility/mobility.hpp"
#include "netsim/mobility/path.hpp"

namespace netsim {

class PathMobility final : public Mobility {
public:
    explicit PathMobility(std::unique_ptr<Path> path) : Mobility(path->at(0)), path_(std::move(path)) {}

    bool can_move() const override { return false; }
    SimTime begin_leg(SimTime now) override;

private:
    std::unique_ptr<Path> path_;
};

}  // namespace netsim
