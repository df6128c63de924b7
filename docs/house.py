#!/usr/bin/env python3
"""Draw the house of the architecture: house.py rooms.json OUT.svg

rooms.json holds "floors" (names, lowest first) and "rooms" (name, path, floor, may_use). A room may use rooms on lower
floors only; ["*"] stands for all of them. Each floor becomes a band, each room a box, each may_use an arrow down; for
"*" a note stands in the box. An arrow that others already imply (datasets > core > base) is drawn faint.
A room is drawn solid when its path is a folder of the repository (the parent of the folder of rooms.json), otherwise
as planned. Exit status: 0 drawn, 2 bad input, with one sentence on stderr.
"""
import json
import sys
from pathlib import Path
from xml.sax.saxutils import escape

ANYTHING = ["*"]
BOX_HEIGHT, BAND_HEIGHT, ROOF_HEIGHT, BAND_LABEL = 58, 122, 96, 96
MARGIN, SLOT, LANE = 60, 196, 9
INK, FAINT, PAPER = "#1f2933", "#66727f", "#fbfaf7"
ACCENTS = ("#7a5c3e", "#2f6f8f", "#3d7d4f", "#8a5a9e", "#b0542f", "#4a5a78")
TINTS = ("#e9e0d3", "#e3eef3", "#e6f1e8", "#f1e9f4", "#f8eae3", "#e9edf4")


class HouseError(Exception):
    """Bad input; the message is one sentence for the user."""


def read_rooms(path):
    """The checked content of rooms.json: (floor names, rooms)."""
    try:
        document = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise HouseError(f"{path}: is no readable, complete JSON: {getattr(error, 'strerror', error)}") from None
    keys = {"floors": list, "rooms": list}
    if not isinstance(document, dict) or not all(isinstance(document.get(key), keys[key]) for key in keys):
        raise HouseError(f'{path}: must be an object with the lists "floors" and "rooms"')
    floors, rooms = document["floors"], document["rooms"]
    if not rooms or not floors or not all(isinstance(floor, str) and floor.isprintable() for floor in floors):
        raise HouseError(f'{path}: needs at least one room, and "floors" must be names')
    for room in rooms:
        check_room(path, room, len(floors))
    by_name = {room["name"]: room for room in rooms}
    if len(by_name) < len(rooms):
        raise HouseError(f"{path}: two rooms have the same name")
    for room in rooms:
        check_uses(path, room, by_name)
    return floors, rooms


def check_room(path, room, floor_count):
    """The fields of one room have the right types."""
    types = {"name": str, "path": str, "floor": int, "may_use": list}
    if not isinstance(room, dict) or not all(type(room.get(key)) is types[key] for key in types):
        raise HouseError(f"{path}: a room needs a name, a path, a floor number and a list may_use, but one is {room}")
    if not 0 <= room["floor"] < floor_count:
        raise HouseError(f"{path}: {room['name']} is on floor {room['floor']}, expected 0 to {floor_count - 1}")
    if not (room["name"] and (room["name"] + room["path"]).isprintable()):
        raise HouseError(f"{path}: the room name {room['name']!r} or its path {room['path']!r} is not printable text")


def check_uses(path, room, by_name):
    """A room uses known rooms on lower floors only."""
    for used in room["may_use"] if room["may_use"] != ANYTHING else []:
        if not isinstance(used, str) or used not in by_name:
            raise HouseError(f"{path}: {room['name']} may use {used}, which is no room")
        if by_name[used]["floor"] >= room["floor"]:
            raise HouseError(f"{path}: {room['name']} (floor {room['floor']}) may not use {used} "
                             f"(floor {by_name[used]['floor']}), which is not on a lower floor")


