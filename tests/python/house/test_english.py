"""Plain technical English: phrases that it does not use, and words per sentence, for each kind of file.

`make lint` runs this file and prints the figures. A failure lists the lines to rewrite.
"""

import ast
import io
import re
import textwrap
import tokenize
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

ProjectFiles = Callable[..., list[Path]]

pytestmark = pytest.mark.verify

MOST_WORDS_PER_SENTENCE = 16.0
"""The mean of a document and of all files of another kind."""

MOST_PHRASES_PER_1000_WORDS = 0.5
LONG_SENTENCE = 25
"""A sentence with more words is listed when the mean is too high."""

FEWEST_WORDS = 100
"""A shorter document has no mean worth a test."""

LITERAL_WORDS = 4
"""A string literal with fewer words is a name or a key, not a message."""

PLAIN = {
    r"(?<!here\s)\b(?:is|are|was|were) no (?!longer|more\b|need|way|reason|such)\w+": "is not a",
    r"\b(?:has|have|had) not (?!\w+(?:ed|en|un|wn|ne|id|ad|ft|pt|ent|et)\b|run\b|heard\b)\w+": (
        "does not have"
    ),
    r"(?:^|(?<=[.:;]\s))Who (?:\w+s|has)\b(?![^.]*\?)": "To do X, ...; if you ...",
    r"\bwho(?:ever| has| wants| compares| needs| asks| sends| reads| writes)\b": "name the actor",
    r"\b(?:no|some|any)body\b": "name the actor",
    r"\b(?:is|are|was|were) told\b|\b(?:tell|say)s? of\b": "is notified, is reported, reports",
    r"\banew\b": "again",
    r"\bmend(?:s|ed|ing)?\b": "fix",
    r"\bwhole numbers?\b": "integer",
    r"(?:^|(?<=[.:;]\s))[Nn]or\b": "and ... not",
    r"\bwork(?:s|ed)? out\b": "compute",
    r"\bin the place of\b": "instead of",
    r"\bas ever\b|\bfor want of\b|\bfor ever\b|\bso many\b": "plain words",
}
"""Patterns of phrases, and what to write for them. Spaces of a pattern fit line ends, too."""

_PLAIN = {re.compile(pattern.replace(" ", r"\s+")): better for pattern, better in PLAIN.items()}


@dataclass(frozen=True)
class Passage:
    """Text that people read: a paragraph, a comment, a message."""

    file: Path
    line: int
    text: str

    def sentences(self) -> list[str]:
        return [part for part in re.split(r"(?<=[.!?])[)\"'*_]*\s+", self.text) if words(part)]


@dataclass
class Figures:
    """What was counted in passages."""

    words: int = 0
    sentences: int = 0
    phrases: list[str] = field(default_factory=list)
    long_sentences: list[str] = field(default_factory=list)

    def add(self, passage: Passage) -> None:
        self.words += words(passage.text)
        for sentence in passage.sentences():
            self.sentences += 1
            if words(sentence) > LONG_SENTENCE:
                start = " ".join(sentence.split()[:8])
                self.long_sentences.append(
                    f"{passage.file}:{passage.line}: {words(sentence)} words: {start} ..."
                )
        for pattern, better in _PLAIN.items():
            for hit in pattern.finditer(passage.text):
                line = passage.line + passage.text.count("\n", 0, hit.start())
                found = " ".join(hit[0].split())
                self.phrases.append(f"{passage.file}:{line}: `{found}`; better: {better}")

    @property
    def words_per_sentence(self) -> float:
        return self.words / max(1, self.sentences)

    @property
    def phrases_per_1000_words(self) -> float:
        return 1000 * len(self.phrases) / max(1, self.words)

    def __str__(self) -> str:
        return (
            f"{self.words:6} words, {self.words_per_sentence:4.1f} per sentence, "
            f"{self.phrases_per_1000_words:.1f} phrases per 1,000 words"
        )


def words(text: str) -> int:
    """Return the number of words; code in backticks is one."""
    return len(re.findall(r"`[^`]*`|[^\s`]*\w[^\s`]*", text))


