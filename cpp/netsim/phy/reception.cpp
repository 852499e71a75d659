#include "netsim/phy/reception.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace netsim {

Period period_of(FramePart part, const Arrival& arrival) {
    const Mode& mode = *arrival.transmission->mode;
    const SimTime header_start = std::min(arrival.start + mode.preamble, arrival.end);
    const SimTime data_start = std::min(header_start + mode.header, arrival.end);
    if (part == FramePart::header) {
        return {header_start, data_start};
    }
    return {data_start, std::max(arrival.end - mode.signal_extension, data_start)};
}

double ReceptionModel::success(const Arrival& arrival, double interference_w) const {
    const double snir = this->snir(arrival, interference_w);
    return snir > snir_threshold ? errors->success_probability(*arrival.transmission->mode, snir,
                                                               arrival.transmission->psdu_bytes)
                                 : 0;
}

bool ReceptionModel::survives(double draw, const Arrival& arrival, double interference_w) const {
    const double snir = this->snir(arrival, interference_w);
    if (!(snir > snir_threshold)) {
        return false;
    }
    const Transmission& sent = *arrival.transmission;
    return draw < errors->min_success(*sent.mode, snir, sent.psdu_bytes) ||
           (draw < errors->max_success(*sent.mode, snir, sent.psdu_bytes) &&
            draw < errors->success_probability(*sent.mode, snir, sent.psdu_bytes));
}

double ReceptionModel::success(FramePart part, const Arrival& arrival, InterferenceSum& interference) const {
    const Period period = period_of(part, arrival);
    const auto& steps = interference.steps();
    double sum = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const SimTime end = i + 1 < steps.size() ? steps[i + 1].start : period.end;
        const double log = log_success(part, arrival, steps[i].power_w);
        if (log == -std::numeric_limits<double>::infinity()) {
            return 0;
        }
        sum += steps.size() == 1
                   ? log
                   : log * ((end - steps[i].start).seconds() / (period.end - period.start).seconds());
    }
    return sum == 0 ? 1 : std::exp(sum);
}

double ReceptionModel::log_success(FramePart part, const Arrival& arrival, double interference_w) const {
    const double snir = this->snir(arrival, interference_w);
    if (!(snir > snir_threshold)) {
        return -std::numeric_limits<double>::infinity();
    }
    const Transmission& sent = *arrival.transmission;
    return part == FramePart::header ? errors->log_header_success(*sent.mode, snir)
                                     : errors->log_data_success(*sent.mode, snir, sent.psdu_bytes);
}

}  // namespace netsim
