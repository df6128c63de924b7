#!/usr/bin/env python3
"""One component as its user gets it: installed, moved, packaged, or as a folder of sources.

usage: component.py HOUSE_JSON SCENARIO COMPONENT
"""

import os
import re

from project import (build_and_run, expect, expect_in, files_below, install,
                     install_with_dependencies, main, run, write_consumer)


def write_umbrella_consumer(house, folder, name):
    write_consumer(folder, f"find_package(GSLAM COMPONENTS {name} REQUIRED)\n"
                   f"message(STATUS \"found {name} ${{GSLAM_{name}_FOUND}} "
                   f"${{GSLAM_{name}_VERSION}}\")",
                   [f"GSLAM::{name}"], house.example(name))


def umbrella(house, folder, name):
    """find_package(GSLAM COMPONENTS x), with nothing else installed."""
    install_with_dependencies(house, name, folder / "prefix")
    write_umbrella_consumer(house, folder / "app", name)
    printed = build_and_run(folder / "app", folder / "prefix")
    version = house.components[name]["version"]
    expect(re.search(f"found {name} (1|TRUE) {version}", printed), printed)


def package(house, folder, name):
    """find_package(GSLAM_x CONFIG), pinned to the version, without the umbrella."""
    install(house.build, folder / "prefix", *house.closure(name))
    version = ".".join(house.components[name]["version"].split(".")[:2])
    write_consumer(folder / "app", f"find_package(GSLAM_{name} {version} CONFIG REQUIRED)",
                   [f"GSLAM::{name}"], house.example(name))
    build_and_run(folder / "app", folder / "prefix")


def moved(house, folder, name):
    """An install tree that was moved still works, and names its old place nowhere."""
    install_with_dependencies(house, name, folder / "prefix")
    (folder / "prefix").rename(folder / "elsewhere")
    write_umbrella_consumer(house, folder / "app", name)
    build_and_run(folder / "app", folder / "elsewhere")
    for path in files_below(folder / "elsewhere"):
        text = (folder / "elsewhere" / path).read_bytes()
        for place in (folder / "prefix", house.source):
            # A debugger's view of a compiled file names its sources; texts must not.
            expect(path.endswith((".a", ".so")) or ".so." in path
                   or str(place).encode() + b"/" not in text, f"{path} names {place}")


def pkgconfig(house, folder, name):
    """A user without CMake: compiler and pkg-config, from a moved tree."""
    install(house.build, folder / "prefix", *house.closure(name))
    (folder / "prefix").rename(folder / "elsewhere")
    paths = [str(folder / "elsewhere" / data / "pkgconfig") for data in ("share", "lib")]
    env = {"PKG_CONFIG_PATH": ":".join(paths)}
    module = f"gslam_{name}"
    version = run("pkg-config", "--modversion", module, env=env).strip()
    expect(version == house.components[name]["version"], f"{module} says version {version}")
    flags = run("pkg-config", "--static", "--cflags", "--libs", module, env=env).split()
    standard = house.components[name]["standard"]
    run(os.environ.get("CXX", "c++"), f"-std=c++{standard}", house.example(name),
        "-o", folder / "app", *flags)
    run(folder / "app", env={"LD_LIBRARY_PATH": str(folder / "elsewhere" / "lib")})


def subdirectory(house, folder, name):
    """add_subdirectory() of the library's folder: only its target, none of its tests."""
    source = house.components[name]["folder"]
    write_consumer(folder / "app", f"add_subdirectory({source} gslam)", [f"GSLAM::{name}"],
                   house.example(name))
    build_and_run(folder / "app")
    tests = list((folder / "app" / "build").rglob("*_test"))
    expect(not tests, f"the consumer built tests of GSLAM: {tests}")
    run("cmake", "--install", folder / "app" / "build", "--prefix", folder / "prefix")
    expect(not (folder / "prefix").exists(), "the consumer's install rules install GSLAM")


def exact(house, folder, name):
    """--component x installs exactly x; nothing exported carries compiler flags of ours."""
    install(house.build, folder / "one", name)
    for path in sorted(files_below(folder / "one")):
        mine = re.search(rf"(gslam/{name}(\.h$|/)|GSLAM_{name}/|gslam_{name}\.pc$|libgslam_{name}\."
                         rf"|lib/gslam/.*/gslam_{name}_[a-z]+/"
                         rf"|doc/libgslam-{name.replace('_', '-')}-dev/copyright$)", path)
        expect(mine, f"component {name} installs {path}")
    exported = "".join((folder / "one" / path).read_text(encoding="utf-8")
                       for path in files_below(folder / "one") if "Targets" in path)
    expect(exported, f"component {name} exports no target")
    expect(not re.search(r"-march|-ffast-math|-W[a-z]|-fsanitize", exported),
           f"flags in what {name} exports:\n{exported}")


def deb(house, folder, name):
    """The .debs of x and of what they say they depend on, unpacked into an empty root."""
    debs = {run("dpkg-deb", "-f", path, "Package").strip(): path
            for path in house.build.glob("packages/*.deb")}
    wanted, unpacked = ["libgslam-" + name.replace("_", "-") + "-dev"], set()
    while wanted:
        current = wanted.pop()
        if current in unpacked:
            continue
        unpacked.add(current)
        expect(current in debs, f"{current} is needed, but only {sorted(debs)} were made")
        run("dpkg-deb", "-x", debs[current], folder / "root")
        depends = run("dpkg-deb", "-f", debs[current], "Depends")
        wanted += re.findall(r"libgslam-[a-z0-9-]+", depends)
        if current != "libgslam-cmake-dev":
            expect_in(["libgslam-cmake-dev"], depends)
    own = debs["libgslam-" + name.replace("_", "-") + "-dev"]
    version = run("dpkg-deb", "-f", own, "Version").strip()
    expect(version == house.components[name]["version"], f"{own.name} has version {version}")
    expect_in([f"GSLAM {name}: {house.components[name]['summary']}"],
              run("dpkg-deb", "-f", own, "Description"))
    expect_in(["copyright"], run("dpkg-deb", "-c", own))
    write_umbrella_consumer(house, folder / "app", name)
    build_and_run(folder / "app", folder / "root" / "usr")


def alone(house, folder, name, *options):
    """Configured, built, tested and installed from its own folder, then used from there."""
    source = house.components[name]["folder"]
    build = folder / "build"
    run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *options)
    run("cmake", "--build", build)
    printed = run("ctest", "--test-dir", build, "--output-on-failure", "--no-tests=error")
    expect_in(["100% tests passed"], printed)
    install(build, folder / "prefix", "cmake", *house.closure(name))
    write_umbrella_consumer(house, folder / "app", name)
    build_and_run(folder / "app", folder / "prefix")


def alone_shared(house, folder, name):
    alone(house, folder, name, "-DBUILD_SHARED_LIBS=ON")


if __name__ == "__main__":
    main({f.__name__: f for f in (umbrella, package, moved, pkgconfig, subdirectory, exact, deb,
                                  alone, alone_shared)})