class House:
    """Where everything stands, and the elements that draw it."""

    def __init__(self, floors, rooms, repository):
        self.floors, self.rooms, self.repository = floors, rooms, repository
        self.by_name = {room["name"]: room for room in rooms}
        self.on_floor = [[room["name"] for room in rooms if room["floor"] == floor] for floor in range(len(floors))]
        self.inner = SLOT * max(4, max(map(len, self.on_floor)))
        self.left, self.right = MARGIN, MARGIN + BAND_LABEL + self.inner
        self.top = 40 + ROOF_HEIGHT
        self.bottom = self.top + BAND_HEIGHT * len(floors)
        self.width, self.height = self.right + MARGIN, self.bottom + 84
        self.lanes = {}
        self.boxes = {name: self.box(name) for name in self.by_name}

    def box(self, name):
        """(x, y, width, height) of a room; the rooms of a floor are spread evenly."""
        neighbours = self.on_floor[self.by_name[name]["floor"]]
        slot = self.inner / len(neighbours)
        width = min(SLOT - 40, slot - 40)
        x = self.left + BAND_LABEL + slot * (neighbours.index(name) + 0.5) - width / 2
        return x, self.floor_top(self.by_name[name]["floor"]) + (BAND_HEIGHT - BOX_HEIGHT) / 2, width, BOX_HEIGHT

    def floor_top(self, floor):
        return self.bottom - BAND_HEIGHT * (floor + 1)

    def exists(self, room):
        return (self.repository / room["path"]).is_dir()

    def accent(self, floor):
        return ACCENTS[floor % len(ACCENTS)]

    def arrows(self):
        """(user, used, implied) for every use that is spelled out."""
        for room in self.rooms:
            uses = [] if room["may_use"] == ANYTHING else list(dict.fromkeys(room["may_use"]))
            for used in uses:
                yield room["name"], used, any(used in self.by_name[other]["may_use"] for other in uses)

    def ports(self, arrows):
        """Where each arrow leaves and enters: spread over the edges of the boxes in the order of the other ends."""
        middle = {name: box[0] + box[2] / 2 for name, box in self.boxes.items()}
        ports = {}
        for end in (0, 1):
            for name, (x, _, width, _) in self.boxes.items():
                mine = [arrow for arrow in arrows if arrow[end] == name]
                mine.sort(key=lambda arrow: middle[arrow[1 - end]])
                for i, arrow in enumerate(mine):
                    ports[arrow, end] = x + width * (0.12 + 0.76 * (i + 0.5) / len(mine))
        return ports

    def gap(self, floor, wanted):
        """The free x on a floor nearest to `wanted`, beside boxes and beside arrows already there."""
        boxes = [self.boxes[name] for name in self.on_floor[floor]]
        taken = [(x - 14, x + width + 14) for x, _, width, _ in boxes]
        taken += [(x - LANE + 1, x + LANE - 1) for x in self.lanes.get(floor, [])]
        steps = sorted(range(-self.inner, self.inner), key=abs)
        free = (wanted + step for step in steps if not any(low < wanted + step < high for low, high in taken)
                and self.left + BAND_LABEL - 10 < wanted + step < self.right - 10)
        x = next(free, wanted)
        self.lanes.setdefault(floor, []).append(x)
        return x

    def route(self, arrow, start, end):
        """SVG path from box to box, through the gaps of the floors between, with vertical tangents."""
        upper, lower = self.by_name[arrow[0]]["floor"], self.by_name[arrow[1]]["floor"]
        (_, y0, _, _), (_, y1, _, _) = self.boxes[arrow[0]], self.boxes[arrow[1]]
        points = [(start, y0 + BOX_HEIGHT)]
        for floor in range(upper - 1, lower, -1):
            x = self.gap(floor, start + (end - start) * (upper - floor) / (upper - lower))
            top = self.floor_top(floor) + (BAND_HEIGHT - BOX_HEIGHT) / 2
            points += [(x, top), (x, top + BOX_HEIGHT)]
        points.append((end, y1 - 7))
        path = f"M{start:.1f},{points[0][1]:.1f}"
        for i in range(0, len(points) - 1, 2):
            (xa, ya), (xb, yb) = points[i:i + 2]
            bend = (yb - ya) * 0.55
            path += f" C{xa:.1f},{ya + bend:.1f} {xb:.1f},{yb - bend:.1f} {xb:.1f},{yb:.1f}"
            path += f" V{points[i + 2][1]:.1f}" if i + 2 < len(points) else ""
        return path

    def draw_arrows(self):
        """All arrows, the implied ones below the others."""
        span = {arrow: self.by_name[arrow[0]]["floor"] - self.by_name[arrow[1]]["floor"] for arrow in self.arrows()}
        arrows = sorted(span, key=span.get)
        ports = self.ports(arrows)
        routes = [(arrow, self.route(arrow, ports[arrow, 0], ports[arrow, 1])) for arrow in arrows]
        for (user, used, implied), path in sorted(routes, key=lambda route: not route[0][2]):
            look = arrow_look(self.by_name[user]["floor"], implied)
            yield f'<path class="arrow" d="{path}" {look}><title>{escape(f"{user} uses {used}")}</title></path>'

    def draw_walls(self):
        """Earth, bands with their names, and the roof."""
        ground, middle, eaves = self.floor_top(0), (self.left + self.right) / 2, 26
        width = self.right - self.left
        yield (f'<rect x="0" y="{ground}" width="{self.width}" height="{self.bottom + 14 - ground}" fill="#d9cbb8"/>'
               f'<line x1="0" x2="{self.width}" y1="{ground}" y2="{ground}" stroke="#8a7355" stroke-width="2"/>')
        for floor, name in enumerate(self.floors):
            y = self.floor_top(floor)
            yield (f'<rect class="floor" x="{self.left}" y="{y}" width="{width}" height="{BAND_HEIGHT}" '
                   f'fill="{TINTS[floor % len(TINTS)]}" stroke="#ffffff" stroke-width="2"/>')
            yield text(self.left + 16, y + BAND_HEIGHT / 2 + 5, name, fit(name, 14, BAND_LABEL - 12),
                       self.accent(floor), ' font-weight="700"')
        yield (f'<rect x="{self.left}" y="{self.top}" width="{width}" height="{self.bottom - self.top}" '
               'fill="none" stroke="#5b6572" stroke-width="2.5"/>')
        yield (f'<polygon points="{self.left - eaves},{self.top} {middle:.1f},30 {self.right + eaves},{self.top}" '
               'fill="#9a3b26" stroke="#6f2919" stroke-width="2.5" stroke-linejoin="round"/>')
        yield text(middle, self.top - 26, "GSLAM", 26, "#fff7ee",
                   ' font-weight="700" text-anchor="middle" letter-spacing="4"')

    def draw_room(self, room):
        """One box: name, path and, where it holds, that it may use everything below."""
        x, y, width, height = self.boxes[room["name"]]
        solid, middle = self.exists(room), x + width / 2
        accent = self.accent(room["floor"])
        look = (f'fill="#ffffff" stroke="{accent}" stroke-width="2"' if solid else
                'fill="#f7f7f5" stroke="#98a1aa" stroke-width="1.5" stroke-dasharray="6 4"')
        yield (f'<rect class="room {"built" if solid else "planned"}" x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" '
               f'height="{height}" rx="10" {look}/>')
        lines = [(room["name"], 16, INK if solid else FAINT, ' font-weight="700"')]
        if room["path"] != room["name"]:
            lines.append((room["path"], 11, FAINT, ""))
        if room["may_use"] == ANYTHING:
            lines.append(("may use all below", 11, accent if solid else FAINT, ' font-style="italic"'))
        first = y + height / 2 + 9 - 9 * (len(lines) - 1)
        for i, (words, size, colour, extra) in enumerate(lines):
            yield text(middle, first + 17 * i, words, fit(words, size, width), colour, extra + ' text-anchor="middle"')

    def draw_legend(self):
        """What solid, dashed, strong and faint mean."""
        x, y, box = self.left, self.bottom + 48, 'width="30" height="18" rx="4"'
        planned = 'fill="#f7f7f5" stroke="#98a1aa" stroke-width="1.5" stroke-dasharray="6 4"'
        yield f'<rect x="{x}" y="{y - 13}" {box} fill="#ffffff" stroke="{INK}" stroke-width="2"/>'
        yield f'<rect x="{x + 180}" y="{y - 13}" {box} {planned}/>'
        yield f'<path d="M{x + 310},{y - 4} h26" {arrow_look(0, False)}/>'
        yield f'<path d="M{x + 440},{y - 4} h26" {arrow_look(0, True)}/>'
        words = {40: "in the repository", 220: "planned", 356: "may use",
                 486: "may use, also reached through another room"}
        for offset, meaning in words.items():
            yield text(x + offset, y + 1, meaning, 13)

    def draw(self):
        """The house as SVG text."""
        head = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" role="img" '
                f'width="{self.width}" height="{self.height}" font-family="Helvetica, Arial, sans-serif">',
                "<title>The house of GSLAM</title>", f"<desc>{escape(self.describe())}</desc>", markers(),
                f'<rect width="{self.width}" height="{self.height}" rx="12" fill="{PAPER}"/>']
        rooms = [part for room in self.rooms for part in self.draw_room(room)]
        return "\n".join([*head, *self.draw_walls(), *self.draw_arrows(), *rooms, *self.draw_legend(), "</svg>\n"])

    def describe(self):
        """The picture in words, top floor first."""
        floors = [f"{self.floors[floor]}: {', '.join(self.on_floor[floor]) or 'empty'}"
                  for floor in reversed(range(len(self.floors)))]
        return "Rooms use only rooms on lower floors. " + "; ".join(floors) + "."


