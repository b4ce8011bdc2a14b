#!/usr/bin/env python3
"""Compares the verdicts of reports of `pliant experiment`, one for each seed, and with the failures that are known.

    compare_verdicts.py KNOWN_FAILURES REPORT.json...

KNOWN_FAILURES has a line for each: the experiment, a colon, and how its claim begins; lines with # say why.
Ends with 1 where a verdict changes, where a claim does not hold that is not known to, or one that is known to holds.
"""
import json
import sys
from pathlib import Path


def known_failures(path):
    lines = [line.strip() for line in Path(path).read_text(encoding="utf-8").splitlines()]
    return [tuple(part.strip() for part in line.split(":", 1)) for line in lines if line and not line.startswith("#")]


def verdicts(path):
    """Of each chapter's claims, by their texts."""
    report = json.loads(Path(path).read_text(encoding="utf-8"))
    return {(chapter["name"], claim["text"]): claim["verdict"]
            for chapter in report["chapters"] for claim in chapter["claims"]}


def main(arguments):
    if len(arguments) < 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    known = known_failures(arguments[0])
    reports = [verdicts(path) for path in arguments[1:]]
    ran = {name for name, _ in reports[0]}
    faults = []
    seen = set()
    for claim in dict.fromkeys(claim for report in reports for claim in report):
        found = [report.get(claim, "missing") for report in reports]
        if len(set(found)) > 1:
            faults.append(f"{claim[0]}: the verdict changes with the seed, {', '.join(found)}: {claim[1]}")
        listed = [entry for entry in known if entry[0] == claim[0] and claim[1].startswith(entry[1])]
        seen.update(listed)
        if "does not hold" in found and not listed:
            faults.append(f"{claim[0]}: does not hold, and is not known not to: {claim[1]}")
        if "holds" in found and listed:
            faults.append(f"{claim[0]}: holds, although listed as a known failure: {claim[1]}")
    faults += [f"{name}: there is no such claim, but a known failure of it: {text}"
               for name, text in known if name in ran and (name, text) not in seen]
    for fault in faults:
        print(fault)
    print(f"{len(reports[0])} claims, {len(reports)} seed{'s' if len(reports) > 1 else ''}: "
          f"{'the same verdicts, as known' if not faults else f'{len(faults)} not as they should be'}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
