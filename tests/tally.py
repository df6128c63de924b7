#!/usr/bin/env python3
"""Counts test results, in the JUnit files that ctest writes.

usage: tally.py RESULTS_XML...            counts of these files; exit status 0 whatever they are
       tally.py --total RESULTS_XML...    the failures by name, then the line `N passed, N failed,
                                          N skipped`; exit status 1 when any failed or none passed
       tally.py --passed|--failed RESULTS_XML NAME   writes a file with one result
       tally.py --has-failures RESULTS_XML           exit status 0 when the file records a failure
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def read(path):
    """(passed, failed names, skipped) of one file; a file that cannot be read is a failure."""
    try:
        cases = ElementTree.parse(path).getroot().findall("testcase")
    except (OSError, ElementTree.ParseError) as error:
        return 0, [f"{path}: {error}"], 0
    shares = [share_of_program(path, case) or count([case]) for case in cases]
    return (sum(share[0] for share in shares), [name for share in shares for name in share[1]],
            sum(share[2] for share in shares))


def share_of_program(path, case):
    """What GoogleTest wrote of the tests that one process ran: build/PRESET/gtest/NAME.xml beside
    build/results/PRESET.xml. None where the process ended before it wrote, or is no such process."""
    path = pathlib.Path(path)
    written = path.parent.parent / path.stem / "gtest" / f"{case.get('name')}.xml"
    if ".shard_" not in case.get("name", "") or not written.exists():
        return None
    cases = [inner for suite in ElementTree.parse(written).getroot() for inner in suite]
    names = {True: [], False: []}
    for inner in cases:
        names[inner.find("failure") is None].append(
            f"{inner.get('classname')}.{inner.get('name')}")
    skipped = sum(1 for inner in cases if inner.get("result") == "skipped")
    if case.get("status") != "run" and not names[False]:
        return None  # it failed otherwise, such as by a leak
    return len(names[True]) - skipped, names[False], skipped


def count(cases):
    """(passed, failed names, skipped) of test cases that ctest wrote."""
    skipped = [case for case in cases if was_skipped(case)]
    failed = [case.get("name") for case in cases
              if case.get("status") != "run" and case not in skipped]
    return len(cases) - len(failed) - len(skipped), failed, len(skipped)


def was_skipped(case):
    """Skipped by its own word. A test that could not be started is "notrun", too: a failure."""
    reason = case.find("skipped")
    message = "" if reason is None else reason.get("message", "")
    return case.get("status") == "disabled" or message.startswith("SKIP_")


def write(path, name, status):
    suite = ElementTree.Element("testsuite", name=name, tests="1")
    ElementTree.SubElement(suite, "testcase", name=name, status=status)
    pathlib.Path(path).parent.mkdir(parents=True, exist_ok=True)
    ElementTree.ElementTree(suite).write(path)


def main(arguments):
    if arguments[:1] in (["--passed"], ["--failed"]) and len(arguments) == 3:
        write(arguments[1], arguments[2], "run" if arguments[0] == "--passed" else "fail")
        return 0
    if arguments[:1] == ["--has-failures"] and len(arguments) == 2:
        return 0 if pathlib.Path(arguments[1]).exists() and read(arguments[1])[1] else 1
    total = arguments[:1] == ["--total"]
    passed, failed, skipped = 0, [], 0
    for path in arguments[1 if total else 0:]:
        counts = read(path)
        passed += counts[0]
        failed += [f"{pathlib.Path(path).stem}: {name}" for name in counts[1]]
        skipped += counts[2]
    if total:
        for name in failed:
            print(f"FAILED {name}")
    print(f"{passed} passed, {len(failed)} failed, {skipped} skipped")
    return 1 if total and (failed or not passed) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
