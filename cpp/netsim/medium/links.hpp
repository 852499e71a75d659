// The radios of one network and the links between them: where they are, what they can hear, and how much of a transmission gets
// to each, exactly and at most.
//
// Knows nothing of what is on the air: that is the medium's, which asks here for every pair of a transmission and a radio.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/fetch.hpp"
#include "netsim/kernel/sim_time.hpp"
#include "netsim/medium/arrival.hpp"
#include "netsim/medium/audience.hpp"
#include "netsim/medium/odometer.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/propagation/antennas.hpp"
#include "netsim/propagation/propagation.hpp"
#include "netsim/propagation/transmission.hpp"

namespace netsim {

class Links {
public:
    // `seed` is that of the run, for fading.
    Links(const MediumConfig& config, std::uint64_t seed) : propagation_(config, seed) {}

    // Radio ids are given in the order of adding: 0, 1, …, node by node.
    RadioId add(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna, SimTime now);
    // What each arrival at the radio touches in the layers above it: in a large network most of it is in no cache
    // by then, so it can be fetched ahead (kernel/fetch.hpp). Null: nothing.
    void set_touched(RadioId radio, const void* interface, const void* protocol) {
        radios_[radio].touched_interface = interface;
        radios_[radio].touched_protocol = protocol;
    }

    RadioId count() const { return static_cast<RadioId>(radios_.size()); }
    MediumListener& listener(RadioId radio) const { return *radios_[radio].listener; }
    InterfaceId interface(RadioId radio) const { return InterfaceId::of_stream(radios_[radio].stream); }
    const ReceiverKind& kind(RadioId radio) const { return kinds_[radios_[radio].kind]; }
    Position position(RadioId radio, SimTime time) const { return trajectories_[radio]->position_at(time); }
    // An index of `audiences()`.
    std::uint32_t audience_of(RadioId radio) const { return audience_of_[radios_[radio].kind]; }
    std::deque<Audience>& audiences() { return audiences_; }
    const std::deque<Audience>& audiences() const { return audiences_; }
    Odometer& odometer() { return odometer_; }
    const Odometer& odometer() const { return odometer_; }
    // The radio of the label's destination that can decode the transmission, or -1: of a broadcast, of an addressee
    // that has none, of the sender itself.
    RadioId addressee_of(const Transmission& sent) const;

    // A mark of each radio that the medium sets (Medium::watch_energy); kept beside what else each transmission asks.
    bool watches_energy(RadioId radio) const { return radios_[radio].watches_energy != 0; }
    void set_watches_energy(RadioId radio, bool watches) { radios_[radio].watches_energy = watches ? 1 : 0; }
    // Has what a transmission to the radio, or from it, asks brought into the cache (kernel/fetch.hpp).
    void fetch(RadioId radio) const { netsim::fetch(radios_[radio]); }
    void fetch_sender(RadioId radio) const {
        fetch(radio);
        netsim::fetch(trajectories_[radio]);
    }
    // The same for what an arrival at the radio touches, which is no more than that of fetch(radio) away.
    void fetch_touched(RadioId radio) const {
        const Radio& there = radios_[radio];
        fetch_bytes(there.listener, cache_line_bytes);
        fetch_bytes(there.touched_interface, cache_line_bytes);
        fetch_bytes(there.touched_protocol, cache_line_bytes);
    }

    // At `radio`, at `place` when the transmission starts. `share` is that of the transmission in the radio's band. Where
    // it is less than `least_w`, perhaps 0 instead: that may cost a fraction. Inline, as it is asked for most often of all.
    [[gnu::always_inline]] double power_w(const Transmission& sent, double share, RadioId radio,
                                          const Position& place, double distance_m,
                                          double least_w = 0) const {
        const InterfaceId receiver = interface(radio);
        const double in_band_w = sent.power_w * share;
        if (antennas_.all_isotropic()) {
            return in_band_w * propagation_.gain(sent, receiver, place, distance_m, least_w / in_band_w);
        }
        const double antenna_gain = antennas_.gain(sent, radio, place);
        return in_band_w *
               propagation_.gain(sent, receiver, place, distance_m, least_w / (in_band_w * antenna_gain)) *
               antenna_gain;
    }
    // In the header, as sums over all that is on the air call it for each.
    Arrival arrival(const Transmission& sent, double share, RadioId radio, const Position& place) const {
        const double distance_m = distance(sent.origin, place);
        const SimTime start = sent.start + propagation_delay(distance_m);
        const double received_w = power_w(sent, share, radio, place, distance_m);
        return Arrival{&sent,      start, start + sent.duration,
                       received_w, place, kind(radio).can_lock_on(sent, received_w)};
    }

    bool all_isotropic() const { return antennas_.all_isotropic(); }
    bool is_random() const { return propagation_.is_random(); }
    // With the best that both antennas can do; the way takes its share of that.
    double most_power_w(const Transmission& sent, const Audience& audience) const {
        const double in_band_w = sent.power_w * sent.band.share_in(audience.band);
        return antennas_.all_isotropic()
                   ? in_band_w
                   : in_band_w * antennas_.max_gain(sent.radio) * audience.most_antenna_gain;
    }
    // The way leaves no more at that distance and beyond, up to rounding.
    double most_gain_beyond(double distance_m, double carrier_hz) const {
        return propagation_.most_gain_beyond(distance_m, carrier_hz);
    }
    // Beyond that, the transmission cannot matter to any of the audience without others beside it.
    double reach_m(Audience& audience, const Transmission& sent) const {
        return known_reach_m(audience.reach, sent, audience, audience.noticed_w(sent));
    }
    // Beyond that, nobody of the audience gets that power.
    double reach_of_power_m(const Transmission& sent, const Audience& audience, double power_w) const;
    // The same, kept in `known`.
    double known_reach_m(KnownReach& known, const Transmission& sent, const Audience& audience,
                         double power_w) const;
    // Who is nearer is told of the transmission even if it is alone. 0 where that depends on more than the distance.
    double loud_to_all_m(const Transmission& sent, const Audience& audience) const;

private:
    static constexpr std::uint32_t most_kinds = 0x7FFFFFFF;  // no network has so many radios
    // What each transmission asks of a radio near by. As small as can be: in a large network, memory is what costs.
    struct alignas(32) Radio {
        MediumListener* listener = nullptr;
        const void* touched_interface = nullptr;
        const void* touched_protocol = nullptr;
        std::uint32_t stream = 0;     // of its interface (InterfaceId)
        std::uint32_t kind : 31 = 0;  // an index of `kinds_`
        std::uint32_t watches_energy : 1 = 1;
    };

    std::uint32_t kind_index(const ReceiverKind& kind);
    std::uint32_t audience_index(const ReceiverKind& kind);

    Propagation propagation_;
    Antennas antennas_;
    std::vector<Radio> radios_;                    // [radio]
    std::vector<const Trajectory*> trajectories_;  // [radio]
    std::vector<ReceiverKind> kinds_;
    std::vector<std::uint32_t> audience_of_;  // [kind]
    std::vector<RadioId> first_radio_;        // [node]; its others come after it
    std::deque<Audience> audiences_;
    Odometer odometer_;
};

}  // namespace netsim
