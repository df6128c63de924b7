#!/usr/bin/env python3
"""Runs clang-tidy on files, in parallel; a header is checked through one source that includes it.

usage: tidy.py BUILD_FOLDER < NAMES      (each name ended by a NUL)

A header that no compiled source includes directly is an error: nobody would ever compile it.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys


def sources_of(files, compiled):
    """The compiled sources through which the files are seen, and headers nobody includes."""
    texts = {path: path.read_text(encoding="utf-8") for path in compiled}
    for header in pathlib.Path("libs").rglob("*.h"):  # a source may include it by way of another
        texts.setdefault(header.resolve(), header.read_text(encoding="utf-8"))
    chosen, orphans = set(), []
    for file in files:
        if file.resolve() in compiled:
            chosen.add(file.resolve())
        elif file.suffix == ".h":
            source = source_that_sees(file.resolve(), texts, compiled)
            if source:
                chosen.add(source)
            else:
                orphans.append(file)
    return sorted(chosen), orphans


def source_that_sees(header, texts, compiled):
    """Breadth first: who includes the header, who includes those, until a compiled source."""
    seen, front = {header}, [header]
    while front:
        following = []
        for wanted in front:
            name = re.sub(r".*/include/", "", wanted.as_posix())
            ends = re.compile(rf'#include ["<]({re.escape(name)}|{re.escape(wanted.name)})[">]')
            includers = sorted(p for p, text in texts.items() if p not in seen and ends.search(text))
            for path in includers:
                if path in compiled:
                    return path
            seen.update(includers)
            following += includers
        front = following
    return None


def tidy(folder, source):
    command = ["clang-tidy-14", "--quiet", "-p", str(folder), str(source)]
    result = subprocess.run(command, text=True, capture_output=True, check=False)
    return source, result.returncode, result.stdout


def main():
    folder = pathlib.Path(sys.argv[1])
    files = [pathlib.Path(name) for name in sorted(set(sys.stdin.read().split("\0"))) if name]
    # tests/packaging/new_component is compiled by the tests, in a copy of the tree.
    files = [file for file in files if "new_component" not in file.parts]
    entries = json.loads((folder / "compile_commands.json").read_text(encoding="utf-8"))
    compiled = {pathlib.Path(entry["file"]).resolve() for entry in entries}
    sources, orphans = sources_of(files, compiled)
    failed = len(orphans)
    for orphan in orphans:
        print(f"{orphan}: no compiled source includes this header")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for source, status, printed in pool.map(lambda s: tidy(folder, s), sources):
            if status != 0:
                failed += 1
                print(printed)
    print(f"clang-tidy: {len(sources)} sources for {len(files)} files, {failed} with complaints")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
