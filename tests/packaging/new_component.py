#!/usr/bin/env python3
"""What CONTRIBUTING.md says of a new library: copy a folder with three short files.

usage: new_component.py HOUSE_JSON SCENARIO

three_files makes the files that CONTRIBUTING.md shows. The others copy new_component/, which is a
compiled library with tests and an example. Nothing else in the copy of the checkout is edited.
"""

import re
import shutil

from project import (build_and_run, copy_checkout, expect, expect_in, files_below, install,
                     install_checkout, main, run, write_consumer)

NAME = "odometer"


def add_to_copy(house, folder):
    source = copy_checkout(house, folder / "source")
    template = house.source / "tests" / "packaging" / "new_component"
    shutil.copytree(template, source / "libs" / NAME)
    return source


def use(house, folder, *options):
    source = add_to_copy(house, folder)
    build = folder / "build"
    run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DGSLAM_BUILD_TESTS=OFF",
        f"-DGSLAM_COMPONENTS={NAME}", *options)
    run("cmake", "--build", build)
    install(build, folder / "prefix", "cmake", "base", "geometry", NAME)
    (folder / "prefix").rename(folder / "elsewhere")
    write_consumer(folder / "app", f"find_package(GSLAM COMPONENTS {NAME} REQUIRED)",
                   [f"GSLAM::{NAME}"], source / "libs" / NAME / "examples" / "quickstart.cpp")
    expect_in(["5 m"], build_and_run(folder / "app", folder / "elsewhere"))
    return source, build


def three_files(house, folder):
    """The text of CONTRIBUTING.md, tried: its three files are a library."""
    text = (house.source / "CONTRIBUTING.md").read_text(encoding="utf-8")
    files = re.findall(r"`(libs/pedometer/[^`]+)`:\n\n```[a-z+]*\n(.*?)^```", text, re.M | re.S)
    expect(len(files) == 3, f"CONTRIBUTING.md shows {len(files)} files")
    source = copy_checkout(house, folder / "source")
    for path, content in files:
        (source / path).parent.mkdir(parents=True, exist_ok=True)
        (source / path).write_text(content, encoding="utf-8")
    install_checkout(source, folder / "prefix", "cmake", "base", "pedometer")
    main_cpp = folder / "main.cpp"
    main_cpp.write_text("#include <cstdio>\n#include <gslam/pedometer.h>\nint main() {\n"
                        "  double steps[] = {0.7, 0.02, 0.6};\n"
                        "  std::printf(\"%d steps\\n\", gslam::countSteps(steps));\n}\n")
    write_consumer(folder / "app", "find_package(GSLAM COMPONENTS pedometer REQUIRED)",
                   ["GSLAM::pedometer"], main_cpp)
    expect_in(["2 steps"], build_and_run(folder / "app", folder / "prefix"))
    facts = source / "build" / "house.json"
    headers_of = house.source / "tests" / "headers"
    expect_in(["0 arrows"], run("python3", headers_of / "check_rooms.py", facts))
    run("python3", headers_of / "compile_headers.py", facts, "pedometer", "c++", "c++11")


def static(house, folder):
    """As a static library; with its .deb."""
    _, build = use(house, folder, "-DBUILD_SHARED_LIBS=OFF")
    expect("lib/libgslam_odometer.a" in files_below(folder / "elsewhere"), "no static library")
    run("cpack", "-G", "DEB", "-B", folder / "packages", cwd=build)
    deb = next((folder / "packages").glob("libgslam-odometer-dev_1.0.0_*.deb"))
    expect_in(["libgslam-cmake-dev", "libgslam-geometry-dev (>= 1.0)"],
              run("dpkg-deb", "-f", deb, "Depends"))


