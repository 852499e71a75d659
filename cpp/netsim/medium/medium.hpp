// The air between the radios of one network: propagation, path loss, noise and interference.
//
// A radio is told only of arrivals that can matter to it: those that it could lock on to or that make its channel busy;
// together with others on the air at the same time only as long as it watches for that. All other transmissions are
// remembered for as long as they can interfere with a reception, and summed when one ends. The result is that
// of the plain model, in which every radio hears of everything; the cost is that of the radios near by.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "netsim/config/medium_config.hpp"
#include "netsim/kernel/fetch.hpp"
#include "netsim/kernel/fingerprint.hpp"
#include "netsim/kernel/simulator.hpp"
#include "netsim/medium/antennas.hpp"
#include "netsim/medium/background_noise.hpp"
#include "netsim/medium/energy_forecast.hpp"
#include "netsim/medium/energy_ring.hpp"
#include "netsim/medium/interference.hpp"
#include "netsim/medium/neighbours.hpp"
#include "netsim/medium/odometer.hpp"
#include "netsim/medium/propagation.hpp"
#include "netsim/medium/receiver.hpp"
#include "netsim/medium/transmission.hpp"
#include "netsim/trace/frame_fates.hpp"

namespace netsim {

// Of which arrivals the radios are told: `everything` is the plain model, slow and obvious, which tests hold
// the other one against.
enum class Hearing { what_matters, everything };

class Medium {
public:
    // `seed` is that of the run, for fading.
    Medium(Simulator& simulator, const MediumConfig& config, FrameFates& fates, Fingerprint& fingerprint,
           Hearing hearing = Hearing::what_matters, std::uint64_t seed = 0);

    // Radio ids are given in the order of attaching: 0, 1, …, node by node: all interfaces of node 0, those of node 1, …
    // No node may have two radios of one centre frequency.
    RadioId attach(InterfaceId interface, const Receiver& receiver, const MountedAntenna& antenna = {});
    // What each arrival at the radio touches in the layers above it: in a large network most of it is in no cache
    // by then, so the medium has it fetched ahead. Null: nothing.
    void set_touched(RadioId radio, const void* interface, const void* upper_layer, const void* protocol) {
        Touched& touched = touched_[radio];
        touched.interface = interface;
        touched.upper_layer = upper_layer;
        touched.protocol = protocol;
    }

    // A radio that watches its energy is also told of frames of which none is loud enough alone, but that make its channel busy
    // together. All watch from the start; one may stop and begin again. Returns when such frames last ceased to keep its
    // channel busy, if that was after `since`; otherwise, also if they still do, long ago. `since` lies no farther back than
    // was asked to `remember`.
    SimTime watch_energy(RadioId radio, SimTime since);
    void stop_watching_energy(RadioId radio) { attached_[radio].watches_energy = false; }
    // Keeps transmissions for at least that long after their end; of several durations asked for, the longest counts.
    void remember(SimTime duration) { remembered_ = std::max(remembered_, duration); }

    // The radio will probably send soon: has what the medium knows of it brought into the cache (kernel/fetch.hpp).
    void fetch_sender(RadioId radio) const {
        netsim::fetch(attached_[radio]);
        netsim::fetch(trajectories_[radio]);
    }
    // Puts a frame on the air now, at the sender's present position, and sees to its arrivals.
    // `transmission`'s id, start and origin are filled in here.
    void transmit(Transmission transmission);

    // What disturbs `arrival` at `receiver` from `start` until just before `end`. Only until the arrival has ended, and
    // for times until now; valid until the next call.
    InterferenceSum& interference_with(RadioId receiver, const Arrival& arrival, SimTime start, SimTime end);

    // In W, no less than its largest sum over the time of the arrival, for one that reached the sensitivity: known at
    // once. Infinite if that says nothing.
    double most_interference_w(const Arrival& arrival) const { return on_air_of(arrival).others_w; }
    // The same at that receiver, once the arrival has ended: nearer to the truth, and more to work out.
    double most_interference_w(RadioId receiver, const Arrival& arrival) const;

