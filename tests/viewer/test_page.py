"""Content of the replay page, in a browser."""

import re
import signal
import threading
from pathlib import Path
from random import Random

import pytest

from gradysim.integrated.run import IntegratedRun
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand
from gradysim.prototype.run import PrototypeRun
from gradysim.replay import read_replay
from gradysim.replay.sink import ReplayWriter
from gradysim.scenario import load_scenarios
from gradysim.simulator.extension.visualization_controller import VisualizationController
from gradysim.simulator.handler.mobility import MobilityHandler
from gradysim.simulator.handler.timer import TimerHandler
from gradysim.simulator.handler.visualization import VisualizationConfiguration, VisualizationHandler
from gradysim.simulator.simulation import SimulationBuilder, SimulationConfiguration
from python.quiet_protocol import QUIET, Quiet
from python.thorough import some
from viewer.conftest import record, state, viewing

ROOT = Path(__file__).parents[2]
INTERFERENCE = [0xC1, 0x12, 0x1F]
RECEIVER_TRANSMITTING = [0xD9, 0x48, 0x0F]
LOSS_ROWS = "[...document.querySelectorAll('.details td.muted')].map((cell) => cell.textContent)"
SAYS = """
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Says(Quiet):
    def initialize(self):
        for message in ("nothing", "<b>needle</b> " + "x" * 300):
            self.provider.send_communication_command(BroadcastMessageCommand(message))
"""
FLIES = """
from gradysim.protocol.messages.mobility import GotoCoordsMobilityCommand

class Flies(Quiet):
    def initialize(self):
        self.provider.schedule_timer("", 100)

    def handle_timer(self, timer):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(1e5, 0, 0))
"""
BEACON = """
from gradysim.protocol.messages.communication import BroadcastMessageCommand

class Beacon(Quiet):
    def initialize(self):
        self.handle_timer("")

    def handle_timer(self, timer):
        self.provider.send_communication_command(BroadcastMessageCommand("beacon"))
        self.provider.schedule_timer("", self.provider.current_time() + 0.01)
"""
SCENE = [0xF6, 0xF7, 0xF8]
FOLD = ["g"]  # the legend, which covers names
# The box of the names of nodes: its sides in pixels, and which share of it is covered.
NAMES = """(() => {
  const canvas = document.querySelector("canvas.labels");
  const [width, height] = [canvas.width, canvas.height - 45];  // without the scale
  const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
  const covered = [...Array(width * height).keys()].filter((pixel) => data[4 * pixel + 3] > 100);
  const [x, y] = [covered.map((pixel) => pixel % width), covered.map((pixel) => Math.floor(pixel / width))];
  const [left, right] = [Math.min(...x), Math.max(...x) + 1];
  const area = (right - left) * (Math.max(...y) + 1 - Math.min(...y));
  return { left, right, width, share: covered.length / area, pixels: covered.length };
})()"""
# The lowest contrast of the texts of frames that lie ahead.
CONTRAST = """(() => {
  const rgb = (color) => color.match(/[\\d.]+/g).slice(0, 3).map(Number);
  const luminance = (color) => color
    .map((part) => (part /= 255) <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)
    .reduce((sum, part, index) => sum + part * [0.2126, 0.7152, 0.0722][index], 0);
  const panel = rgb(getComputedStyle(document.body).backgroundColor);
  const contrasts = [...document.querySelectorAll(".frames .later span")].map((text) => {
    let opacity = 1;
    for (let one = text; one; one = one.parentElement) opacity *= getComputedStyle(one).opacity;
    const mix = (part, index) => opacity * part + (1 - opacity) * panel[index];
    const ink = rgb(getComputedStyle(text).color).map(mix);
    const [dark, light] = [luminance(ink), luminance(panel)].sort((a, b) => a - b);
    return (light + 0.05) / (dark + 0.05);
  });
  return Math.min(...contrasts);
})()"""
PAINTED = [0xFF, 0x00, 0xFF]
SPEED_MPS = 10.0


