"""The lines that docs/guides/propagation.md shows are understood, and the engine takes them."""

from collections.abc import Callable

import pytest

from gradysim.config.scenario import Scenario


def test_its_lines_run(
    code_blocks: Callable[[str, str], list[str]], make_scenario: Callable[..., Scenario]
) -> None:
    pytest.importorskip("gradysim._netsim")
    from gradysim.integrated.run import run

    for block in code_blocks("docs/guides/propagation.md", "ini"):
        scenario = make_scenario("class Tested(Talker): pass", *block.strip().splitlines())
        assert set(scenario.medium) >= {"path_loss", "k_db"}
        assert run(scenario).fates["messages"]["broadcast"]["sent"] > 0
