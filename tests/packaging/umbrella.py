#!/usr/bin/env python3
"""find_package(GSLAM): what it finds, and what it says when it does not.

usage: umbrella.py HOUSE_JSON SCENARIO

Versions are changed in copies of the checkout, so these tests hold whatever versions there are.
"""

import re

from project import (attempt, build_and_run, copy_checkout, expect, expect_configure_error,
                     expect_in, files_below, install, install_checkout, main, run, write_consumer)


def consumer(house, folder, find, targets=("GSLAM::base",), example="base"):
    write_consumer(folder / "app", find, targets, house.example(example))
    return folder / "app"


def all_installed(house, folder):
    """Without COMPONENTS: GSLAM::GSLAM is all that is installed."""
    run("cmake", "--install", house.build, "--prefix", folder / "prefix")
    checks = "\n".join(
        f"if(NOT GSLAM_{name}_FOUND OR NOT GSLAM_{name}_VERSION VERSION_EQUAL {c['version']})\n"
        f"  message(FATAL_ERROR \"{name}: ${{GSLAM_{name}_FOUND}} ${{GSLAM_{name}_VERSION}}\")\n"
        "endif()" for name, c in house.components.items())
    find = f"find_package(GSLAM {house.version} REQUIRED)\n{checks}"
    for name in house.components:
        app = folder / f"app_{name}"
        write_consumer(app, find, ["GSLAM::GSLAM"], house.example(name))
        build_and_run(app, folder / "prefix")


def components_are_disjoint(house, folder):
    """All components together are the whole installation, and no file belongs to two."""
    run("cmake", "--install", house.build, "--prefix", folder / "whole")
    owner = {}
    for name in ["cmake", *house.programs, *house.components]:
        install(house.build, folder / name, name)
        for path in files_below(folder / name):
            expect(path not in owner, f"{path} belongs to {owner.get(path)} and to {name}")
            owner[path] = name
    expect(set(owner) == files_below(folder / "whole"), "components and whole differ: "
           f"{sorted(set(owner) ^ files_below(folder / 'whole'))}")


def found_twice(house, folder):
    """Two calls with different components: GSLAM::GSLAM grows."""
    install(house.build, folder / "prefix", "cmake", "base", "messenger", "geometry")
    app = consumer(house, folder, "find_package(GSLAM COMPONENTS geometry REQUIRED)\n"
                   "find_package(GSLAM COMPONENTS messenger REQUIRED)",
                   ["GSLAM::GSLAM"], "messenger")
    build_and_run(app, folder / "prefix")


def optional(house, folder):
    """An optional component that is missing is said, and is no error."""
    install(house.build, folder / "prefix", "cmake", "base")
    app = consumer(house, folder, "find_package(GSLAM COMPONENTS base OPTIONAL_COMPONENTS teapot)\n"
                   "if(GSLAM_teapot_FOUND OR NOT GSLAM_FOUND)\n"
                   "  message(FATAL_ERROR \"wrong answer\")\nendif()")
    printed = build_and_run(app, folder / "prefix")
    expect_in(["teapot", "left out"], printed)


def missing(house, folder):
    """A missing component is named, with what is installed and where was looked."""
    install(house.build, folder / "prefix", "cmake", "base")
    version = house.components["base"]["version"]
    app = consumer(house, folder, "find_package(GSLAM COMPONENTS base messenger teapot REQUIRED)")
    expect_configure_error(app, [
        "component \"messenger\" is not installed", "libgslam-messenger-dev",
        "cmake --install BUILD --component messenger",
        "component \"teapot\" is not installed", "knows no component of that name",
        f"Installed beside this package: base {version}", f"Looked in: {folder / 'prefix'}",
    ], f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}")


def missing_dependency(house, folder):
    """A component whose dependency is missing says which, from both packages."""
    install(house.build, folder / "prefix", "cmake", "messenger")
    prefix = f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}"
    lists = (house.source / "libs" / "messenger" / "CMakeLists.txt").read_text("utf-8")
    least = re.search(r"DEPENDS base ([\d.]+)", lists).group(1)
    words = ["GSLAM_messenger", f"needs GSLAM_base {least}", "libgslam-base-dev"]
    for i, find in enumerate(["GSLAM COMPONENTS messenger", "GSLAM_messenger CONFIG"]):
        app = folder / f"app_{i}"
        write_consumer(app, f"find_package({find} REQUIRED)", ["GSLAM::messenger"],
                       house.example("messenger"))
        expect_configure_error(app, words, prefix)


