"""The lines that docs/guides/propagation.md shows are understood, and the engine takes them."""

from collections.abc import Callable

import pytest

from gradysim.config.scenario import Scenario


def test_its_lines_run(
    code_blocks: Callable[[str, str], list[str]], make_scenario: Callable[..., Scenario]
) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    fading, antennas, obstacles = (
        make_scenario("class Tested(Talker): pass", *block.strip().splitlines())
        for block in code_blocks("docs/guides/propagation.md", "ini")
    )
    assert set(fading.medium) >= {"path_loss", "k_db"}
    assert antennas.nodes[0].wlan[0].antenna["typename"].value == "ParabolicAntenna"
    assert len(obstacles.obstacles) == 2
    for scenario in (fading, antennas, obstacles):
        assert run(scenario).fates["messages"]["broadcast"]["sent"] > 0