def test_states_equal_those_of_the_reader(zigzag, browser):
    replay, random = read_replay(zigzag), Random(1)
    times = [0, 60, replay.end_s, *(random.uniform(0, replay.end_s) for _ in range(20))]
    assert browser(zigzag, times=times)["states"] == [state(replay, time_s) for time_s in times]


@pytest.mark.verify
def test_a_node_says_what_it_did_not_notice(zigzag, browser):
    replay, station, time_s = read_replay(zigzag), 7, 200.5
    assert replay.run["nodes"][station]["name"] == "groundStation"
    noticed = {reception.frame for reception in replay.receptions() if reception.receiver == station}
    table = replay.table("frames")
    unnoticed = [
        frame
        for frame, (sender, start_ns) in enumerate(zip(table["node"], table["time_ns"], strict=True))
        if start_ns <= time_s * 1e9 and sender != station and frame not in noticed
    ]
    address = f"#t={time_s}&node=groundStation&filter=at:groundStation outcome:Below sensitivity"
    said = browser(zigzag, address=address, keys=["ArrowLeft"], until=f"&frame={unnoticed[-1]}&")
    assert re.search(rf"below sensitivity\s+{len(unnoticed):,} · ", said["text"])
    assert re.search(r"\d others? did not notice it \(below sensitivity\)", said["text"])
    assert re.search(r"distance\s+groundStation\s+below sensitivity\s", said["text"])


@pytest.mark.parametrize("dark", some([False, True]))
def test_it_is_quiet_and_not_blank(town, browser, dark):
    said = browser(town, address="#t=0.7&node=drones[1]", dark=dark, picture=True)
    assert said["console"] == []
    assert said["requests"] == []
    assert said["colors"] > 50


def test_losses_at_the_ground_station_are_red(zigzag, browser):
    near = browser(zigzag, address="#t=1.1&node=groundStation&follow=1", color=RECEIVER_TRANSMITTING)
    assert near["near_pixels"] > 100
    assert "receiver transmitting" in near["text"]
    far = browser(zigzag, address="#t=1.1&filter=kind:ack", color=RECEIVER_TRANSMITTING)
    assert far["near_pixels"] < near["near_pixels"]


@pytest.mark.verify
def test_it_fits_at_200_percent(zigzag, browser):
    assert not browser(zigzag, width=640, height=400, scale=2)["scrolls_sideways"]


@pytest.mark.verify
def test_a_link_shows_what_it_says(zigzag, browser):
    address = "#t=30.5&node=uavs[1]&follow=1&filter=kind:broadcast"
    said = browser(zigzag, address=address, until="id 1 · uavs")
    assert said["address"] == address


def test_the_next_loss_says_who_interfered(zigzag, browser):
    replay = read_replay(zigzag)
    lost = next(row for row in replay.receptions() if row.outcome == "interference")
    rows = replay.table("interferers")
    interferer = rows["node"][list(rows["frame"]).index(lost.frame)]
    said = browser(
        zigzag,
        address="#t=0&filter=outcome:interference",
        keys=["Shift+ArrowRight", "z"],
        until=f"&frame={lost.frame}&",
        color=INTERFERENCE,
    )
    assert f"with {replay.run['nodes'][interferer]['name']} (" in said["text"]
    assert said["near_pixels"] > 300


def test_a_frame_lost_behind_houses_says_which_ones(town, browser):
    said = browser(town, keys=["Shift+ArrowRight", {"until": "West block"}], values={"rows": LOSS_ROWS})
    assert (
        "247 m take 88.0 dB of 13.0 dBm, West block over 300 dB, North-west block over 300 dB"
        in said["values"]["rows"]
    )
    assert "no power, needs -85.0 dBm" in said["values"]["rows"]