def too_new(house, folder):
    """Asking for a version that is not there names both versions."""
    run("cmake", "--install", house.build, "--prefix", folder / "prefix")
    prefix = f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}"
    base = house.components["base"]["version"]
    for i, (find, found, wanted) in enumerate([("GSLAM 99.1", house.version, "99.1"),
                                               ("GSLAM_base 1.99 CONFIG", base, "1.99"),
                                               ("GSLAM_base 0.9 CONFIG", base, "0.9")]):
        app = folder / f"app_{i}"
        write_consumer(app, f"find_package({find} REQUIRED)", ["GSLAM::base"],
                       house.example("base"))
        expect_configure_error(app, [found, wanted], prefix)


def changed_checkout(house, folder, **versions):
    source = copy_checkout(house, folder)
    for name, version in versions.items():
        (source / "libs" / name / "VERSION").write_text(version + "\n", encoding="utf-8")
    return source


def component_outside_the_tested_set(house, folder):
    """The umbrella refuses a component that is older than it was tested with, or of another major."""
    tested = changed_checkout(house, folder / "tested", messenger="1.5.0")
    install_checkout(tested, folder / "umbrella", "cmake")
    for version in ("1.4.9", "2.0.0"):
        prefix = folder / version
        source = changed_checkout(house, folder / f"source-{version}", messenger=version)
        install_checkout(source, prefix, "base", "messenger")
        run("cp", "-r", f"{folder / 'umbrella'}/.", prefix)
        app = prefix / "app"
        write_consumer(app, "find_package(GSLAM COMPONENTS messenger REQUIRED)",
                       ["GSLAM::messenger"], house.example("messenger"))
        expect_configure_error(app, [f"found version {version}", "needs 1.5.0"],
                               f"-DCMAKE_PREFIX_PATH={prefix}")


def two_versions(house, folder):
    """Components have versions of their own and are used together."""
    source = changed_checkout(house, folder / "source", geometry="1.3.0", messenger="1.0.7")
    install_checkout(source, folder / "prefix", "cmake", "base", "geometry", "messenger")
    app = consumer(house, folder, "find_package(GSLAM COMPONENTS geometry messenger REQUIRED)\n"
                   "message(STATUS \"${GSLAM_geometry_VERSION} and ${GSLAM_messenger_VERSION}\")",
                   ["GSLAM::geometry", "GSLAM::messenger"], "messenger")
    expect_in(["1.3.0 and 1.0.7"], build_and_run(app, folder / "prefix"))


def old_dependency(house, folder):
    """A component finds only too old a version of what it needs: both versions are named."""
    source = changed_checkout(house, folder / "source", base="1.9.0")
    lists = source / "libs" / "messenger" / "CMakeLists.txt"
    text, count = re.subn(r"DEPENDS base [\d.]+", "DEPENDS base 1.9", lists.read_text("utf-8"))
    expect(count == 1, text)
    lists.write_text(text, encoding="utf-8")
    install_checkout(source, folder / "prefix", "cmake", "messenger")
    install_checkout(changed_checkout(house, folder / "old", base="1.8.0"), folder / "prefix",
                     "base")
    app = folder / "app"
    write_consumer(app, "find_package(GSLAM_messenger CONFIG REQUIRED)", ["GSLAM::messenger"],
                   house.example("messenger"))
    expect_configure_error(app, ["needs GSLAM_base 1.9", "found only 1.8.0"],
                           f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}")


def beside_itself_first(house, folder):
    """Of two install trees, the umbrella takes the components of its own."""
    for place, version in (("here", "1.0.1"), ("there", "1.0.2")):
        source = changed_checkout(house, folder / f"source-{place}", base=version)
        install_checkout(source, folder / place, "cmake", "base")
    app = consumer(house, folder, f"set(GSLAM_DIR {folder / 'here' / 'share/cmake/GSLAM'})\n"
                   "find_package(GSLAM COMPONENTS base REQUIRED)\n"
                   "message(STATUS \"took ${GSLAM_base_VERSION}\")")
    expect_in(["took 1.0.1"], build_and_run(app, folder / "there"))


def wrong_dependency_in_the_plan(house, folder):
    """A library that declares a room that it may not use does not configure."""
    source = changed_checkout(house, folder / "source")
    lists = source / "libs" / "svar" / "CMakeLists.txt"
    lists.write_text(lists.read_text(encoding="utf-8").replace(
        "DEPENDS base ", "DEPENDS messenger 1.0 base "), encoding="utf-8")
    result = attempt("cmake", "-S", source, "-B", source / "build", "-G", "Ninja")
    expect(result.returncode != 0, result.stdout)
    expect_in(["svar may not use messenger", "rooms.json"], result.stdout)


