// Saturated stations in ns-3, for the comparison with as_ns3.ini (tests/verification/ns3/record.py runs it).
//
//     stations [--option=value …] < STATIONS      one station a line: "x y destination", in meters
//
// A destination is the index of another station, -1 for all of them (broadcast), or -2: it only listens. All
// settings that have no option are ns-3's defaults. Prints one line of CSV for each station: the messages that it
// received from --from on, the data frames and RTS that it sent, and the messages that it gave up.
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iostream>
#include <ns3/core-module.h>
#include <ns3/mobility-module.h>
#include <ns3/network-module.h>
#include <ns3/propagation-module.h>
#include <ns3/spectrum-module.h>
#include <ns3/wifi-module.h>
#include <string>
#include <vector>

namespace {

constexpr uint32_t header_bytes = 8 + 20;  // UDP and IPv4, which this program does not run
constexpr uint16_t ipv4_ethertype = 0x0800;
constexpr int everyone = -1;
constexpr int nobody = -2;

struct Counts {
    uint64_t received = 0;
    uint64_t data = 0;
    uint64_t rts = 0;
    uint64_t given_up = 0;
};

struct Options {
    std::string phy = "yans";
    std::string standard = "g";
    std::string rate = "ErpOfdmRate6Mbps";
    std::string control = "ErpOfdmRate6Mbps";
    std::string rts_threshold;
    double power_dbm = 16.0206;
    uint32_t bytes = 1000;
    uint32_t burst = 4;
    double interval_s = 0.001;
    double spread_s = 0.001;
    double from_s = 1;
    double until_s = 11;
    uint32_t seed = 1;
};

Options options;
std::vector<Counts> counts;

void send_burst(ns3::Ptr<ns3::NetDevice> device, ns3::Address destination) {
    for (uint32_t i = 0; i < options.burst; ++i) {
        device->Send(ns3::Create<ns3::Packet>(options.bytes + header_bytes), destination, ipv4_ethertype);
    }
    ns3::Simulator::Schedule(ns3::Seconds(options.interval_s), &send_burst, device, destination);
}

bool receive(ns3::Ptr<ns3::NetDevice> device, ns3::Ptr<const ns3::Packet>, uint16_t, const ns3::Address&) {
    if (ns3::Simulator::Now() >= ns3::Seconds(options.from_s)) {
        ++counts[device->GetNode()->GetId()].received;
    }
    return true;
}

void transmitted(uint32_t station, ns3::Ptr<const ns3::Packet> frame, double) {
    ns3::WifiMacHeader header;
    frame->PeekHeader(header);
    if (ns3::Simulator::Now() >= ns3::Seconds(options.from_s)) {
        counts[station].data += header.IsData() ? 1 : 0;
        counts[station].rts += header.IsRts() ? 1 : 0;
    }
}

void gave_up(uint32_t station, ns3::Mac48Address) {
    if (ns3::Simulator::Now() >= ns3::Seconds(options.from_s)) {
        ++counts[station].given_up;
    }
}

ns3::Ptr<ns3::PropagationLossModel> path_loss() {
    auto loss = ns3::CreateObject<ns3::FriisPropagationLossModel>();
    loss->SetFrequency(2.412e9);
    return loss;
}

ns3::Ptr<ns3::YansWifiChannel> yans_channel() {
    auto channel = ns3::CreateObject<ns3::YansWifiChannel>();
    channel->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
    channel->SetPropagationLossModel(path_loss());
    return channel;
}

ns3::Ptr<ns3::SpectrumChannel> spectrum_channel() {
    auto channel = ns3::CreateObject<ns3::MultiModelSpectrumChannel>();
    channel->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
    channel->AddPropagationLossModel(path_loss());
    return channel;
}

ns3::WifiStandard standard() {
    return options.standard == "a"   ? ns3::WIFI_STANDARD_80211a
           : options.standard == "b" ? ns3::WIFI_STANDARD_80211b
                                     : ns3::WIFI_STANDARD_80211g;
}

}  // namespace

