#!/usr/bin/env python3
"""Compiles every public header of a component alone, under all warnings.

usage: compile_headers.py HOUSE_JSON COMPONENT COMPILER STANDARD [FLAG ...]

Each header is read twice-included and by itself; tests/instantiate.cpp, which
instantiates the templates and kernels, at -O0 and -O2. Where nothing but headers is needed it is
linked at -O0, too: before C++17 a constant of a class has no address unless it is defined, which
optimisation hides. Opt-in headers (interop_headers of
cmake/rooms.json) see what pkg-config says of interop_packages, and are left out where their library
is not installed or does not compile under this standard itself.
"""

import json
import pathlib
import re
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


def foreign_folders(packages):
    """Where the libraries of opt-in headers are, but for what the compiler searches anyway."""
    for package in packages:
        result = subprocess.run(["pkg-config", "--cflags-only-I", package], text=True,
                                capture_output=True, check=False)
        for flag in result.stdout.split():
            if flag != "-I/usr/include":
                yield flag[2:]


def library_is_usable(command, header, prefixes):
    """Whether what an opt-in header includes of its library compiles without it."""
    text = header.read_text(encoding="utf-8")
    foreign = [name for name in re.findall(r"^#include <(.*)>", text, re.MULTILINE)
               if any(name.startswith(prefix) for prefix in prefixes)]
    alone = "".join(f"#include <{name}>\n" for name in foreign)
    return compiles(command + ["-fsyntax-only"], alone).returncode == 0


def compiles(command, text):
    return subprocess.run(command + ["-x", "c++", "-"], input=text, text=True,
                          capture_output=True, check=False)


def needs_only_headers(house, name):
    component = next(c for c in house["components"] if c["name"] == name)
    return component["kind"] == "headers" and all(
        needs_only_headers(house, dependency) for dependency in component["depends"])


def main():
    house_path, name, compiler, standard, *flags = sys.argv[1:]
    house = json.loads(pathlib.Path(house_path).read_text(encoding="utf-8"))
    plan = json.loads((pathlib.Path(house["source"]) / "cmake/rooms.json").read_text("utf-8"))
    component = next(c for c in house["components"] if c["name"] == name)
    command = [compiler, f"-std={standard}", *flags, *WARNINGS, "-o", "/dev/null"]
    for folder in include_folders(house, name):
        command.append("-I" + folder)
    for folder in foreign_folders(plan["interop_packages"]):
        command += ["-isystem", folder]

    jobs = []  # (what, source text, flags)
    for header in public_headers(component):
        prefixes = plan["interop_headers"].get(header)
        path = pathlib.Path(component["folder"]) / "include" / header
        if prefixes and not library_is_usable(command, path, prefixes):
            print(f"left out: {header}, whose library is not installed or not for {standard}")
            continue
        include = f"#include <{header}>\n"
        jobs.append((header, include + include, ["-fsyntax-only"]))
    instantiate = pathlib.Path(component["folder"]) / "tests" / "instantiate.cpp"
    if instantiate.exists():
        text = instantiate.read_text(encoding="utf-8")
        command += [f"-I{instantiate.parent}"]
        jobs.append((instantiate.name, text, ["-c", "-O2"]))
        if needs_only_headers(house, name):
            jobs.append((instantiate.name, text + "int main() {}\n", ["-O0", "-pthread"]))
        else:
            jobs.append((instantiate.name, text, ["-c", "-O0"]))

    failed = 0
    for what, text, how in jobs:
        result = compiles(command + how, text)
        if result.returncode != 0:
            failed += 1
            print(f"{what} with {compiler} -std={standard} {' '.join(how)}:\n{result.stderr}")
    print(f"{name}: {len(jobs)} compilations with {compiler} -std={standard}, {failed} failed")
    return 1 if failed or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())
