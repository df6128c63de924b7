#!/usr/bin/env python3
"""Checks that every library looks the same inside and that its README tells the truth.

usage: check_libraries.py HOUSE_JSON

* VERSION, CHANGELOG.md, README.md, include/, tests/, bench/ and examples/ are there, and
  tests/instantiate.cpp, with which headers are checked at -O2. A package inside another library's
  folder has neither VERSION nor CHANGELOG.md of its own.
* The newest entry of CHANGELOG.md is the version in VERSION, with a date.
* Every ```cpp block of README.md (the project's and docs/index.md, too) stands word for word in a
  file of examples/, which the build compiles and runs as a test; every README has one.
* No README holds a word in capitals alone on a line, as one leaves for what is to be filled in.
"""

import json
import pathlib
import re
import sys

PAPERS = ["VERSION", "CHANGELOG.md", "README.md", "include", "tests", "bench", "examples",
          "tests/instantiate.cpp"]
OF_LIBRARIES = ["VERSION", "CHANGELOG.md"]
BLOCK = re.compile(r"^```cpp\n(.*?)^```", re.MULTILINE | re.DOTALL)
ENTRY = re.compile(r"^## \[?(\d+\.\d+\.\d+)\]? - \d{4}-\d{2}-\d{2}$", re.MULTILINE)


def check_readme(readme, example_folders):
    text = readme.read_text(encoding="utf-8")
    blocks = BLOCK.findall(text)
    for placeholder in re.findall(r"^[A-Z_]{3,}$", text, re.MULTILINE):
        yield f"{readme}: {placeholder} is still to be filled in"
    if not blocks:
        yield f"{readme}: has no ```cpp example"
    examples = [path.read_text(encoding="utf-8")
                for folder in example_folders for path in sorted(folder.glob("*.cpp"))]
    for block in blocks:
        if not any(block.strip() in example for example in examples):
            first = block.strip().splitlines()[0] if block.strip() else "(empty)"
            yield f"{readme}: the block that begins with `{first}` is in no file of examples/"


def check_changelog(folder):
    version = (folder / "VERSION").read_text(encoding="utf-8").strip()
    newest = ENTRY.search((folder / "CHANGELOG.md").read_text(encoding="utf-8"))
    if not newest:
        yield f"{folder}/CHANGELOG.md: no entry such as `## 1.0.0 - 2026-01-31`"
    elif newest.group(1) != version:
        yield f"{folder}/CHANGELOG.md: newest entry is {newest.group(1)}, VERSION says {version}"


def check_library(folder):
    is_inside = (folder.parent / "VERSION").exists()
    papers = [paper for paper in PAPERS if not is_inside or paper not in OF_LIBRARIES]
    absent = [paper for paper in papers if not (folder / paper).exists()]
    if absent:
        yield f"{folder}: lacks {', '.join(absent)}"
        return
    if not is_inside:
        yield from check_changelog(folder)
    yield from check_readme(folder / "README.md", [folder / "examples"])


def check(root, folders):
    for folder in folders:
        yield from check_library(folder)
    for page in ("README.md", "docs/index.md"):
        yield from check_readme(root / page, [folder / "examples" for folder in folders])


def main():
    house = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    folders = [pathlib.Path(component["folder"]) for component in house["components"]]
    complaints = list(check(pathlib.Path(house["source"]), folders))
    print("\n".join(complaints) or f"{len(folders)} libraries have their papers in order")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