    // To which the radios add, too.
    FrameFates& fates() { return fates_; }
    Fingerprint& fingerprint() { return fingerprint_; }
    const BackgroundNoise& background_noise() const { return background_noise_; }
    // Transmissions on the air, or over but able to disturb a reception that is not: stays small, as tests
    // check.
    std::size_t remembered_count() const { return on_air_.size(); }
    // How often the power of a transmission at a radio was worked out for sums of energy: even where very many overlap,
    // a few times for each pair of them, as tests check.
    std::uint64_t energy_look_count() const { return energy_looks_; }

private:
    // What each transmission asks of a radio near by. As small as can be: in a large network, memory is what costs.
    struct Attached {
        InterfaceId interface;
        std::uint32_t kind = 0;  // an index of `kinds_`
        bool watches_energy = true;
    };
    // By an arrival at a radio.
    struct alignas(32) Touched {
        MediumListener* listener = nullptr;
        const void* interface = nullptr;
        const void* upper_layer = nullptr;
        const void* protocol = nullptr;
    };
    // The last one that was worked out: mostly all transmissions have the same.
    struct KnownReach {
        double gain = -1;
        double carrier_hz = 0;
        double reach_m = 0;
    };
    // Receivers of one band and the same formats that notice about the same powers: what is too far away for the keenest of them is too
    // far away for all. Within a factor of 4, so that one of very keen ears does not make all others listen.
    struct Audience {
        Band band;
        PpduFormats formats = PpduFormats::all();
        int keenness = 0;
        double least_w = 0;         // below that, none of them notices a transmission that is alone
        double least_energy_w = 0;  // below that, the sum of several is not noticed either
        double most_energy_w = 0;   // from that on, the noise or one transmission is enough for all of them
        double most_antenna_gain = 0;
        KnownReach reach{};
        KnownReach ring_reach{};
        KnownReach outer_reach{};
        Neighbours members;
    };
    // What a radio is told of an arrival; at one time, in this order.
    enum Edge : std::uint8_t { begins = 0, ends = 1 };
    struct Due {
        SimTime time;
        Turn turn = 0;
    };
    // An arrival that matters to the radio by itself, as is known when the transmission begins. The radio is told twice: of its
    // beginning and of its end, in their order among those of all who hear it (OnAir::told counts them). A radio to which it
    // comes to matter later, together with others, is told apart. All other radios never learn of it: there it is energy and
    // interference, summed where somebody asks.
    struct Heard {
        SimTime start;
        double power_w = 0;
        RadioId radio = 0;
        std::uint32_t place_index = 0;  // of the entry's places
        bool lockable = false;
    };
    struct OnAir {
        Transmission transmission;
        SimTime last_end;                   // at its most distant receiver, or later
        Turn first_turn = 0;                // of its arrivals' events, two for each receiver
        double odometer_m = 0;              // at its start
        double reach_m = 0;                 // nobody locks on to it farther away
        bool arrives_at_once = false;       // at one whom it matters to
        double others_w = 0;                // within that, at most, of all that are on the air beside it
        std::vector<const OnAir*> close;    // of those, where that bound says little of any one place,
        double far_w = 0;                   // and at most what all the others bring
        std::vector<Heard> heard;           // by those known when it began, in the order of their events
        bool heard_is_complete = false;     // who comes to notice it later is told apart
        std::vector<Position> places;       // of theirs, at its start
        std::array<std::size_t, 2> told{};  // [edge]: so many of `heard`
        std::vector<Arrival> told_apart;    // by the others
        std::vector<double> shares;         // [audience]: of its power, in their band
        std::vector<EnergyRing> rings;      // [audience]
    };
    // What a transmission can bring to any of the receivers that are to be watched.
    struct Bound {
        const OnAir* from = nullptr;
        double most_w = 0;
        double rest_w = 0;  // with those after it
    };
    // One that is or was on the air, at one receiver.
    struct Passing {
        OnAir* on_air = nullptr;
        Arrival arrival;
    };
    // Of a receiver for which bounds did not tell that its channel stays idle.
    struct Outlook {
        RadioId radio = 0;
        double missing_w = 0;       // more than that must come before there is somebody to tell of
        std::uint64_t next_id = 0;  // of the first transmission that it does not know
        // It was told of enough until then, when it is looked at; long ago if it has been.
        SimTime rests_until = SimTime::long_ago();
        EnergyForecast forecast;
    };

