"""Rewrite fingerprints.csv and print what has changed: `make fingerprints`.

A fingerprint is a hash of all events on the air and in the protocols, a result hash one of all that a run
computed. When one changes, a user who repeats a run gets other results. So rewriting is legitimate only if
the change is intended:

- the model or its default values were changed or corrected, and CHANGELOG.md says so under "Changed" or
  "Fixed";
- an example (configs/, examples/) was changed, added or removed;
- the content of a hash was changed.

It is not legitimate to make a test pass after a change without an intended effect: a refactoring, an
optimization, other tools, another machine. Then the test has found a bug. Commit the rewritten file together
with the cause of the change, and name the cause in the message.
"""

import fingerprint_file


def main() -> None:
    """Run all examples and rewrite the file."""
    before = fingerprint_file.read() if fingerprint_file.KEPT.exists() else {}
    now = {example: example.hashes() for example in fingerprint_file.examples()}
    fingerprint_file.write(now.items())
    changed = [example for example in before.keys() | now.keys() if before.get(example) != now.get(example)]
    for example in sorted(changed):
        old, new = (" ".join(map(str, hashes.get(example, ["none"]))) for hashes in (before, now))
        print(f"{example.file} {example.config} seed {example.seed}: {old} -> {new}")
    print(f"{len(changed)} of {len(now)} examples changed")


if __name__ == "__main__":
    main()
