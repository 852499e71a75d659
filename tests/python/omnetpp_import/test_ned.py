"""What is read of NED files."""

from pathlib import Path

from gradysim.omnetpp_import.ned import NedNode, read_networks

NED = """
package showcase;
import inet.node.inet.AdhocHost;

// network Commented { submodules: host: AdhocHost; }
module Relay extends inet.node.inet.SensorNode
{
    parameters:
        int hops = default(3);
}

network Base
{
    parameters:
        int numHosts = default(4);
        @display("bgb=100,100");
    submodules:
        hostA: AdhocHost {
            @display("p=10,20.5;i=device/cellphone"); // its place
        }
        medium: Other;
        visualizer: <default("Shown")> like IVisualizer if hasVisualizer() { @display("p=1,2"); }
        host[numHosts]: <default("AdhocHost")> like INetworkNode {
            @display("p=30,40");
        }
}

network Wall extends Base
{
    parameters:
        numHosts = 2;
    submodules:
        radioMedium: <default("UnitDiskRadioMedium")> like IRadioMedium { }
        relay: Relay;
}
"""


def test_networks(tmp_path: Path) -> None:
    (tmp_path / "Wall.ned").write_text(NED)
    networks = read_networks(tmp_path)
    assert sorted(networks) == ["Base", "GradysNetwork", "Wall"]
    host_a, hosts = networks["Base"].nodes
    assert host_a == NedNode("hostA", "", "AdhocHost", ("10", "20.5"))
    assert (hosts, hosts.written, hosts.size_key) == (
        NedNode("host", "numHosts", "AdhocHost"),
        "host[*]",
        "numHost",
    )
    assert networks["Base"].medium == ""
    wall = networks["Wall"]
    assert (wall.source, wall.medium, wall.sizes) == ("Wall.ned", "UnitDiskRadioMedium", {"numHosts": "4"})
    assert wall.nodes == (NedNode("relay", "", "SensorNode"), host_a, hosts)


def test_what_is_known_of_the_network_of_gradys(tmp_path: Path) -> None:
    network = read_networks(tmp_path)["GradysNetwork"]
    assert network.medium == "Ieee802154NarrowbandScalarRadioMedium"
    assert [node.written for node in network.nodes] == ["quads[*]", "sensors[*]", "groundStation"]
    assert network.sizes == {"numUAVs": "1", "numSensors": "1"}


def test_a_file_is_preferred_to_what_is_known(tmp_path: Path) -> None:
    (tmp_path / "GradysNetwork.ned").write_text(
        "network GradysNetwork { int numClients = default(2); submodules: client[numClients]: AdhocHost; }"
    )
    assert [node.name for node in read_networks(tmp_path)["GradysNetwork"].nodes] == ["client"]
