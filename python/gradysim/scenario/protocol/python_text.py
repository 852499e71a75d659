"""Reads the text of protocols, where it is looked at without being run."""

import ast
import warnings


def parsed_python(text: str | bytes) -> ast.Module:
    r"""Return the syntax tree of a Python file, without a word about what is doubtful in it, such as "\d".

    The interpreter warns of that where the file is loaded; told here it would name no file, and again at each
    start. Warnings that are to be errors would make it no Python.

    Raises:
        SyntaxError, ValueError, RecursionError, MemoryError: It is no Python.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(text)
