"""`gradysim docs`."""

import os
import re
import subprocess
import sys

import pytest

from gradysim.cli.docs import FOLDERS, pages, title_of, with_commands, with_links
from gradysim.cli.examples import files_root
from python.cli.command import environment


def test_all_pages_are_listed(gradysim):
    done = gradysim("docs")
    files = [file for folder in FOLDERS for file in (files_root() / "docs" / folder).glob("*.md")]
    assert len(done.stdout.splitlines()) == len([file for file in files if file.stem != "index"])
    assert "fly-a-mission " in done.stdout


@pytest.mark.parametrize("word", ["fly-a-mission", "docs/how-to/fly-a-mission.md", "Fly a mission"])
def test_a_page_is_found_by_its_name_path_or_title(gradysim, word):
    assert gradysim("docs", word).stdout.startswith("# Fly a mission\n")


def test_pages_with_a_word_in_their_text_are_listed(gradysim):
    listed = gradysim("docs", "lognormal").stdout.splitlines()
    assert len(listed) > 1
    assert "choose-a-propagation-model" in " ".join(listed)


def test_a_misspelled_name_is_answered_with_the_nearest(gradysim):
    done = gradysim("docs", "fly-a-misson")
    assert (done.returncode, done.stdout) == (2, "")
    assert "`fly-a-mission`" in done.stderr


def test_what_only_the_site_understands_is_left_out(gradysim):
    for name, file in pages().items():
        printed = gradysim("docs", name).stdout
        assert printed.startswith(f"# {title_of(file)}\n")
        assert not re.search(r"^```\{|^\{emphasize|^!\[", printed, re.MULTILINE), name


@pytest.mark.skipif(sys.platform == "win32", reason="it has no pseudo terminals")
def test_less_shows_colors(gradysim):
    reader, terminal = os.openpty()
    settings = {name: value for name, value in environment().items() if name != "LESS"}
    settings |= {"TERM": "xterm", "PAGER": """sh -c 'cat > /dev/null; echo "LESS=$LESS"'"""}
    command = [sys.executable, "-m", "gradysim", "docs", "fly-a-mission"]
    subprocess.run(command, stdin=terminal, stdout=terminal, env=settings, check=True)
    assert b"LESS=-R" in os.read(reader, 1000)


def test_keys_name_pages_that_exist(gradysim):
    named = set(re.findall(r"`gradysim docs ([\w-]+)`", gradysim("keys").stdout))
    assert len(named) > 5
    assert named <= pages().keys()


def test_a_page_that_is_named_becomes_a_command_or_a_link():
    text = "(docs/how-to/fly-a-mission.md)"
    assert with_commands(text) == "(`gradysim docs fly-a-mission`)"
    assert with_links(text) == "([fly-a-mission](../how-to/fly-a-mission.md))"
