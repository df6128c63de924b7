#!/usr/bin/env python3
"""Compiles the public headers of all components in one file: what is alike in two libraries must
have one name, or one home.

usage: compile_together.py HOUSE_JSON COMPILER STANDARD

Opt-in headers (interop_headers of cmake/rooms.json) are left out.
"""

import json
import pathlib
import sys

from compile_headers import WARNINGS, compiles, include_folders, public_headers


def main():
    house_path, compiler, standard = sys.argv[1:]
    house = json.loads(pathlib.Path(house_path).read_text(encoding="utf-8"))
    plan = json.loads((pathlib.Path(house["source"]) / "cmake/rooms.json").read_text("utf-8"))
    command = [compiler, f"-std={standard}", *WARNINGS, "-fsyntax-only"]
    text = ""
    for component in house["components"]:
        command += ["-I" + folder for folder in include_folders(house, component["name"])]
        text += "".join(f"#include <{header}>\n" for header in public_headers(component)
                        if header not in plan["interop_headers"])
    result = compiles(command, text)
    print(result.stderr)
    print(f"{text.count('#include')} headers together with {compiler} -std={standard}")
    return 1 if result.returncode != 0 or not text else 0


if __name__ == "__main__":
    sys.exit(main())
