"""Tests compare attributes and values, not sentences: better wording changes golden files alone.

The tests of this directory compare sentences of pages with the figures in them, and are not counted.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

MOST = 21
"""Comparisons with two or more words, such as titles and lines of a log. Lower it, never raise it."""

WORD = re.compile(r"(?<!\S)\^?[A-Za-z][a-z]+[,;:.?!$]*(?!\S)")
MESSAGE = re.compile(r"\bstr\(|\b(?:err|out|stderr|stdout|printed|text|message|problem|said|told|error)\b")


def compared(node: ast.AST) -> Iterator[ast.expr]:
    """Yield what an assertion or `pytest.raises` looks for in a text."""
    match node:
        case ast.keyword(arg="match", value=text):
            yield text
        case ast.Assert():
            yield from (text for part in ast.walk(node.test) for text in compared(part))
        case ast.Compare(left=text, ops=[ast.In() | ast.NotIn()]):
            yield text
        case ast.Compare(left=left, ops=[ast.Eq()], comparators=[text]) if MESSAGE.search(ast.unparse(left)):
            yield text
        case ast.Call(func=ast.Attribute(attr="startswith" | "endswith"), args=[text]):
            yield text


def words(text: ast.expr) -> int:
    """Return the number of words of a string; names with digits, signs or several capitals are none."""
    parts = ast.walk(text) if isinstance(text, ast.Constant | ast.JoinedStr) else ()
    return sum(len(WORD.findall(str(part.value))) for part in parts if isinstance(part, ast.Constant))


def test_tests_compare_few_sentences(root: Path) -> None:
    found = [
        f"{file}:{text.lineno}"
        for file in (root / "tests/python").rglob("*.py")
        if "house" not in file.parts
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.Assert | ast.keyword)
        for text in compared(node)
        if words(text) > 1
    ]
    assert len(found) <= MOST, found
