// Profile of a run by layer of the engine.
//
//     netsim_layers [nodes]        1,000 by default, for 5 s of CPU time
//
// The kernel's profiling timer interrupts the run every millisecond of CPU time, and the current
// instruction is recorded. `addr2line` (Debian's binutils) finds its source line from the debug
// information. Inlined code counts for the layer of its source; the standard library counts for
// its caller. Time within the C library (memory, mathematics) is a separate line.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <link.h>
#include <map>
#include <stdexcept>
#include <string>
#include <sys/time.h>
#include <ucontext.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "beacon_network.hpp"

namespace {

using netsim::SimTime;

constexpr double measured_cpu_s = 5;
constexpr std::size_t max_samples = 20'000;
constexpr const char* elsewhere = "C library";

// Filled by the signal handler, which may not allocate.
std::array<std::uintptr_t, max_samples> samples;
volatile std::sig_atomic_t sample_count = 0;

void take_sample(int, siginfo_t*, void* context) {
    const auto count = static_cast<std::size_t>(sample_count);
    if (count < max_samples) {
        const auto& registers = static_cast<ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
        samples[count] = static_cast<std::uintptr_t>(registers.gregs[REG_RIP]);
#elif defined(__aarch64__)
        samples[count] = registers.pc;
#else
#error "where is the program counter on this machine?"
#endif
        sample_count = static_cast<std::sig_atomic_t>(count + 1);
    }
}

void set_timer(suseconds_t microseconds) {
    const itimerval timer{{0, microseconds}, {0, microseconds}};
    if (setitimer(ITIMER_PROF, &timer, nullptr) != 0) {
        throw std::runtime_error("no profiling timer on this machine");
    }
}

// Load address of this program.
struct Image {
    std::uintptr_t base = 0;
    std::uintptr_t end = 0;
};

Image own_image() {
    Image image;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* data) {
            auto& own = *static_cast<Image*>(data);
            own.base = info->dlpi_addr;
            for (int i = 0; i < info->dlpi_phnum; ++i) {
                own.end = std::max(own.end,
                                   static_cast<std::uintptr_t>(info->dlpi_addr + info->dlpi_phdr[i].p_vaddr +
                                                               info->dlpi_phdr[i].p_memsz));
            }
            return 1;  // the first entry is the program
        },
        &image);
    return image;
}

// "…/netsim/mac/dcf.cpp:12" is "mac", "…/netsim/node/node.cpp:3" is "node"; "" is outside of the
// engine.
std::string layer_of(const std::string& place) {
    const std::string root = "/cpp/netsim/";
    const auto start = place.find(root);
    if (start == std::string::npos) {
        return place.find("/bench/") == std::string::npos ? "" : "protocol of the benchmark";
    }
    const std::string below = place.substr(start + root.size());
    const auto end = below.find('/');
    return end == std::string::npos ? "netsim" : below.substr(0, end);
}

// {address in the program: layer}
std::map<std::uintptr_t, std::string> layers_of(const std::vector<std::uintptr_t>& addresses) {
    std::array<char, 32> list_name{"/tmp/netsim_layers_XXXXXX"};
    const int descriptor = mkstemp(list_name.data());
    if (descriptor < 0) {
        throw std::runtime_error("cannot write a temporary file");
    }
    FILE* list = fdopen(descriptor, "w");
    for (const std::uintptr_t address : addresses) {
        std::fprintf(list, "0x%lx\n", static_cast<unsigned long>(address));
    }
    std::fclose(list);
    const std::string command =
        "addr2line -a -i -e /proc/" + std::to_string(getpid()) + "/exe @" + list_name.data();
    FILE* places = popen(command.c_str(), "r");
    std::map<std::uintptr_t, std::string> layers;
    std::array<char, 4096> line{};
    std::string* layer = nullptr;  // layer of the address of these lines, innermost place first
    while (places != nullptr && std::fgets(line.data(), line.size(), places) != nullptr) {
        const std::string text = line.data();
        if (text.starts_with("0x")) {
            layer = &layers[std::strtoull(text.c_str(), nullptr, 16)];
        } else if (layer != nullptr && layer->empty()) {
            *layer = layer_of(text);
        }
    }
    const int status = places == nullptr ? -1 : pclose(places);
    std::remove(list_name.data());
    if (status != 0) {
        throw std::runtime_error("addr2line failed: is binutils installed?");
    }
    return layers;
}

std::map<std::string, std::size_t> samples_by_layer() {
    const Image image = own_image();
    std::map<std::uintptr_t, std::size_t> counts;
    std::map<std::string, std::size_t> by_layer;
    for (std::size_t i = 0; i < static_cast<std::size_t>(sample_count); ++i) {
        if (samples[i] >= image.base && samples[i] < image.end) {
            ++counts[samples[i] - image.base];
        } else {
            ++by_layer[elsewhere];
        }
    }
    std::vector<std::uintptr_t> addresses;
    for (const auto& [address, count] : counts) {
        addresses.push_back(address);
    }
    for (const auto& [address, layer] : layers_of(addresses)) {
        by_layer[layer.empty() ? "other" : layer] += counts[address];
    }
    return by_layer;
}

double delivered(const netsim::Network& network) {
    constexpr auto outcome = static_cast<std::size_t>(netsim::FrameOutcome::delivered);
    return static_cast<double>(network.frame_outcomes().counts(netsim::FrameKind::broadcast, false)[outcome]);
}

void profile(std::int64_t nodes) {
    const auto network = make_beacon_network(nodes, 0, -1);
    network->run_until(SimTime::from_us(1'000'000));  // warm-up
    struct sigaction action{};
    action.sa_sigaction = take_sample;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigaction(SIGPROF, &action, nullptr);
    const double delivered_before = delivered(*network);
    const std::clock_t start = std::clock();
    double cpu_s = 0;
    set_timer(1000);
    while (cpu_s < measured_cpu_s) {
        network->run_until(network->now() + SimTime::from_us(1'000'000));
        cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    set_timer(0);
    const double ns_per_copy = cpu_s / (delivered(*network) - delivered_before) * 1e9;
    auto by_layer = samples_by_layer();
    std::vector<std::pair<std::string, std::size_t>> rows(by_layer.begin(), by_layer.end());
    std::ranges::sort(rows, std::greater<>(), [](const auto& row) { return row.second; });
    const auto all = static_cast<double>(sample_count);
    std::printf("%lld nodes, %.0f ns per delivered copy, by layer (%.0f samples):\n",
                static_cast<long long>(nodes), ns_per_copy, all);
    for (const auto& [layer, count] : rows) {
        const double share = static_cast<double>(count) / all;
        std::printf("  %-26s %5.1f %%  %6.1f ns\n", layer.c_str(), share * 100, share * ns_per_copy);
    }
}

}  // namespace

int main(int count, char** arguments) {
    try {
        profile(count > 1 ? std::atoll(arguments[1]) : 1000);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
