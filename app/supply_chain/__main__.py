"""`python -m app.supply_chain licences|advisories|sbom FILE`: what the project is built from. See docs/supply-chain.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.supply_chain import advisories, licences, sbom
from app.supply_chain.parts import parts

FINE, WRONG, UNCHECKED = 0, 1, 3


def main(arguments: list[str] | None = None) -> int:
    """Print what is asked for; returns WRONG where a licence is refused; for advisories as `told` does."""
    given = argparse.ArgumentParser(prog="python -m app.supply_chain", description=__doc__)
    asked = given.add_subparsers(dest="asked", required=True)
    asked.add_parser("licences", help="check the licence of every part").add_argument("--table", action="store_true")
    asked.add_parser("advisories", help="ask for known vulnerabilities")
    asked.add_parser("sbom", help="write the list of all parts").add_argument("file", type=Path)
    chosen = given.parse_args(arguments)
    if chosen.asked == "advisories":
        return told([advisories.python(), advisories.npm()])
    found = parts()
    if chosen.asked == "sbom":
        chosen.file.write_text(sbom.document(found))
        print(f"{len(found)} parts written to {chosen.file}")
        return FINE
    wrong = licences.problems(found)
    lines = [*(licences.table(found) if chosen.table else []), *wrong]
    print("\n".join([*lines, f"{len(found)} parts, {len(wrong)} problems with licences"]))
    return WRONG if wrong else FINE


def told(answers: list[advisories.Answer]) -> int:
    """Print the answers; returns WRONG where a vulnerability is known, else UNCHECKED where a package was not checked."""
    for answer in answers:
        print(answer.text)
        for one in answer.found:
            print(f"  {one}")
    if any(answer.found for answer in answers):
        return WRONG
    return FINE if all(answer.complete for answer in answers) else UNCHECKED


if __name__ == "__main__":
    raise SystemExit(main())