    OnAir& put_on_air(Transmission transmission);
    const OnAir& on_air_of(const Arrival& arrival) const {
        return *on_air_[arrival.transmission->id - on_air_.front()->transmission.id];
    }
    // In the header, as sums over all that is on the air call it for each.
    Arrival arrival_at(const OnAir& on_air, RadioId radio) const {
        return arrival_at_place(on_air, radio, trajectories_[radio]->position_at(on_air.transmission.start));
    }
    // The same, mostly with less to look up. `place`: where the radio was when any of those on the air began.
    Arrival arrival_at(const OnAir& on_air, RadioId radio, const Position& place) const {
        return nobody_moved() ? arrival_at_place(on_air, radio, place) : arrival_at(on_air, radio);
    }
    // With the radio at `place` when the transmission starts.
    Arrival arrival_at_place(const OnAir& on_air, RadioId radio, const Position& place) const {
        const Transmission& transmission = on_air.transmission;
        const double distance_m = distance(transmission.origin, place);
        const SimTime start = transmission.start + propagation_delay(distance_m);
        const double received_w = power_w(transmission, share_at(on_air, radio), radio, place, distance_m);
        return Arrival{&transmission, start, start + transmission.duration,
                       received_w,    place, can_lock_on(radio, transmission, received_w)};
    }
    const ReceiverKind& kind(RadioId radio) const { return kinds_[attached_[radio].kind]; }
    std::uint32_t audience_of(RadioId radio) const { return audience_of_[attached_[radio].kind]; }
    std::uint32_t kind_index(const ReceiverKind& kind);
    std::uint32_t audience_index(const ReceiverKind& kind);
    double share_at(const OnAir& on_air, RadioId radio) const { return on_air.shares[audience_of(radio)]; }
    // Since the first of those on the air began.
    bool nobody_moved() const {
        return odometer_.all_stand() && odometer_.reading_m(simulator_.now()) == on_air_.front()->odometer_m;
    }
    // The radio of the label's destination that can decode the transmission, or -1: of a broadcast, of an addressee
    // that has none, of the sender itself.
    RadioId addressee_of(const Transmission& transmission) const;
    void tell_everybody(OnAir& entry);
    void tell_those_it_matters_to(OnAir& entry);
    // Of one audience: who can notice it, in `heard`, and whom its ring watches. Returns the copies that it makes there.
    CopyCount find_those_it_matters_to(OnAir& entry, std::size_t index);
    void book_copies(const OnAir& entry, CopyCount copies);
    // At `radio`, at `place` when the transmission starts. `share` is that of the transmission in the radio's band. Where
    // it is less than `least_w`, perhaps 0 instead: that may cost a fraction.
    double power_w(const Transmission& sent, double share, RadioId radio, const Position& place,
                   double distance_m, double least_w = 0) const {
        const InterfaceId receiver = attached_[radio].interface;
        const double in_band_w = sent.power_w * share;
        if (antennas_.all_isotropic()) {
            return in_band_w * propagation_.gain(sent, receiver, place, distance_m, least_w / in_band_w);
        }
        const double antenna_gain = antennas_.gain(sent, radio, place);
        return in_band_w *
               propagation_.gain(sent, receiver, place, distance_m, least_w / (in_band_w * antenna_gain)) *
               antenna_gain;
    }
    // With the best that both antennas can do; the way takes its share of that.
    double most_power_w(const Transmission& sent, const Audience& audience) const {
        const double in_band_w = sent.power_w * sent.band.share_in(audience.band);
        return antennas_.all_isotropic()
                   ? in_band_w
                   : in_band_w * antennas_.max_gain(sent.radio) * audience.most_antenna_gain;
    }
    // Bounds are taken so much larger and levels so much lower, for rounding.
    static constexpr double margin = 1e-9;