def text(x, y, words, size, colour=INK, extra=""):
    """One line of text; `extra` holds further attributes."""
    return f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" fill="{colour}"{extra}>{escape(words)}</text>'


def fit(words, size, width):
    """The font size, made smaller where the words would not fit the width."""
    return f"{min(size, 1.6 * width / max(1, len(words))):.3g}"


def arrow_look(floor, implied):
    """Attributes of an arrow that starts on a floor."""
    style = 'stroke-width="1" stroke-opacity="0.45"' if implied else 'stroke-width="1.6"'
    tip = f"house-tip-{floor % len(ACCENTS)}{'-faint' if implied else ''}"
    return f'fill="none" stroke="{ACCENTS[floor % len(ACCENTS)]}" {style} marker-end="url(#{tip})"'


def markers():
    """Arrow tips, one strong and one faint for each colour."""
    shape = 'viewBox="0 0 10 10" refX="3" refY="5" markerWidth="8" markerHeight="8" markerUnits="userSpaceOnUse"'
    tips = [f'<marker id="house-tip-{i}{suffix}" {shape} orient="auto"><path d="M0,0 L10,5 L0,10 z" '
            f'fill="{colour}" fill-opacity="{opacity}"/></marker>'
            for i, colour in enumerate(ACCENTS) for suffix, opacity in (("", 1), ("-faint", 0.5))]
    return "<defs>" + "".join(tips) + "</defs>"


def main(arguments):
    if len(arguments) != 2 or arguments[0] in ("-h", "--help"):
        print(__doc__, file=sys.stderr)
        return 2
    try:
        floors, rooms = read_rooms(arguments[0])
        repository = Path(arguments[0]).resolve().parent.parent
        Path(arguments[1]).write_text(House(floors, rooms, repository).draw(), encoding="utf-8")
    except (HouseError, OSError) as error:
        print(f"house.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
