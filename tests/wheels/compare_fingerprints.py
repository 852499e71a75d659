"""Run examples with the installed gradysim, and compare their fingerprints with the committed ones."""

import sys
import time
from pathlib import Path

import gradysim

TESTS = Path(__file__).parents[1]
sys.path.append(str(TESTS / "fingerprints"))
import fingerprint_file  # noqa: E402

CONFIGS = ("ZigZag5", "Rayleigh", "Spread")


def main() -> None:
    """Exit with a message if a fingerprint differs."""
    print("gradysim of", Path(gradysim.__file__).parent)
    for example, expected in fingerprint_file.read().items():
        if example.config in CONFIGS and example.seed == 0:
            start = time.perf_counter()
            if (fingerprint := example.fingerprint()) != expected:
                sys.exit(f"{example.file} {example.config}: {fingerprint}, expected {expected}")
            print(f"{example.config} {fingerprint} {time.perf_counter() - start:.1f} s")


if __name__ == "__main__":
    main()