def expect_targets(house):
    """CMake's words for: all components are targets. To compile all of them takes too long here."""
    return "".join(f"if(NOT TARGET GSLAM::{name})\n  message(FATAL_ERROR \"no GSLAM::{name}\")\n"
                   "endif()\n" for name in house.components)


def whole_subdirectory(house, folder):
    """add_subdirectory() of everything: the targets, and nothing else in the user's project."""
    app = folder / "app"
    write_consumer(app, f"add_subdirectory(\"{house.source}\" gslam)\n{expect_targets(house)}",
                   [f"GSLAM::{name}" for name in house.quick()], house.example("messenger"))
    build_and_run(app, target="app")
    cache = (app / "build" / "CMakeCache.txt").read_text(encoding="utf-8")
    for word in ("\nCPACK_", "CMAKE_BUILD_TYPE:STRING=Release"):
        expect(word not in cache, f"{word} in the cache of the user's project")
    expect(not (app / "build" / "CPackConfig.cmake").exists(), "the user's project got our CPack")
    run("cmake", "--install", app / "build", "--prefix", folder / "prefix")
    expect(not (folder / "prefix").exists(), "the user's install rules install GSLAM")


def libraries_as_subdirectories(house, folder):
    """Several libraries added one by one, in any order, beside a libs/base of the user's own."""
    names = list(house.components)
    for i, order in enumerate((names, names[::-1])):
        app = folder / f"app_{i}"
        added = "\n".join(f"add_subdirectory(\"{house.components[name]['folder']}\" {name})"
                          for name in order)
        write_consumer(app, f"add_subdirectory(libs/base)\n{added}\n{expect_targets(house)}",
                       [f"GSLAM::{name}" for name in house.quick()], house.example("messenger"))
        (app / "libs" / "base").mkdir(parents=True)
        (app / "libs" / "base" / "CMakeLists.txt").write_text("add_custom_target(users_base)\n")
        build_and_run(app, target="app")


def scopes(house, folder):
    """A sub-directory that finds more than the directory above does not break the one above."""
    run("cmake", "--install", house.build, "--prefix", folder / "prefix")
    app = consumer(house, folder, "find_package(GSLAM COMPONENTS geometry REQUIRED)\n"
                   "add_subdirectory(inner)", ["GSLAM::GSLAM"], "geometry")
    write_consumer(app / "inner", "find_package(GSLAM COMPONENTS messenger REQUIRED)",
                   ["GSLAM::messenger"], house.example("messenger"))
    lists = app / "inner" / "CMakeLists.txt"
    lists.write_text(lists.read_text(encoding="utf-8").replace("(app", "(inner_app"),
                     encoding="utf-8")
    build_and_run(app, folder / "prefix")


def nothing_installed(house, folder):
    """The umbrella alone is no success."""
    install(house.build, folder / "prefix", "cmake")
    app = consumer(house, folder, "find_package(GSLAM REQUIRED)")
    expect_configure_error(app, ["no component is installed", "libgslam-messenger-dev"],
                           f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}")


def none_of_the_optional(house, folder):
    """GSLAM::GSLAM is there, and empty, where no optional component is."""
    install(house.build, folder / "prefix", "cmake")
    main_cpp = folder / "main.cpp"
    main_cpp.write_text("#include <cstdio>\nint main() { std::puts(\"empty\"); }\n")
    write_consumer(folder / "app", "find_package(GSLAM OPTIONAL_COMPONENTS messenger)",
                   ["GSLAM::GSLAM"], main_cpp)
    build_and_run(folder / "app", folder / "prefix")


def unknown_component(house, folder):
    """-DGSLAM_COMPONENTS with a typing error."""
    result = attempt("cmake", "-S", house.source, "-B", folder / "build", "-G", "Ninja",
                     "-DGSLAM_COMPONENTS=mesenger")
    expect(result.returncode != 0, result.stdout)
    expect_in(["there is no libs/mesenger", "messenger"], result.stdout)


if __name__ == "__main__":
    main({f.__name__: f for f in (
        all_installed, components_are_disjoint, found_twice, optional, missing, missing_dependency,
        too_new, component_outside_the_tested_set, two_versions, old_dependency,
        beside_itself_first, wrong_dependency_in_the_plan, whole_subdirectory,
        libraries_as_subdirectories, scopes, nothing_installed, none_of_the_optional,
        unknown_component)})
