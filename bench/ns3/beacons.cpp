// The beacon scenario of configs/reference/beacons.ini for ns-3, to compare run times.
//
//     beacons_ns3 NODES < POSITIONS      positions as lines "x y" in meters
//
// Nodes stand in a square of 1 km and broadcast 100 B once a second, at a random phase, from 1 s
// until 60.9 s: 802.11g at 24 Mbps, 2 mW, free space. All other settings are ns-3's defaults. One
// of them is a preamble threshold of -82 dBm. So fewer nodes receive a frame than in our run,
// which is less work for ns-3. Prints one line of JSON: the CPU time of the run without its
// construction, and the frames.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <ns3/core-module.h>
#include <ns3/mobility-module.h>
#include <ns3/network-module.h>
#include <ns3/propagation-module.h>
#include <ns3/wifi-module.h>

namespace {

constexpr double stop_s = 60.9;
// 100 B of payload, with the headers of UDP and IPv4. The device adds LLC/SNAP, MAC header and FCS.
constexpr uint32_t datagram_bytes = 100 + 8 + 20;
constexpr uint16_t ipv4_ethertype = 0x0800;

uint64_t sent = 0;
uint64_t received = 0;

void send(const ns3::Ptr<ns3::NetDevice>& device) {
    device->Send(ns3::Create<ns3::Packet>(datagram_bytes), device->GetBroadcast(), ipv4_ethertype);
    ++sent;
    const ns3::Time next = ns3::Simulator::Now() + ns3::Seconds(1);
    if (next < ns3::Seconds(stop_s)) {
        ns3::Simulator::Schedule(ns3::Seconds(1), &send, device);
    }
}

bool receive(ns3::Ptr<ns3::NetDevice>, ns3::Ptr<const ns3::Packet>, uint16_t, const ns3::Address&) {
    ++received;
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    const int count = argc == 2 ? std::atoi(argv[1]) : 0;
    if (count <= 0) {
        std::cerr << "usage: beacons_ns3 NODES < POSITIONS\n";
        return 2;
    }
    ns3::NodeContainer nodes(static_cast<uint32_t>(count));
    auto places = ns3::CreateObject<ns3::ListPositionAllocator>();
    for (int i = 0; i < count; ++i) {
        double x = 0;
        double y = 0;
        if (!(std::cin >> x >> y)) {
            std::cerr << "there are fewer positions than nodes\n";
            return 2;
        }
        places->Add(ns3::Vector(x, y, 0));
    }
    ns3::MobilityHelper mobility;
    mobility.SetPositionAllocator(places);
    mobility.SetMobilityModel("ns3::ConstantPositionMobilityModel");
    mobility.Install(nodes);

    ns3::YansWifiChannelHelper channel;
    channel.SetPropagationDelay("ns3::ConstantSpeedPropagationDelayModel");
    channel.AddPropagationLoss("ns3::FriisPropagationLossModel", "Frequency", ns3::DoubleValue(2.412e9));
    ns3::YansWifiPhyHelper phy;
    phy.SetChannel(channel.Create());
    const ns3::DoubleValue power_dbm(3.0103);  // 2 mW
    phy.Set("TxPowerStart", power_dbm);
    phy.Set("TxPowerEnd", power_dbm);
    ns3::WifiHelper wifi;
    wifi.SetStandard(ns3::WIFI_STANDARD_80211g);
    const ns3::StringValue rate("ErpOfdmRate24Mbps");
    wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode", rate, "NonUnicastMode", rate);
    ns3::WifiMacHelper mac;
    mac.SetType("ns3::AdhocWifiMac");
    const ns3::NetDeviceContainer devices = wifi.Install(phy, mac, nodes);

    auto phase_s = ns3::CreateObject<ns3::UniformRandomVariable>();
    for (uint32_t i = 0; i < devices.GetN(); ++i) {
        devices.Get(i)->SetReceiveCallback(ns3::MakeCallback(&receive));
        ns3::Simulator::ScheduleWithContext(i, ns3::Seconds(1 + phase_s->GetValue(0, 1)), &send,
                                            devices.Get(i));
    }
    ns3::Simulator::Stop(ns3::Seconds(62));
    const std::clock_t begin = std::clock();
    ns3::Simulator::Run();
    const double cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    std::printf("{\"cpu_s\": %.3f, \"sent\": %llu, \"received\": %llu}\n", cpu_s,
                static_cast<unsigned long long>(sent), static_cast<unsigned long long>(received));
    ns3::Simulator::Destroy();
}
