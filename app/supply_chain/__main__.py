"""`python -m app.supply_chain licences|advisories|sbom FILE`: what the project is built from. See docs/supply-chain.md."""

from __future__ import annotations

import argparse
from pathlib import Path

from app.supply_chain import advisories, licences, sbom
from app.supply_chain.parts import parts


def main(arguments: list[str] | None = None) -> int:
    """Print what is asked for; returns 1 where a licence is refused or a vulnerability is known."""
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
        return 0
    wrong = licences.problems(found)
    lines = [*(licences.table(found) if chosen.table else []), *wrong]
    print("\n".join([*lines, f"{len(found)} parts, {len(wrong)} problems with licences"]))
    return int(bool(wrong))


def told(answers: list[advisories.Answer]) -> int:
    """Print the answers of the services; returns 1 only where they know a vulnerability."""
    for answer in answers:
        print(answer.text)
        for one in answer.found:
            print(f"  {one}")
    return int(any(answer.found for answer in answers))


if __name__ == "__main__":
    raise SystemExit(main())
