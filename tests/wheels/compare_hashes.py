"""Run all examples with the installed gradysim, and compare their hashes with the committed ones."""

import sys
import time
from pathlib import Path

import gradysim

TESTS = Path(__file__).parents[1]
sys.path.append(str(TESTS / "fingerprints"))
import fingerprint_file  # noqa: E402


def main() -> None:
    """Exit with a message if a hash differs."""
    print("gradysim of", Path(gradysim.__file__).parent)
    for example, expected in fingerprint_file.read().items():
        start = time.perf_counter()
        if (hashes := example.hashes()) != expected:
            sys.exit(f"{example.file} {example.config} seed {example.seed}: {hashes}, expected {expected}")
        print(example.config, example.seed, *hashes, f"{time.perf_counter() - start:.1f} s")


if __name__ == "__main__":
    main()
