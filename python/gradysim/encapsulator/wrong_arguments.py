"""A call of the provider with the wrong arguments, told as Python tells it.

What pybind11 says of such a call are several lines with C++ types, and nothing of the argument that is
missing. The calls go straight to the engine, so that this is put right afterwards, and costs nothing before.
"""

import ast
import inspect
import re

from gradysim.protocol.interface import IProvider

_TOLD = re.compile(
    r"(?P<name>\w+)\(\): incompatible function arguments\. .*"
    r"\nInvoked with: <gradysim\._netsim\.Node object at \w+>(?:, |; )?(?P<given>.*)",
    re.DOTALL,
)

_MOST_LETTERS = 200
"""Shown of what was given."""


def reword_wrong_arguments(failure: BaseException) -> None:
    """Give `failure` another text if it is about arguments of a method of the provider."""
    match = _TOLD.match(str(failure)) if isinstance(failure, TypeError) else None
    method = getattr(IProvider, match["name"], None) if match else None
    if match is None or not callable(method):
        return
    _, *parameters = inspect.signature(method).parameters.values()  # but for self
    signature = inspect.Signature(parameters)
    given = re.sub(r"(?:^|; )kwargs: ", lambda kwargs: ", " if kwargs.start() else "", match["given"].strip())
    expected = f"{match['name']}({', '.join(signature.parameters)})"
    problem = _problem(signature, given) or "these are the wrong arguments"
    shown = given if len(given) <= _MOST_LETTERS else f"{given[:_MOST_LETTERS]}…"
    failure.args = (f"{match['name']}({shown}): {problem}; expected {expected}",)


def _problem(signature: inspect.Signature, given: str) -> str:
    """What is wrong with the arguments; "" if that cannot be known, as their texts are no Python."""
    try:
        call = ast.parse(f"f({given})", mode="eval").body
        assert isinstance(call, ast.Call)
        signature.bind(*call.args, **{str(keyword.arg): keyword.value for keyword in call.keywords})
    except TypeError as error:
        return str(error)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return ""
    return ""