def paragraphs(file: Path, line: int, text: str) -> Iterator[Passage]:
    """Split text at empty lines, headings and items of lists. Leave out code, tables and directives."""
    pending: list[str] = []
    start = line
    fence = ""
    code = False
    for number, raw in enumerate([*text.splitlines(), ""], start=line):
        stripped = raw.strip()
        opening = re.match(r"(`{3,}|:{3,})", stripped)
        if fence:
            fence = "" if stripped == fence else fence
            continue
        code = (raw.startswith("    ") or not stripped) and (code or (not pending and raw.startswith("    ")))
        if pending and (not stripped or opening or re.match(r"[#|>]|[-*] |\d+\. |\w+:$", stripped)):
            yield Passage(file, start, "\n".join(pending))
            pending = []
        if opening:
            fence = opening[1] if opening[1].startswith("`") else ""
        elif stripped and not code and not re.match(r"\||\[[^]]+\]: |:\w+:|\(\w+\)=", stripped):
            start = start if pending else number
            pending.append(re.sub(r"\]\([^)\s]*\)", "]", stripped))


def of_document(file: Path, text: str) -> Iterator[Passage]:
    yield from paragraphs(file, 1, text)


def of_python(file: Path, text: str) -> Iterator[Passage]:
    """Docstrings, also those of attributes, and comments."""
    for node in ast.walk(ast.parse(text)):
        if (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        ):
            first, _, rest = node.value.value.partition("\n")
            yield from paragraphs(file, node.lineno, f"{first.strip()}\n{textwrap.dedent(rest)}")
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    comments = [(*token.start, token.string) for token in tokens if token.type == tokenize.COMMENT]
    yield from joined(file, [(line, column, string.lstrip("#:! ")) for line, column, string in comments])


def of_slashes(file: Path, text: str) -> Iterator[Passage]:
    """Comments of C++ and TypeScript."""
    found = []
    for number, line in enumerate(text.splitlines(), start=1):
        slashes = re.search(r"(?:^|[\s;{}])//+[!<]?(.*)", line)
        if hit := slashes or re.match(r"\s*/?\*+(?!/)(.*?)(?:\*/)?$", line):
            found.append((number, hit.start(), hit[1]))
    yield from joined(file, found)


def of_ini(file: Path, text: str) -> Iterator[Passage]:
    lines = enumerate(text.splitlines(), start=1)
    comments = [
        (number, hit.start(), hit[1])
        for number, line in lines
        if (hit := re.search(r"(?:^|\s)#\s?(.*)", line))
    ]
    yield from joined(file, comments)


def joined(file: Path, comments: list[tuple[int, int, str]]) -> Iterator[Passage]:
    """Join comments of consecutive lines that begin in the same column."""
    lines: list[str] = []
    start = previous_line = previous_column = -1
    for line, column, text in comments:
        if re.match(r"\s*(?:noqa|type:|NOLINT|clang-format|@ts-|pragma:)", text):
            continue
        text = re.sub(r"\s*(?:#|//) ?(?:noqa|type:|NOLINT).*", "", text)
        if lines and (line, column) != (previous_line + 1, previous_column):
            yield from paragraphs(file, start, "\n".join(lines))
            lines = []
        start = start if lines else line
        lines.append(text.strip())
        previous_line, previous_column = line, column
    if lines:
        yield from paragraphs(file, start, "\n".join(lines))


def messages_of_python(file: Path, text: str) -> Iterator[Passage]:
    """String literals that are messages or help; a value that is put in counts as a word."""
    tree = ast.parse(text)
    nodes = list(ast.walk(tree))
    docstrings = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    parts = {id(part) for node in nodes if isinstance(node, ast.JoinedStr) for part in node.values}
    for node in nodes:
        literal = ""
        if isinstance(node, ast.JoinedStr):
            values = (part.value if isinstance(part, ast.Constant) else "X" for part in node.values)
            literal = "".join(str(value) for value in values)
        elif (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and id(node) not in docstrings | parts
        ):
            literal = node.value
        if words(literal) >= LITERAL_WORDS:
            yield Passage(file, node.lineno, literal)


def messages_of_cpp(file: Path, text: str) -> Iterator[Passage]:
    for number, line in enumerate(text.splitlines(), start=1):
        for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', line.partition("// ")[0]):
            if words(literal) >= LITERAL_WORDS:
                yield Passage(file, number, literal)


