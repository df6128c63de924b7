#!/usr/bin/env python3
"""Joins the headers of a library to one file that needs the standard library only.

usage: amalgamate.py HOUSE_JSON COMPONENT FILE

Which headers: "single_headers" of cmake/rooms.json. What they include of gslam/ is put in its
place, once.
"""

import json
import pathlib
import re
import sys

INCLUDE = re.compile(r"^#include <(gslam/[^>]+)>.*$")


class Amalgamation:
    def __init__(self, folders):
        self.folders = [pathlib.Path(folder) for folder in folders]
        self.seen = set()
        self.lines = []

    def find(self, name):
        for folder in self.folders:
            if (folder / name).is_file():
                return folder / name
        raise FileNotFoundError(f"{name}: is in none of {', '.join(map(str, self.folders))}")

    def add(self, name):
        """Puts a header at the end, and before each line of it what it includes."""
        if name in self.seen:
            return
        self.seen.add(name)
        for line in self.find(name).read_text(encoding="utf-8").splitlines():
            include = INCLUDE.match(line)
            if include:
                self.add(include.group(1))
            elif line.strip() != "/// @file":  # there is one file now
                self.lines.append(line)


def include_folders(house, name):
    """Folders of the component and of all that it depends on; the generated ones, too."""
    component = next(c for c in house["components"] if c["name"] == name)
    folders = [component["folder"] + "/include", component["generated"]]
    for dependency in component["depends"]:
        folders += [f for f in include_folders(house, dependency) if f not in folders]
    return folders


def amalgamate(house, name):
    """The text of the file."""
    plan = json.loads((pathlib.Path(house["source"]) / "cmake/rooms.json").read_text("utf-8"))
    headers = plan["single_headers"][name]
    made = Amalgamation(include_folders(house, name))
    for header in headers:
        made.add(header)
    rooms = {header.split("/")[1] for header in made.seen if header.count("/") > 1}
    versions = ", ".join(f"{c['name']} {c['version']}" for c in house["components"]
                         if c["name"] in rooms)
    head = [f"// {' and '.join(f'<{header}>' for header in headers)} of GSLAM in one file.",
            f"// Made by cmake/amalgamate.py from {versions}; change those.", "#pragma once", ""]
    return "\n".join(head + made.lines) + "\n"


def main():
    house_path, name, output = sys.argv[1:]
    house = json.loads(pathlib.Path(house_path).read_text(encoding="utf-8"))
    pathlib.Path(output).write_text(amalgamate(house, name), encoding="utf-8")


if __name__ == "__main__":
    main()
