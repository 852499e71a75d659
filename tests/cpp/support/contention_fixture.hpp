// One station's channel access; the test reports busy and free channels, and frames.
#pragma once

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "netsim/mac/contention.hpp"
#include "support/dcf_instants.hpp"

namespace netsim::test {

class GrantLog final : public ContentionListener {
public:
    explicit GrantLog(const Simulator& simulator) : simulator_(simulator) {}

    std::vector<SimTime> times;
    void channel_granted() override { times.push_back(simulator_.now()); }

private:
    const Simulator& simulator_;
};

class ContentionTest : public testing::Test {
protected:
    Contention& contention(bool backoff_optimization = true, std::uint64_t seed = 1) {
        MacConfig config;
        config.backoff_optimization = backoff_optimization;
        return contention(config, seed);
    }
    Contention& contention(const MacConfig& config, std::uint64_t seed = 1) {
        if (!contention_) {
            parameters_ = std::make_unique<DcfParameters>(simulator, config);
            contention_ =
                std::make_unique<Contention>(*parameters_, RandomStream(seed, 0, Purpose::backoff), log_);
        }
        return *contention_;
    }
    // Without backoff slots unless the test sets them.
    void start_at(SimTime time, int contention_window = 0) {
        simulator.schedule_at(time, [this, contention_window] { contention().start(contention_window); });
    }
    void busy_at(SimTime time, SimTime duration) {
        simulator.schedule_at(time, [this] { contention().channel_busy_changed(true); });
        simulator.schedule_at(time + duration, [this] {
            contention().radio_finds_it_free();
            contention().channel_busy_changed(false);
        });
    }
    void corrupted_at(SimTime time) {
        simulator.schedule_at(time, [this] { contention().frame_corrupted(); });
    }
    void received_at(SimTime time) {
        simulator.schedule_at(time, [this] { contention().frame_received(); });
    }
    void run() { simulator.run_until(SimTime::from_seconds(1)); }

    Simulator simulator;

private:
    GrantLog log_{simulator};

protected:
    const std::vector<SimTime>& grants = log_.times;

private:
    std::unique_ptr<DcfParameters> parameters_;
    std::unique_ptr<Contention> contention_;
};

}  // namespace netsim::test
