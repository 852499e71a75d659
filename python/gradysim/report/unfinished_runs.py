"""What a command that ends early has left undone: one line, for whoever counts on all runs being there."""

from collections.abc import Sequence

from gradysim.config.run_numbers import text_of_runs


def text_of_unfinished(config: str, numbers: Sequence[int], done: int, how: str = "") -> str:
    """Say which runs there are and are not, after `done` of these runs of `config` have come to their end.

    `how` the next one ended, "failed" or "was interrupted"; "" if it was not begun.
    """
    begun = done + bool(how)
    which = [f"run {numbers[done]} {how}"] if how else []
    which.append(f"{done} of {len(numbers)} runs {'is' if done == 1 else 'are'} done{_these(numbers[:done])}")
    left = numbers[begun:]
    if left:
        which.append(f"{len(left)} {'was' if len(left) == 1 else 'were'} not begun{_these(left)}")
    return f"{config}: {', '.join(which)}"


def _these(numbers: Sequence[int]) -> str:
    return f" ({text_of_runs(numbers)})" if numbers else ""
