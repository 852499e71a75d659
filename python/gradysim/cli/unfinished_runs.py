"""What a command that ends early has left undone: one line, for whoever counts on all runs being there."""

from collections.abc import Mapping, Sequence

from gradysim.scenario.runs import text_of_runs


def text_of_unfinished(
    config: str, done: Sequence[int], ended: Mapping[int, str], left: Sequence[int]
) -> str:
    """Say which runs of `config` are done, which `ended` otherwise and how, and which are `left`.

    The numbers of each increase; how a run ended is "failed" or "was interrupted".
    """
    which = [f"run {number} {how}" for number, how in ended.items()]
    count = len(done) + len(ended) + len(left)
    which.append(f"{len(done)} of {count} runs {'is' if len(done) == 1 else 'are'} done{_these(done)}")
    if left:
        which.append(f"{len(left)} {'was' if len(left) == 1 else 'were'} not begun{_these(left)}")
    return f"{config}: {', '.join(which)}"


def _these(numbers: Sequence[int]) -> str:
    return f" ({text_of_runs(numbers)})" if numbers else ""