def test_nodes_that_are_too_far_away_have_the_power_of_their_distance(browser, tmp_path):
    far = ["sim-time-limit=600ms", "*.drones[*].mobility.initialX=1.2km", "*.drones[*].mobility.initialY=0m"]
    (scenario,) = load_scenarios(ROOT / "configs/town/town.ini", "OpenField", overrides=far)
    IntegratedRun(scenario, replay=ReplayWriter(tmp_path / "far.html")).execute()
    said = browser(
        tmp_path / "far.html",
        address="#t=0.5&node=drones[6]",
        keys=["ArrowRight"],
        until="3 others",
        values={"rows": LOSS_ROWS},
    )
    assert said["values"]["rows"][:2] == [
        "-88.7 dBm, needs -85.0 dBm: 3.7 dB short",
        "1200 m take 101.7 dB of 13.0 dBm",
    ]


@pytest.mark.verify
def test_in_prototype_mode_the_range_is_the_reason(browser, tmp_path):
    (scenario,) = load_scenarios(
        ROOT / "configs/zigzag.ini", "ZigZag5Synchronised", overrides=["sim-time-limit=3s"]
    )
    PrototypeRun(scenario, replay=ReplayWriter(tmp_path / "run.html")).execute()
    said = browser(
        tmp_path / "run.html", keys=["ArrowRight", {"until": "&frame="}], values={"rows": LOSS_ROWS}
    )
    assert set(said["values"]["rows"]) == {"the range is 50.0 m"}


def test_a_message_is_shown_and_found(browser, tmp_path):
    (tmp_path / "says.py").write_text(QUIET + SAYS, encoding="utf-8")
    ini = "sim-time-limit = 1s\n*.uavs.count = 2\n*.uavs[*].mobility.lineStepX = 10m\n"
    (tmp_path / "says.ini").write_text(
        f'[General]\n{ini}*.uavs[*].protocol.class = "says.py:Says"\n', encoding="utf-8"
    )
    IntegratedRun(
        load_scenarios(tmp_path / "says.ini")[0], replay=ReplayWriter(tmp_path / "run.html")
    ).execute()
    shown = "document.querySelector('.details .text').textContent"
    filtered = "#t=0&filter=text:NEEDLE"
    said = browser(
        tmp_path / "run.html", address=filtered, keys=["ArrowRight"], until="Show all", values={"text": shown}
    )
    assert said["values"]["text"] == "<b>needle</b> " + "x" * 186
    show = {"click": ".details button:text('Show all')"}
    said = browser(tmp_path / "run.html", address=filtered, keys=["ArrowRight", show], values={"text": shown})
    assert said["values"]["text"] == "<b>needle</b> " + "x" * 300


def run_of(directory, source, duration_s, more="", run=PrototypeRun):
    """Write the replay of one node that runs the last class of a source, or of more nodes."""
    (directory / "one.py").write_text(QUIET + source, encoding="utf-8")
    protocol = re.findall(r"class (\w+)", source)[-1]
    ini = f"[General]\nsim-time-limit = {duration_s}s\n{more}*.uavs.count = 1\n"
    ini += f'*.uavs[*].protocol.class = "one.py:{protocol}"\n'
    (directory / "one.ini").write_text(ini, encoding="utf-8")
    run(load_scenarios(directory / "one.ini")[0], replay=ReplayWriter(directory / "one.html")).execute()
    return directory / "one.html"


@pytest.mark.parametrize("width", some([390, 1280]))
def test_the_first_view_has_all_places_and_names_of_the_run(browser, tmp_path, width):
    replay = run_of(tmp_path, FLIES, 170)
    fold = FOLD if width == 1280 else []
    said = browser(replay, address="#t=170", width=width, keys=fold, values={"names": NAMES})
    names = said["values"]["names"]
    assert 0.6 * names["width"] < names["left"] < names["right"] - 40 < names["width"] - 42


def test_the_first_view_has_all_corners_of_the_run(town, browser):
    said = browser(town, address="#t=0.1", keys=FOLD, values={"names": NAMES})
    assert said["values"]["names"]["pixels"] > 7800