READERS: dict[str, Callable[[Path, str], Iterator[Passage]]] = {
    ".md": of_document,
    ".py": of_python,
    ".cpp": of_slashes,
    ".hpp": of_slashes,
    ".ts": of_slashes,
    ".ini": of_ini,
}
MESSAGE_READERS = {".py": messages_of_python, ".cpp": messages_of_cpp, ".hpp": messages_of_cpp}

KINDS = {
    "python": ("python/", READERS),
    "messages": (("python/", "cpp/"), MESSAGE_READERS),
    "cpp": ("cpp/", READERS),
    "viewer": ("viewer/", READERS),
    "tests": ("tests/", READERS),
    "bench": ("bench/", READERS),
    "examples": (("examples/", "configs/", "docs/"), READERS),
}
"""For each kind of file the beginnings of its paths, and how its files are read; documents are apart."""


def read(
    root: Path, files: list[Path], readers: dict[str, Callable[[Path, str], Iterator[Passage]]]
) -> Figures:
    figures = Figures()
    for file in files:
        for passage in readers[file.suffix](file, (root / file).read_text()):
            figures.add(passage)
    return figures


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.md", "# Title\n\nWho reads `x = 1` is told.\nShort.\n\n```sh\nnobody\n```\n"),
        ("a.py", '"""Who reads `x = 1` is told.\n\nShort.\n"""\nx = 1  # Title\n'),
        ("a.cpp", "// Who reads `x = 1` is told.\n// Short.\nint x;  // Title\n"),
        ("a.ts", "/** Who reads `x = 1` is told.\n * Short.\n */\nlet x;  // Title\n"),
        ("a.ini", "# Who reads `x = 1` is told.\n# Short.\nx = 1  # Title\n"),
    ],
)
def test_words_sentences_and_phrases_are_counted(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    figures = read(tmp_path, [Path(name)], READERS)
    assert (figures.words, figures.sentences, len(figures.phrases)) == (7, 3, 2)


def test_messages_are_string_literals_of_several_words(tmp_path: Path) -> None:
    (tmp_path / "a.py").write_text('"""Docstring."""\nx = f"`{x}` is no value of y", "a key"\n')
    (tmp_path / "a.cpp").write_text('f("a key", "`x` is no value of y");  // a "comment of four words"\n')
    figures = read(tmp_path, [Path("a.py"), Path("a.cpp")], MESSAGE_READERS)
    assert (figures.sentences, len(figures.phrases)) == (2, 2)


@pytest.mark.parametrize("kind", KINDS)
def test_sources_are_plain_english(kind: str, root: Path, project_files: ProjectFiles) -> None:
    beginnings, readers = KINDS[kind]
    # tests/corpus holds files that are broken on purpose.
    files = [
        file
        for file in project_files(*readers.keys() - {".md"})
        if str(file).startswith(beginnings) and not str(file).startswith("tests/corpus/")
    ]
    figures = read(root, files, readers)
    print(f"\n{kind:10} {figures}", end="")
    assert figures.phrases_per_1000_words <= MOST_PHRASES_PER_1000_WORDS, "\n".join(figures.phrases)
    assert figures.words_per_sentence <= MOST_WORDS_PER_SENTENCE, "\n".join(figures.long_sentences)


def test_documents_are_plain_english(root: Path, project_files: ProjectFiles) -> None:
    documents = project_files(".md")
    figures = read(root, documents, READERS)
    print(f"\ndocuments  {figures}", end="")
    assert figures.phrases_per_1000_words <= MOST_PHRASES_PER_1000_WORDS, "\n".join(figures.phrases)


def test_sentences_of_each_document_are_short(root: Path, project_files: ProjectFiles) -> None:
    each = {file: read(root, [file], READERS) for file in project_files(".md")}
    offenders = [
        f"{file}: {figures.words_per_sentence:.1f} words per sentence\n" + "\n".join(figures.long_sentences)
        for file, figures in each.items()
        if figures.words >= FEWEST_WORDS and figures.words_per_sentence > MOST_WORDS_PER_SENTENCE
    ]
    assert not offenders, "\n".join(offenders)
