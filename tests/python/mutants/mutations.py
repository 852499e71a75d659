"""Small changes of a Python file, each of which some test should notice."""

import ast
from collections.abc import Iterator
from typing import NamedTuple

COMPARISONS = {
    ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "==",
    ast.In: "not in", ast.NotIn: "in", ast.Is: "is not", ast.IsNot: "is",
}  # fmt: skip
OPERATORS = {ast.Add: "-", ast.Sub: "+", ast.Mult: "/", ast.Div: "*", ast.FloorDiv: "*"}


class Mutation(NamedTuple):
    """Another text for a part of a file.

    Attributes:
        line: The line where the part begins, from 1.
        start: Where it begins in the file, in bytes.
        end: Where it ends.
        text: What replaces it.
    """

    line: int
    start: int
    end: int
    text: str

    def applied(self, source: bytes) -> bytes:
        """Return the changed file."""
        return source[: self.start] + self.text.encode() + source[self.end :]


def mutations(source: bytes) -> list[Mutation]:
    """Return all mutations of a file: of comparisons, operators, constants, conditions and statements.

    Texts and annotations stay as they are, and so does what only type checkers read.
    """
    lines = [0]
    for line in source.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))

    def begin(node: ast.expr | ast.stmt) -> int:
        return lines[node.lineno - 1] + node.col_offset

    def end(node: ast.expr | ast.stmt) -> int:
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return lines[node.end_lineno - 1] + node.end_col_offset

    def of(node: ast.AST) -> Iterator[Mutation]:
        def replaced(part: ast.expr | ast.stmt, text: str) -> Mutation:
            return Mutation(part.lineno, begin(part), end(part), text)

        def between(left: ast.expr, right: ast.expr, text: str) -> Mutation:
            """Replace the operator, and keep the parentheses around it."""
            old = source[end(left) : begin(right)].decode()
            before, after = old[: len(old) - len(old.lstrip(") \n\t"))], old[len(old.rstrip("( \n\t")) :]
            return Mutation(left.lineno, end(left), begin(right), f"{before} {text} {after}")

        match node:
            case ast.Compare(left=left, ops=[operator], comparators=[right]):
                yield between(left, right, COMPARISONS[type(operator)])
            case ast.BoolOp(op=operator, values=[left, right]):
                yield between(left, right, "or" if isinstance(operator, ast.And) else "and")
            case ast.BinOp(left=left, op=operator, right=right) if type(operator) in OPERATORS:
                yield between(left, right, OPERATORS[type(operator)])
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                yield replaced(node, f"bool({source[begin(operand) : end(operand)].decode()})")
            case ast.Constant(value=bool(value)):
                yield replaced(node, str(not value))
            case ast.Constant(value=int(value) | float(value)):
                yield replaced(node, str(value + 1))
            case ast.If(test=test) | ast.IfExp(test=test):
                yield replaced(test, f"(not ({source[begin(test) : end(test)].decode()}))")
            case ast.Return(value=ast.expr() as value) if not isinstance(value, ast.Constant):
                yield replaced(value, "None")
            case ast.Expr(value=ast.Call()):
                yield replaced(node, "pass")

    return [mutation for node in _executed(ast.parse(source)) for mutation in of(node)]


def _executed(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes that run, without annotations and `if TYPE_CHECKING`."""
    if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
        return
    yield node
    for name, value in ast.iter_fields(node):
        if name not in ("annotation", "returns", "decorator_list"):
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from _executed(child)