def test_lines_go_on_behind_names(browser, tmp_path):
    said = browser(run_of(tmp_path, FLIES, 1), keys=FOLD, values={"names": NAMES})
    assert said["values"]["names"]["share"] > 0.95


def test_zooming_to_a_frame_shows_its_interferers(browser, tmp_path):
    three = "*.uavs.count = 2\n*.uavs[*].mobility.lineStepX = 100m\n*.sensors.count = 1\n"
    three += '*.sensors[0].mobility.initialX = 50m\n*.sensors[0].protocol.class = "one.py:Quiet"\n'
    three += "*.*.wlan[*].radio.transmitter.communicationRange = 60m\n"
    replay = run_of(tmp_path, BEACON, 1, three, IntegratedRun)
    said = browser(
        replay,
        keys=[*FOLD, "Shift+ArrowRight", {"until": "with uavs["}, "z"],
        values={"names": NAMES},
    )
    assert said["values"]["names"]["pixels"] > 2000


def test_a_large_range_does_not_color_the_picture(town, browser):
    asked = {"color": SCENE, "within": 3}
    without = browser(town, address="#t=0.05&filter=node:base", **asked)
    chosen = browser(town, address="#t=0.05&filter=node:base&node=drones[1]", **asked)
    assert chosen["near_pixels"] > 0.9 * without["near_pixels"]


def test_a_sender_has_few_rings(browser, tmp_path):
    replay = run_of(tmp_path, BEACON, 2)
    assert browser(replay, address="#t=1.5", keys=["+"] * 3, color=SCENE)["near_pixels"] > 800_000


@pytest.mark.parametrize("dark", [False, True])
def test_frames_ahead_can_be_read(zigzag, browser, dark):
    assert browser(zigzag, dark=dark, values={"contrast": CONTRAST})["values"]["contrast"] > 4.5


def test_a_replay_opens_with_the_outcomes_of_the_whole_run(zigzag, browser):
    replay = read_replay(zigzag)
    said = browser(zigzag, values={"speed": "document.querySelector('select[aria-label=Speed]').value"})
    frames = len(replay.table("frames")["node"])
    assert "Outcomes of the whole run" in said["text"]
    assert f"Frames: {frames:,}." in said["text"]
    assert said["values"]["speed"] == "5"  # 250 s


def test_buttons_say_what_they_do(zigzag, browser):
    titles = "[...document.querySelectorAll('.tools button')].map((button) => button.title)"
    said = browser(zigzag, values={"titles": titles}, keys=["?", {"until": "clear the selection"}])
    assert {
        "View from above, or at an angle again (t)",
        "Zoom in on the chosen frame or node (z)",
        "Show trails: the path of the last 30 s (r)",
    } <= set(said["values"]["titles"])


@pytest.mark.verify
def test_a_wrong_filter_says_so(zigzag, browser):
    browser(zigzag, fill="color:red", until='"color" is not a key')


@pytest.mark.verify
def test_an_outcome_that_does_not_exist_is_answered_with_those_that_do(zigzag, browser):
    said = browser(zigzag, fill="outcome:busy", until='"busy" is not an outcome')
    (names,) = re.findall(r"is not an outcome; expected (.*)", said["text"])
    assert len(set(names.split(", "))) == names.count(", ") + 1
    assert "lost" in names


@pytest.mark.parametrize("text", some(["outcome:Receiver locked", "node:uavs", "at:uavs[1]", "groundst"]))
def test_the_filter_takes_what_the_page_shows(zigzag, browser, text):
    browser(zigzag, address=f"#t=0&filter={text}", keys=["ArrowRight"], until="&frame=")


@pytest.mark.verify
def test_a_filter_that_nothing_fits_says_so(zigzag, browser):
    browser(zigzag, fill="kind:rts", until="No frame of the run fits.")


