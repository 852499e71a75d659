"""The page in the package is the one built from its sources."""

import subprocess

from gradysim.viewer.page import page


def test_the_page_is_built_from_its_sources(viewer, tmp_path):
    built = tmp_path / "page.html"
    subprocess.run(["node", "build.mjs", built], cwd=viewer, check=True)
    assert built.read_text(encoding="utf-8") == page(), "run `make viewer`"


def test_its_sources_pass_their_checks(viewer):
    done = subprocess.run(["npm", "run", "--silent", "check"], cwd=viewer, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
