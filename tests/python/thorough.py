"""Tests with many cases: `make test` runs some of them, `make test-slow` the others."""

from collections.abc import Iterable
from typing import Any

import pytest


def some(cases: Iterable[Any], count: int = 1) -> list[Any]:
    """Return arguments of `pytest.mark.parametrize`; after the first `count` they are marked `verify`."""
    values = list(cases)
    rest = [
        pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.verify)
        for case in values[count:]
    ]
    return [*values[:count], *rest]