def test_the_space_bar_plays_and_pauses_wherever_the_focus_is(zigzag, browser):
    toggle = [" ", {"until": "Pause"}, " ", {"until": "Play"}]
    names = "document.querySelector('button[title^=\"Show the names\"]').ariaPressed"
    keys = [{"click": ".frames button >> nth=2"}, {"until": "&frame=2"}, *toggle]
    keys += [{"choose": "uavs[1]"}, *toggle, {"click": "button:text-is('Names')"}, *toggle]
    keys += ["Home", "ArrowRight", {"until": "&frame=0"}]
    assert browser(zigzag, keys=keys, values={"names": names})["values"] == {"names": "false"}


@pytest.mark.verify
def test_enter_chooses_the_frame_that_had_the_focus_though_rows_have_moved(zigzag, browser):
    starts_ns = read_replay(zigzag).table("frames")["time_ns"]
    frame = sum(start_ns <= 100e9 for start_ns in starts_ns) - 30 + 5
    keys = [{"click": ".frames button >> nth=5"}, {"until": f"&frame={frame}"}]
    keys += ["ArrowRight", {"until": f"&frame={frame + 1}"}, "Enter", {"until": f"&frame={frame}"}]
    browser(zigzag, address="#t=100", keys=keys)


@pytest.mark.verify
def test_lines_stay_at_their_nodes_when_the_view_changes(reports, browser):
    replay = read_replay(reports)
    frames = replay.table("frames")
    noticed = {frame for frame, receiver, _ in replay.receptions() if receiver == 0}
    begun = [frame for frame, start_ns in enumerate(frames["time_ns"]) if start_ns > 10e9]
    first, second = [frame for frame in begun if frames["node"][frame] == 0 or frame in noticed][:2]
    steps = [".", {"until": f"&frame={first}"}, ".", {"until": f"&frame={second}"}]
    follows = {"follows": "document.querySelector('button[title^=Follow]').ariaPressed"}
    said = browser(reports, keys=["n", "PageDown", "f", "t", *steps, "a"], values=follows, picture=True)
    assert said["values"] == {"follows": "false"}
    # The same view, without lines drawn before the view changed.
    begun = sum(start_ns <= frames["time_ns"][second] for start_ns in frames["time_ns"])
    row = second - max(0, begun - 30)
    time_s = frames["time_ns"][second] / 1e9
    away = ["PageUp", {"until": f"#t={int(time_s - 10)}"}, "PageDown", {"until": f"#t={int(time_s)}"}]
    choose = [{"click": f".frames button >> nth={row}"}, {"until": f"&frame={second}"}]
    fresh = browser(reports, address=f"#t={time_s}&node=0", keys=["t", "a", *away, *choose], picture=True)
    assert fresh["picture"] == said["picture"]


@pytest.mark.parametrize(("width", "height"), some([(1280, 640), (1280, 800), (1400, 850)]))
def test_the_reason_of_a_loss_is_in_view(zigzag, browser, width, height):
    inside = """(() => {
      const isIn = (inner, outer) => {
        const [a, b] = [inner, outer].map((element) => element.getBoundingClientRect());
        return a.top >= b.top - 1 && a.bottom <= b.bottom + 1;
      };
      const [details, list] = [".details", ".frames"].map((name) => document.querySelector(name));
      return [isIn(details.querySelectorAll("tbody tr")[1], details),
              isIn(list.querySelector("[aria-pressed=true]"), list)];
    })()"""
    address = "#t=0&filter=outcome:interference"
    keys = ["Shift+ArrowRight", {"until": "&frame="}]
    said = browser(zigzag, address=address, width=width, height=height, keys=keys, values={"inside": inside})
    assert said["values"]["inside"] == [True, True]


@pytest.mark.verify
def test_frames_in_the_air_at_the_end_say_so(browser, tmp_path):
    short = record(tmp_path / "short.html", "zigzag.ini", "ZigZag5Synchronised", "1.00001s")
    assert "in the air at the end" in browser(short, address="#t=1")["text"]


@pytest.mark.verify
def test_a_run_that_was_killed_opens(zigzag, browser, tmp_path):
    killed = tmp_path / "killed.html"
    killed.write_bytes(zigzag.read_bytes()[:-2000])
    replay = read_replay(killed)
    said = browser(killed, times=[replay.end_s])
    assert said["states"] == [state(replay, replay.end_s)]
    assert "ended early" in said["text"]


