#!/usr/bin/env python3
"""Compiles every public header of a component alone, under all warnings.

usage: compile_headers.py HOUSE_JSON COMPONENT COMPILER STANDARD [FLAG ...]

Each header is compiled twice-included and by itself at -O0; tests/instantiate.cpp, which
instantiates the templates and kernels, at -O0 and -O2. Opt-in headers (interop_headers of
cmake/rooms.json) are left out where their library is not installed.
"""

import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "cmake"))
from amalgamate import include_folders  # noqa: E402

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]


def public_headers(component):
    for folder in (component["folder"] + "/include", component["generated"]):
        root = pathlib.Path(folder)
        for path in sorted(root.rglob("*.h")):
            yield path.relative_to(root).as_posix()


def can_include(command, prefix_header):
    probe = f"#if !__has_include(<{prefix_header}>)\n#error\n#endif\n"
    return compiles(command + ["-fsyntax-only"], probe).returncode == 0


def compiles(command, text):
    return subprocess.run(command + ["-x", "c++", "-"], input=text, text=True,
                          capture_output=True, check=False)


def main():
    house_path, name, compiler, standard, *flags = sys.argv[1:]
    house = json.loads(pathlib.Path(house_path).read_text(encoding="utf-8"))
    plan = json.loads((pathlib.Path(house["source"]) / "cmake/rooms.json").read_text("utf-8"))
    component = next(c for c in house["components"] if c["name"] == name)
    command = [compiler, f"-std={standard}", *flags, *WARNINGS, "-o", "/dev/null", "-c"]
    for folder in include_folders(house, name):
        command.append("-I" + folder)

    jobs = []  # (what, source text, optimisation)
    for header in public_headers(component):
        if header in plan["interop_headers"] and not can_include(
                command, plan["interop_headers"][header][0]):
            print(f"left out: {header}, its library is not installed")
            continue
        include = f"#include <{header}>\n"
        jobs.append((header, include + include, "-O0"))
    instantiate = pathlib.Path(component["folder"]) / "tests" / "instantiate.cpp"
    if instantiate.exists():
        text = instantiate.read_text(encoding="utf-8")
        command += [f"-I{instantiate.parent}"]
        jobs += [(instantiate.name, text, "-O0"), (instantiate.name, text, "-O2")]

    failed = 0
    for what, text, optimise in jobs:
        result = compiles(command + [optimise], text)
        if result.returncode != 0:
            failed += 1
            print(f"{what} with {compiler} -std={standard} {optimise}:\n{result.stderr}")
    print(f"{name}: {len(jobs)} compilations with {compiler} -std={standard}, {failed} failed")
    return 1 if failed or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())
