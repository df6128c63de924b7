#!/usr/bin/env python3
"""A program as its user gets it: installed and moved, or as a Debian package.

usage: program.py HOUSE_JSON SCENARIO PROGRAM
"""

from project import expect_in, install, main, run


def check(folder, name):
    """It runs, and finds the plugins that came with it."""
    printed = run(folder / "bin" / name, "plugins", env={"GSLAM_PLUGIN_PATH": ""})
    expect_in(["example 1.", "dead_reckoning"], printed)
    expect_in(["poses: 201 of 201 frames"],
              run(folder / "bin" / name, "play", "-d", "carousel", "-s", "dead_reckoning",
                  "--isolate", env={"GSLAM_PLUGIN_PATH": ""}))


def moved(house, folder, name):
    """An install tree of the program alone, moved."""
    install(house.build, folder / "prefix", name)
    (folder / "prefix").rename(folder / "elsewhere")
    check(folder / "elsewhere", name)


def deb(house, folder, name):
    """Its .deb, unpacked into an empty root."""
    debs = {run("dpkg-deb", "-f", path, "Package").strip(): path
            for path in house.build.glob("packages/*.deb")}
    expect_in([name], " ".join(debs))
    run("dpkg-deb", "-x", debs[name], folder / "root")
    expect_in([house.version], run("dpkg-deb", "-f", debs[name], "Version"))
    expect_in(["copyright"], run("dpkg-deb", "-c", debs[name]))
    check(folder / "root" / "usr", name)


if __name__ == "__main__":
    main({f.__name__: f for f in (moved, deb)})
