#!/usr/bin/env python3
"""Checks the include graph against the plan of the house, cmake/rooms.json.

usage: check_rooms.py HOUSE_JSON

* The plan itself: a room may use only rooms on lower floors, so there is no circle.
* Files of a library include only their own headers and those of its declared dependencies, and the
  plan allows each of these. A library that the plan does not have may use what it declares.
* Files of plugins/, apps/, bindings/ ... include only rooms on lower floors.
* Public headers of a library include nothing else but the standard library; what is allowed beside
  that is listed in the plan (processor_headers, system_headers, and interop_headers, which no other
  header may include).
* Below include/ a library has gslam/<its name>.h and gslam/<its name>/ with headers (*.h), only.
* What is included is written down: no macro names it.

HOUSE_JSON lists the components that were configured (the build writes it).
"""

import json
import pathlib
import re
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*(?:include|include_next|import)\b[ \t]*(.*)$', re.MULTILINE)
NAMED = re.compile(r'<([^>]+)>|"([^"]+)"')
# A string or a comment: the string stays, so that what looks like a comment in it does.
TEXT_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|/\*.*?\*/|//[^\n]*', re.DOTALL)
NO_SOURCES = {".md", ".txt", ".json", ".cmake", ".in", ".py", ".png", ".svg", ""}

STANDARD = set("""
algorithm any array atomic barrier bit bitset cassert ccomplex cctype cerrno cfenv cfloat charconv
chrono cinttypes ciso646 climits clocale cmath codecvt compare complex concepts condition_variable
coroutine csetjmp csignal cstdalign cstdarg cstdbool cstddef cstdint cstdio cstdlib cstring ctgmath
ctime cuchar cwchar cwctype deque exception execution filesystem format forward_list fstream
functional future initializer_list iomanip ios iosfwd iostream istream iterator latch limits list
locale map memory memory_resource mutex new numbers numeric optional ostream queue random ranges
ratio regex scoped_allocator semaphore set shared_mutex source_location span sstream stack stdexcept
stop_token streambuf string string_view strstream syncstream system_error thread tuple type_traits
typeindex typeinfo unordered_map unordered_set utility valarray variant vector version
""".split())


def includes_of(path):
    """What a file includes; a quoted path that leads to a file beside it is resolved to
    gslam/... where it is a public header of any library."""
    text = path.read_text(encoding="utf-8").replace("\\\n", " ")
    text = TEXT_OR_COMMENT.sub(lambda m: m[0] if m[0][0] == '"' else " ", text)
    for what in INCLUDE.findall(text):
        named = NAMED.match(what.strip())
        if not named:
            yield COMPUTED
        elif named[1]:
            yield named[1]
        else:
            beside = (path.parent / named[2]).resolve()
            public = re.search(r"/include/(gslam/.*)$", beside.as_posix())
            yield public[1] if beside.exists() and public else named[2]


COMPUTED = "what a macro names"


def sources_below(folder):
    return sorted(path for path in folder.rglob("*")
                  if path.is_file() and path.suffix not in NO_SOURCES and "corpus" not in path.parts)


def room_of_include(include):
    """The library that owns a header: gslam/<room>.h or gslam/<room>/... ; None for others."""
    match = re.match(r"gslam/([A-Za-z0-9_]+)(?:\.|/)", include)
    return match.group(1) if match else None


def check_plan(plan):
    floors = {room["name"]: room["floor"] for room in plan["rooms"]}
    for room in plan["rooms"]:
        for other in room["may_use"]:
            if other == "*":
                continue
            if other not in floors:
                yield f"rooms.json: {room['name']} may use {other}, which is no room"
            elif floors[other] >= room["floor"]:
                yield (f"rooms.json: {room['name']} (floor {room['floor']}) may use {other} "
                       f"(floor {floors[other]}): an arrow must lead to a lower floor")


def allowed_rooms(component, plan):
    """Rooms that a library may include, and complaints about what it declares."""
    declared = set(component["depends"])
    planned = next((r for r in plan["rooms"] if r["name"] == component["name"]), None)
    wrong = sorted(declared - set(planned["may_use"])) if planned else []
    complaints = [f"libs/{component['name']} depends on {other}, which rooms.json does not allow"
                  for other in wrong]
    return declared | {component["name"]}, complaints


def check_public_include(header, include, plan):
    """Complains about an include of a public header that is no GSLAM header."""
    if include in STANDARD or include in plan["processor_headers"]:
        return None
    if include in plan["system_headers"].get(header, []):
        return None
    if any(include.startswith(prefix) for prefix in plan["interop_headers"].get(header, [])):
        return None
    return f"includes <{include}>, which is neither of the standard library nor of GSLAM"


def check_library(component, plan, nested_folders):
    allowed, complaints = allowed_rooms(component, plan)
    yield from complaints
    folder = pathlib.Path(component["folder"])
    public = folder / "include"
    for path in sources_below(folder):
        if any(nested in path.parents for nested in nested_folders - {folder}):
            continue  # belongs to a package of its own
        header = path.relative_to(public).as_posix() if public in path.parents else None
        if header and not re.fullmatch(rf"gslam/{component['name']}(/.+)?\.h", header):
            yield f"{path}: not a header gslam/{component['name']}.h or gslam/{component['name']}/*.h"
        for include in includes_of(path):
            room = room_of_include(include)
            if include == COMPUTED:
                yield f"{path}: includes {COMPUTED}, which cannot be checked"
            elif room is not None and room not in allowed:
                yield (f"{path}: includes <{include}>, but {component['name']} does not declare "
                       f"{room} in its DEPENDS")
            elif include in plan["interop_headers"] and header is not None:
                yield f"{path}: includes <{include}>, an opt-in header that only users include"
            elif room is None and header is not None:
                problem = check_public_include(header, include, plan)
                if problem:
                    yield f"{path}: {problem}"


def check_upper_room(root, room, plan):
    floors = {r["name"]: r["floor"] for r in plan["rooms"]}
    for path in sources_below(root / room["path"]):
        for include in includes_of(path):
            owner = room_of_include(include)
            if owner in floors and floors[owner] >= room["floor"]:
                yield f"{path}: includes <{include}> from a room that is not below {room['name']}"


def check(house, plan):
    yield from check_plan(plan)
    root = pathlib.Path(house["source"])
    folders = {pathlib.Path(component["folder"]) for component in house["components"]}
    for component in house["components"]:
        yield from check_library(component, plan, folders)
    for room in plan["rooms"]:
        if not room["path"].startswith("libs/"):
            yield from check_upper_room(root, room, plan)


def main():
    house = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    plan_path = pathlib.Path(house["source"]) / "cmake" / "rooms.json"
    complaints = list(check(house, json.loads(plan_path.read_text(encoding="utf-8"))))
    for complaint in complaints:
        print(complaint)
    print(f"{len(house['components'])} components, {len(complaints)} arrows that must not be")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