def test_a_run_is_shown_while_it_goes_on(zigzag, browser):
    with viewing(ROOT / "configs/zigzag.ini", "-c", "ZigZag5Synchronised") as (_, address):
        said = browser(None, url=address, after=2, times=[1.5])
    assert said["states"] == [state(read_replay(zigzag), 1.5)]
    assert said["console"] == []


@pytest.mark.parametrize(
    ("keys", "number", "text"),
    some(
        [
            ([" ", {"until": "Play"}], signal.SIGINT, "The run was ended at "),
            ([], signal.SIGTERM, "The run was ended at "),
            ([], signal.SIGKILL, "The connection to the run is lost"),
        ]
    ),
)
def test_a_run_that_is_ended_says_so(browser, keys, number, text):
    # So long that it has not ended before the page has sent its first clock.
    endless = "--set", "sim-time-limit=5000000s"
    with viewing(ROOT / "configs/zigzag.ini", "-c", "ZigZag5Synchronised", *endless) as (view, address):
        said = browser(None, url=address, after=1, keys=keys, kill=[view.pid, number.name], until=text)
        assert view.wait(2) in (128 + number, -number)
    assert said["console"] == []


@pytest.mark.verify
def test_what_a_replay_contains_is_not_executed(town, browser, tmp_path):
    hostile = tmp_path / "hostile.html"
    harm = "<script>window.harm = 1</script><img src=x: onerror='window.harm = 2'>"
    hostile.write_text(town.read_text() + harm)
    said = browser(hostile, values={"harm": "String(window.harm)"})
    assert said["values"] == {"harm": "undefined"}
    assert all("Content Security Policy" in line for line in said["console"])
    assert len(said["console"]) == 3


class Flyer(Quiet):
    """Flies along x, and counts seconds in a variable whose name contains HTML characters."""

    def initialize(self):
        self.provider.send_mobility_command(GotoCoordsMobilityCommand(1e5, 20 * self.provider.get_id(), 0))
        controller = VisualizationController(self)
        controller.paint_node(0, PAINTED)
        controller.resize_nodes(4)
        self.handle_timer("second")

    def handle_timer(self, timer):
        now = self.provider.current_time()
        self.provider.tracked_variables["<b>seconds</b>"] = int(now)
        self.provider.schedule_timer("second", now + 1)


@pytest.fixture
def shown():
    """Return a `VisualizationHandler`, with a simulation that runs in a thread until the test ends."""
    handler = VisualizationHandler(VisualizationConfiguration(host="127.0.0.1", port=0))
    builder = SimulationBuilder(SimulationConfiguration(execution_logging=False, real_time=True))
    for other in (TimerHandler(), MobilityHandler(), handler):
        builder.add_handler(other)
    for node in range(3):
        builder.add_node(Flyer, (0, 20 * node, 0))
    simulation = builder.build()
    simulation.step_simulation()
    stop = threading.Event()

    def run():
        while not stop.is_set():
            simulation.step_simulation()

    thread = threading.Thread(target=run)
    thread.start()
    yield handler
    stop.set()
    thread.join()
    simulation.finalize()


def test_a_simulation_is_shown_while_it_runs(shown, browser):
    url = f"http://127.0.0.1:{shown.port}/#node=Flyer%201&follow=1"
    said = browser(None, url=url, after=2, pause=True, color=PAINTED)
    x_m = SPEED_MPS * said["paused"]["time_s"]
    for node, (x, *rest) in enumerate(said["paused"]["positions"]):
        assert x == pytest.approx(x_m, abs=SPEED_MPS * 0.02)
        assert rest == [20 * node, 0]
    assert shown.paused_s > 0.4
    assert said["near_pixels"] > 50
    assert "<b>seconds</b>" in said["text"]
    assert said["console"] == []
    assert said["requests"] == []