def add_second(source):
    """A compiled library on top of the first: `tachometer` uses `odometer`."""
    library = source / "libs" / "tachometer"
    shutil.copytree(source / "libs" / NAME, library)
    for path in [p for p in library.rglob("*") if p.is_file()]:
        text = path.read_text(encoding="utf-8")
        for word in (NAME, NAME.title(), NAME.upper()):
            new = {"o": "tachometer", "O": "Tachometer"}[word[0]]
            text = text.replace(word, new.upper() if word.isupper() else new)
        text = text.replace("DEPENDS geometry 1.0", f"DEPENDS geometry 1.0 {NAME} 1.0")
        text = text.replace("hiddenHelper", "otherHelper")
        path.write_text(text, encoding="utf-8")
        path.rename(path.with_name(path.name.replace(NAME, "tachometer")))
    code = library / "src" / "tachometer.cpp"
    code.write_text("#include <gslam/odometer.h>\n" + code.read_text(encoding="utf-8").replace(
        "  last_ = position;", "  Odometer().add(position);\n  last_ = position;"), encoding="utf-8")


def build_two_shared(house, folder):
    source = add_to_copy(house, folder)
    add_second(source)
    build = folder / "build"
    run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DGSLAM_BUILD_TESTS=OFF",
        "-DGSLAM_COMPONENTS=tachometer", "-DBUILD_SHARED_LIBS=ON")
    run("cmake", "--build", build)
    return source, build


def shared_debs(house, folder):
    """One shared library on another: they find each other when moved, and become packages."""
    source, build = build_two_shared(house, folder)
    run("cmake", "--install", build, "--prefix", folder / "prefix")
    (folder / "prefix").rename(folder / "elsewhere")
    write_consumer(folder / "app", "find_package(GSLAM COMPONENTS tachometer REQUIRED)",
                   ["GSLAM::tachometer"],
                   source / "libs" / "tachometer" / "examples" / "quickstart.cpp")
    expect_in(["5 m"], build_and_run(folder / "app", folder / "elsewhere"))
    run("cpack", "-G", "DEB", "-B", folder / "packages", cwd=build)
    deb = next((folder / "packages").glob("libgslam-tachometer-dev_1.0.0_*.deb"))
    expect_in(["libgslam-odometer-dev (>= 1.0)", "libc6"], run("dpkg-deb", "-f", deb, "Depends"))


def shared(house, folder):
    """As a shared library: soname, and only what is marked is visible."""
    use(house, folder, "-DBUILD_SHARED_LIBS=ON")
    library = folder / "elsewhere" / "lib" / "libgslam_odometer.so.1.0.0"
    expect_in(["libgslam_odometer.so.1"], run("objdump", "-p", library))
    symbols = run("nm", "-DC", "--defined-only", library)
    expect_in(["gslam::v1::Odometer::add"], symbols)
    expect("hiddenHelper" not in symbols, symbols)


def headers(house, folder):
    """The checks of every header and of the plan take it up without being told."""
    source = add_to_copy(house, folder)
    build = folder / "build"
    shutil.copytree(house.source / "tests", source / "tests")
    run("cmake", "-S", source, "-B", build, "-G", "Ninja", f"-DGSLAM_COMPONENTS={NAME}",
        "-DGSLAM_BUILD_TESTS=OFF")
    facts = build / "house.json"
    scripts = source / "tests" / "headers"
    expect_in(["0 arrows"], run("python3", scripts / "check_rooms.py", facts))
    expect_in([f"{NAME}: 3 compilations"],
              run("python3", scripts / "compile_headers.py", facts, NAME, "c++", "c++11"))


def alone(house, folder):
    """Built and tested from its own folder."""
    source = add_to_copy(house, folder)
    build = folder / "build"
    run("cmake", "-S", source / "libs" / NAME, "-B", build, "-G", "Ninja")
    run("cmake", "--build", build)
    expect_in(["100% tests passed, 0 tests failed out of 2"],
              run("ctest", "--test-dir", build, "--no-tests=error"))


if __name__ == "__main__":
    main({f.__name__: f for f in (three_files, static, shared, shared_debs, headers, alone)})
