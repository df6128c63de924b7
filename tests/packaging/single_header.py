#!/usr/bin/env python3
"""The examples of a library compile, link and run with its single header alone.

usage: single_header.py HOUSE_JSON COMPONENT COMPILER STANDARD

A program of two files that both include it is linked, too.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

FLAGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-pthread"]


def run(command):
    done = subprocess.run(command, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")


def main():
    house_path, name, compiler, standard = sys.argv[1:]
    house = json.loads(pathlib.Path(house_path).read_text(encoding="utf-8"))
    component = next(c for c in house["components"] if c["name"] == name)
    script = pathlib.Path(house["source"]) / "cmake/amalgamate.py"
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        header = work / f"gslam_{name}.h"
        run([sys.executable, "-B", script, house_path, name, header])
        if re.search(r"#include *[<\"]gslam", header.read_text(encoding="utf-8")):
            sys.exit(f"{header.name} still includes headers of gslam/")
        (work / "other.cpp").write_text(f'#include "{header.name}"\n', encoding="utf-8")
        compile_it = [compiler, f"-std={standard}", *FLAGS]
        run([*compile_it, "-c", work / "other.cpp", "-o", work / "other.o"])
        examples = sorted(pathlib.Path(component["folder"]).glob("examples/*.cpp"))
        for example in examples:
            text = re.sub(r"#include <gslam/.*>", f'#include "{header.name}"',
                          example.read_text(encoding="utf-8"))
            source = work / example.name
            source.write_text(text, encoding="utf-8")
            program = work / example.stem
            run([*compile_it, source, work / "other.o", "-o", program])
            run([program])
    print(f"{len(examples)} examples run with gslam_{name}.h")


if __name__ == "__main__":
    main()
