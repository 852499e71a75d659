// Random errors that change slowly: three independent Gauss-Markov processes of first order, whose
// correlation falls with exp(−lag / correlation time). Gusts of wind and errors of positions.
//
// Values are drawn at the multiples of an interval and linear between them. So they do not depend
// on the times at which they are asked for. gradysim.motion.gauss_markov has the same numbers.
//
// Source: P. S. Maybeck, Stochastic Models, Estimation and Control, volume 1, 1979, section 4.11.
#pragma once

#include <cstdint>

#include "netsim/geometry/position.hpp"
#include "netsim/kernel/random.hpp"

namespace netsim {

class GaussMarkov {
public:
    // `deviations`: the standard deviation of each process. They are stationary from time 0 on.
    GaussMarkov(RandomStream stream, Position deviations, double correlation_time_s, double interval_s);

    // The values at a time ≥ 0, not before the interval of the latest call.
    Position at(double time_s);

private:
    Position next();
    // Three standard normal numbers.
    Position draw();

    RandomStream stream_;
    Position deviations_;
    double interval_s_;
    double kept_;
    double added_;
    std::int64_t number_ = 0;  // of the interval whose ends are known
    Position before_;
    Position after_;
};

}  // namespace netsim
