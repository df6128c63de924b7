"""What the packaging tests share: running commands, installing components, consumer projects."""

import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

# Names of the folders of a checkout that a build of it needs.
CHECKOUT = ["CMakeLists.txt", "VERSION", "LICENSE", "cmake", "libs"]


class Failed(Exception):
    """A test did not see what it expected."""


def expect(condition, message):
    if not condition:
        raise Failed(message)


def expect_in(words, text):
    """All of the words occur in the text; line breaks, where CMake wrapped it, do not matter."""
    flat = " ".join(text.split())
    for word in words:
        expect(" ".join(word.split()) in flat, f"expected \"{word}\" in:\n{text}")


def run(*command, cwd=None, env=None):
    """Runs a command that must succeed; returns what it prints."""
    result = attempt(*command, cwd=cwd, env=env)
    expect(result.returncode == 0,
           f"{' '.join(map(str, command))}\nended with {result.returncode}:\n{result.stdout}")
    return result.stdout


def attempt(*command, cwd=None, env=None):
    return subprocess.run([str(word) for word in command], cwd=cwd, text=True, check=False,
                          env={**os.environ, **(env or {})}, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)


class House:
    """The components of a configured build, from its house.json."""

    def __init__(self, path):
        facts = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        self.source = pathlib.Path(facts["source"])
        self.build = pathlib.Path(facts["build"])
        self.version = facts["version"]
        self.programs = facts["programs"]
        self.components = {c["name"]: c for c in facts["components"]}

    def closure(self, name):
        """The component and all it depends on, dependencies first."""
        names = []
        for dependency in self.components[name]["depends"]:
            names += [n for n in self.closure(dependency) if n not in names]
        return names + [name]

    def quick(self):
        """Those that a test can compile: headers, and one of the others."""
        return [name for name, component in self.components.items()
                if component["kind"] == "headers" or name == "svar_formats"]

    def example(self, name):
        return pathlib.Path(self.components[name]["folder"]) / "examples" / "quickstart.cpp"


@contextlib.contextmanager
def scratch():
    """A folder that is gone afterwards."""
    with tempfile.TemporaryDirectory(prefix="gslam-packaging-") as folder:
        yield pathlib.Path(folder)


def install(build, prefix, *components):
    for component in components:
        run("cmake", "--install", build, "--prefix", prefix, "--component", component)


def install_with_dependencies(house, name, prefix):
    install(house.build, prefix, "cmake", *house.closure(name))


def files_below(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def write_consumer(folder, find, targets, source):
    """A project of ten lines, as a new user would write it."""
    folder.mkdir(parents=True)
    shutil.copy(source, folder / "main.cpp")
    (folder / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.19)\n"
        "project(consumer LANGUAGES CXX)\n"
        f"{find}\n"
        "add_executable(app main.cpp)\n"
        f"target_link_libraries(app PRIVATE {' '.join(targets)})\n"
        # An installed component must not depend on what this very build has set.
        "set_target_properties(app PROPERTIES CXX_EXTENSIONS OFF)\n", encoding="utf-8")


def configure(source, build, *options):
    return attempt("cmake", "-S", source, "-B", build, "-G", "Ninja",
                   "-DCMAKE_EXPORT_NO_PACKAGE_REGISTRY=ON", "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF",
                   *options)


def build_and_run(folder, prefix=None, *options, target="all"):
    """Configures, builds and runs a consumer; its program must print something."""
    options = list(options) + ([f"-DCMAKE_PREFIX_PATH={prefix}"] if prefix else [])
    result = configure(folder, folder / "build", *options)
    expect(result.returncode == 0, result.stdout)
    run("cmake", "--build", folder / "build", "--target", target)
    printed = run(folder / "build" / "app")
    expect(printed.strip(), "the program printed nothing")
    return result.stdout + printed


def expect_configure_error(folder, words, *options):
    """Configuring the consumer must fail with a message that has these words."""
    result = configure(folder, folder / "build", *options)
    expect(result.returncode != 0, f"configuring succeeded, expected an error:\n{result.stdout}")
    expect_in(words, result.stdout)


def copy_checkout(house, folder):
    """A copy of the sources, to be changed by a test."""
    folder.mkdir(parents=True)
    for name in CHECKOUT:
        source = house.source / name
        if source.is_dir():
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("build", ".*"))
        else:
            shutil.copy(source, folder / name)
    return folder


def install_checkout(source, prefix, *components, options=()):
    """Installs components of a (changed) checkout, without its tests; all of them if none given."""
    build = source / "build"
    libraries = [name for name in components if name != "cmake"] or ["base"]
    if components:  # compiled libraries that nobody asked for would take minutes
        options = [f"-DGSLAM_COMPONENTS={';'.join(libraries)}", *options]
    run("cmake", "-S", source, "-B", build, "-G", "Ninja", "-DGSLAM_BUILD_TESTS=OFF",
        "-DGSLAM_BUILD_EXAMPLES=OFF", *options)
    run("cmake", "--build", build)
    if components:
        install(build, prefix, *components)
    else:
        run("cmake", "--install", build, "--prefix", prefix)


def main(scenarios):
    """Runs `script HOUSE_JSON SCENARIO [COMPONENT]`, or lists the scenarios."""
    if len(sys.argv) < 3 or sys.argv[2] not in scenarios:
        sys.exit(f"usage: {sys.argv[0]} HOUSE_JSON {'|'.join(scenarios)} [COMPONENT]")
    house = House(sys.argv[1])
    with scratch() as folder:
        try:
            scenarios[sys.argv[2]](house, folder, *sys.argv[3:])
        except Failed as failure:
            sys.exit(f"FAILED {' '.join(sys.argv[2:])}: {failure}")
    print(f"{' '.join(sys.argv[2:])}: as expected")