    // Below that, none of the audience notices the transmission without others beside it …
    static double noticed_w(const Audience& audience, const Transmission& transmission) {
        // Who cannot decode it notices only its energy.
        return can_decode(audience, transmission) ? audience.least_w : audience.least_energy_w;
    }
    // … and beyond that distance, it cannot matter to any.
    double reach_m(Audience& audience, const Transmission& transmission) const {
        return known_reach_m(audience.reach, transmission, audience, noticed_w(audience, transmission));
    }
    // The sum of several is not noticed below that.
    static double noticed_energy_w(const Audience& audience) {
        return audience.least_energy_w * (1 - margin);
    }
    // Begins the ring of the transmission (energy_ring.hpp).
    void begin_ring(EnergyRing& ring, Audience& audience, const Transmission& transmission) const;
    double known_reach_m(KnownReach& known, const Transmission& transmission, const Audience& audience,
                         double power_w) const;
    // Beyond that, nobody of the audience gets that power.
    double reach_of_power_m(const Transmission& transmission, const Audience& audience, double power_w) const;
    void fetch(RadioId radio, FrameKind kind) const;
    void schedule_arrivals(OnAir& entry);
    // Of the next one to start or to end.
    static Due next_due(const OnAir& entry, Edge edge);
    void schedule_next(OnAir& entry, Edge edge);
    void tell_next(OnAir& entry, Edge edge);
    // Of an arrival that it does not notice alone.
    void tell(RadioId radio, OnAir& on_air, const Arrival& arrival);
    void begin(RadioId radio, const OnAir& on_air, std::size_t apart);
    // Sums of energy: medium_energy.cpp.
    // Collects in `beside_` those that began before it and are not over everywhere.
    void find_those_beside(const OnAir& newest);
    // Adds what `there` can bring to the receivers of `here`.
    void bound_interference(OnAir& here, const OnAir& there) const;
    // Tells where it and those beside it, none of which matters alone, make the channel busy: now, or at the end of this
    // instant.
    void add_up_energy_in_time(OnAir& newest);
    void add_up_energy_of_those_begun_now();
    void add_up_energy(OnAir& newest);
    void tell_where_energy_adds_up(OnAir& newest, std::size_t audience);
    // Those whom the ring of `here` watches miss less by what `there` brings. One of the two is the newest.
    void add_to_ring(OnAir& here, const OnAir& there, std::size_t audience);
    // Adds up anew what the others can bring, and watches whoever that calls for.
    void widen_ring(OnAir& here, const OnAir& newest, std::size_t index);
    // A function of the radius: the most that `there`, sent with at most that power, antennas included, brings to
    // receivers within the radius of where `here` began.
    auto most_brought_w(const OnAir& there, const OnAir& here, double most_sent_w) const;
    double brought_w(const OnAir& on_air, RadioId radio, const Position& place) {
        ++energy_looks_;
        return on_air.transmission.radio == radio ? 0 : arrival_at(on_air, radio, place).power_w;
    }
    double loud_to_all_m_of(const Transmission& transmission, const Audience& audience) const;
    // Tells the radio of as many as it takes to find its channel busy when it is. Returns by how many W the sum may still
    // rise before more has to be told; not positive if that is not known. What is worked out once for a radio is kept in its
    // outlook, as the rings of several transmissions ask for it, and again for each new one.
    double missing_at(RadioId radio, const Position& place);
    // The same at that time, if it watches then.
    void look_at(RadioId radio, SimTime time);
    // The same for one that gets `received_w` of one transmission, and of the others at most what is in `bounds_`.
    double missing_by_bounds(RadioId radio, const Position& place, double received_w);
    void foresee(EnergyForecast& forecast, RadioId radio, const Position& place, const OnAir& on_air);
    Outlook& outlook_of(RadioId radio);
    void take_back_outlooks(SimTime now);
    // When those in `passing_` were enough for the last time, as the radio itself would have it.
    SimTime energy_over_at(RadioId radio);
    template <typename ReceiverOrAudience>
    static bool can_decode(const ReceiverOrAudience& receiver, const Transmission& sent) {
        return sent.can_be_decoded(receiver.band, receiver.formats);
    }
    bool can_lock_on(RadioId radio, const Transmission& sent, double power_w) const {
        return power_w >= kind(radio).sensitivity_w && can_decode(kind(radio), sent);
    }
    static bool is_loud(const ReceiverKind& receiver, double power_w) {
        return receiver.noise_w + power_w >= receiver.energy_detection_w;
    }
    // Of what its channel needs to be busy, beside one transmission of that power.
    static double missing_beside_w(const ReceiverKind& receiver, double power_w) {
        return receiver.energy_detection_w * (1 - margin) - (receiver.noise_w + power_w);
    }
    // However sums are rounded.
    static bool is_surely_loud(const ReceiverKind& receiver, double power_w) {
        return is_loud(receiver, power_w * (1 - margin));
    }
    void forget_the_past();

    Simulator& simulator_;
    FrameFates& fates_;
    Fingerprint& fingerprint_;
    Propagation propagation_;
    Antennas antennas_;
    BackgroundNoise background_noise_;
    Hearing hearing_;
    std::vector<Attached> attached_;               // [radio]
    std::vector<Touched> touched_;                 // [radio]
    std::vector<const Trajectory*> trajectories_;  // [radio]
    std::vector<ReceiverKind> kinds_;
    std::vector<std::uint32_t> audience_of_;  // [kind]
    std::vector<RadioId> first_radio_;        // [node]; its others come after it
    std::deque<Audience> audiences_;
    Odometer odometer_;
    std::deque<std::unique_ptr<OnAir>> on_air_;  // by start
    std::vector<std::unique_ptr<OnAir>> spare_;  // forgotten ones, of use again
    std::uint64_t next_id_ = 0;
    SimTime remembered_;            // after their end
    InterferenceSum interference_;  // the answer of interference_with, reused
    std::vector<OnAir*> beside_;
    std::vector<OnAir*> begun_now_;       // whose energy was not added up yet
    bool awaits_end_of_instant_ = false;  // to do that
    std::vector<Bound> bounds_;
    std::vector<Passing> passing_;
    static constexpr std::uint32_t no_outlook = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> outlook_of_;  // [radio], an index of `outlooks_`, or no_outlook
    std::deque<Outlook> outlooks_;
    std::vector<std::uint32_t> spare_outlooks_;
    std::uint64_t energy_looks_ = 0;
};

}  // namespace netsim
