"""Extensions of prototype mode in integrated mode: those that work, and errors of the others."""

import pytest

from gradysim.integrated.run import run

CAMERA = """
from gradysim.simulator.extension.camera import CameraConfiguration, CameraHardware
class Tested(Quiet):
    def initialize(self):
        self.camera = CameraHardware(self, CameraConfiguration(100, 10, 90, 0))
        if self.provider.get_id() == 1:
            self.provider.send_mobility_command(GotoCoordsMobilityCommand(50, 0, 0))
    def finish(self):
        self.provider.tracked_variables["seen"] = self.camera.take_picture()
"""

CAMERA_OF_ONES_OWN = """
from gradysim.simulator.extension.camera import CameraConfiguration, CameraHardware
class Counting(CameraHardware):
    def take_picture(self):
        return {SEEN}
class Tested(Quiet):
    def finish(self):
        seen = Counting(self, CameraConfiguration(100, 180, 90, 0)).take_picture()
        self.provider.tracked_variables["seen"] = seen
"""

RADIO = """
from gradysim.simulator.extension.radio import Radio
class Tested(Quiet):
    def initialize(self): Radio(self)
"""

VISUALIZATION = """
from gradysim.simulator.extension.visualization_controller import VisualizationController
class Tested(Quiet):
    def initialize(self): VisualizationController(self).paint_node(0, (255, 0, 0))
"""


def test_a_camera_sees_where_the_engine_has_the_nodes(make_scenario):
    result = run(make_scenario(CAMERA))
    (seen,) = result.nodes[0].tracked_variables["seen"]
    assert seen == {"position": pytest.approx((30.5, 0, 0)), "type": "node"}


def test_a_camera_sees_nothing_behind_it(make_scenario):
    assert run(make_scenario(CAMERA)).nodes[1].tracked_variables["seen"] == []


def test_a_camera_of_ones_own_can_do_more_with_what_is_seen(make_scenario):
    protocol = CAMERA_OF_ONES_OWN.replace("{SEEN}", "len(super().take_picture())")
    assert run(make_scenario(protocol)).nodes[0].tracked_variables["seen"] == 1


def test_a_camera_that_looks_at_nodes_of_python_says_where_it_works(make_scenario):
    protocol = CAMERA_OF_ONES_OWN.replace("{SEEN}", "len(self._mobility.nodes)")
    with pytest.raises(RuntimeError, match=r"^Counting .*prototype"):
        run(make_scenario(protocol))


def test_a_radio_says_in_which_mode_it_does_not_work(make_scenario):
    with pytest.raises(TypeError, match=r"prototype.* integrated"):
        run(make_scenario(RADIO))


def test_the_visualization_controller_does_nothing(make_scenario):
    run(make_scenario(VISUALIZATION))