int main(int argc, char** argv) {
    ns3::CommandLine command;
    command.AddValue("phy", "yans or spectrum: YansWifiPhy or SpectrumWifiPhy", options.phy);
    command.AddValue("standard", "a, b or g", options.standard);
    command.AddValue("rate", "WifiMode of data and broadcast frames", options.rate);
    command.AddValue("control", "WifiMode of RTS frames", options.control);
    command.AddValue("rts", "RTS threshold in bytes", options.rts_threshold);
    command.AddValue("power", "dBm", options.power_dbm);
    command.AddValue("bytes", "payload of a message", options.bytes);
    command.AddValue("burst", "messages in a burst", options.burst);
    command.AddValue("interval", "seconds between bursts", options.interval_s);
    command.AddValue("spread", "latest first burst in seconds", options.spread_s);
    command.AddValue("from", "seconds from which on frames count", options.from_s);
    command.AddValue("until", "seconds", options.until_s);
    command.AddValue("seed", "run of the random numbers", options.seed);
    command.Parse(argc, argv);
    ns3::RngSeedManager::SetRun(options.seed);
    if (!options.rts_threshold.empty()) {
        ns3::Config::SetDefault("ns3::WifiRemoteStationManager::RtsCtsThreshold",
                                ns3::StringValue(options.rts_threshold));
    }

    auto places = ns3::CreateObject<ns3::ListPositionAllocator>();
    std::vector<int> destinations;
    double x = 0;
    double y = 0;
    for (int destination = 0; std::cin >> x >> y >> destination;) {
        places->Add(ns3::Vector(x, y, 0));
        destinations.push_back(destination);
    }
    counts.resize(destinations.size());
    ns3::NodeContainer stations(static_cast<uint32_t>(destinations.size()));
    ns3::MobilityHelper mobility;
    mobility.SetPositionAllocator(places);
    mobility.SetMobilityModel("ns3::ConstantPositionMobilityModel");
    mobility.Install(stations);

    ns3::YansWifiPhyHelper yans;
    ns3::SpectrumWifiPhyHelper spectrum;
    ns3::WifiPhyHelper& phy = options.phy == "yans" ? static_cast<ns3::WifiPhyHelper&>(yans) : spectrum;
    yans.SetChannel(yans_channel());
    spectrum.SetChannel(spectrum_channel());
    phy.Set("TxPowerStart", ns3::DoubleValue(options.power_dbm));
    phy.Set("TxPowerEnd", ns3::DoubleValue(options.power_dbm));
    ns3::WifiHelper wifi;
    wifi.SetStandard(standard());
    wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode", ns3::StringValue(options.rate),
                                 "NonUnicastMode", ns3::StringValue(options.rate), "ControlMode",
                                 ns3::StringValue(options.control));
    ns3::WifiMacHelper mac;
    mac.SetType("ns3::AdhocWifiMac");
    const ns3::NetDeviceContainer devices = wifi.Install(phy, mac, stations);

    auto uniform = ns3::CreateObject<ns3::UniformRandomVariable>();
    for (uint32_t i = 0; i < devices.GetN(); ++i) {
        auto device = ns3::DynamicCast<ns3::WifiNetDevice>(devices.Get(i));
        device->SetReceiveCallback(ns3::MakeCallback(&receive));
        device->GetPhy()->TraceConnectWithoutContext("PhyTxBegin", ns3::MakeBoundCallback(&transmitted, i));
        device->GetRemoteStationManager()->TraceConnectWithoutContext("MacTxFinalDataFailed",
                                                                      ns3::MakeBoundCallback(&gave_up, i));
        device->GetRemoteStationManager()->TraceConnectWithoutContext("MacTxFinalRtsFailed",
                                                                      ns3::MakeBoundCallback(&gave_up, i));
        if (destinations[i] != nobody) {
            const ns3::Address destination =
                destinations[i] == everyone
                    ? device->GetBroadcast()
                    : devices.Get(static_cast<uint32_t>(destinations[i]))->GetAddress();
            ns3::Simulator::ScheduleWithContext(i, ns3::Seconds(uniform->GetValue(0, options.spread_s)),
                                                &send_burst, device, destination);
        }
    }
    ns3::Simulator::Stop(ns3::Seconds(options.until_s));
    ns3::Simulator::Run();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const auto [received, data, rts, given_up] = counts[i];
        std::printf("%zu,%llu,%llu,%llu,%llu\n", i, static_cast<unsigned long long>(received),
                    static_cast<unsigned long long>(data), static_cast<unsigned long long>(rts),
                    static_cast<unsigned long long>(given_up));
    }
    ns3::Simulator::Destroy();
}
