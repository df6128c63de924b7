"""Tests of docs/house.py: what stands where, which arrows are drawn, and what is refused."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TOOL = Path(__file__).resolve().parent.parent / "house.py"
REAL_ROOMS = TOOL.parent.parent / "cmake" / "rooms.json"
SVG = "{http://www.w3.org/2000/svg}"
FLOORS = ["cellar", "ground", "first", "attic"]


def room(name, floor, *may_use, path=None):
    return {"name": name, "path": path or f"libs/{name}", "floor": floor, "may_use": list(may_use)}


HOUSE = [room("base", 0), room("svar", 1, "base"), room("geometry", 1, "base"), room("core", 2, "base", "svar"),
         room("apps", 3, "*", path="apps")]


class HouseTest(unittest.TestCase):
    """A repository of its own, with cmake/rooms.json in it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "cmake").mkdir()

    def run_tool(self, content, output="house.svg"):
        text = content if isinstance(content, str) else json.dumps(content)
        (self.folder / "cmake" / "rooms.json").write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, str(TOOL), "cmake/rooms.json", output], cwd=self.folder,
                              capture_output=True, encoding="utf-8", timeout=60)

    def draw(self, rooms=HOUSE, floors=FLOORS):
        done = self.run_tool({"floors": floors, "rooms": rooms})
        self.assertEqual(done.returncode, 0, done.stderr)
        return ElementTree.parse(self.folder / "house.svg").getroot()

    def assert_refused(self, content, *says):
        done = self.run_tool(content)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "house.svg").exists())
        for words in says:
            self.assertIn(words, done.stderr)


def by_class(root, tag, name):
    return [element for element in root.iter(SVG + tag) if name in element.get("class", "").split()]


def arrows(root):
    """{"core uses base": path element}"""
    return {arrow.find(f"{SVG}title").text: arrow for arrow in by_class(root, "path", "arrow")}


def texts(root):
    return [element.text for element in root.iter(f"{SVG}text")]


def frame(rectangle):
    """(left, top, right, bottom)"""
    x, y, width, height = (float(rectangle.get(key)) for key in ("x", "y", "width", "height"))
    return x, y, x + width, y + height


class PictureTest(HouseTest):
    def test_rooms_stand_on_their_floors(self):
        root = self.draw()
        bands, boxes = by_class(root, "rect", "floor"), by_class(root, "rect", "room")
        self.assertEqual((len(bands), len(boxes)), (4, 5))
        for entry, box in zip(HOUSE, boxes):
            band, inner = frame(bands[entry["floor"]]), frame(box)
            self.assertTrue(band[0] < inner[0] and band[1] < inner[1] and inner[2] < band[2] and inner[3] < band[3])
        tops = [frame(band)[1] for band in bands]
        self.assertEqual(tops, sorted(tops, reverse=True))
        roof = next(root.iter(f"{SVG}polygon")).get("points").split()
        self.assertEqual(float(roof[0].split(",")[1]), tops[-1])

    def test_boxes_do_not_overlap_even_when_many(self):
        root = self.draw([room(f"room{i}", 0) for i in range(11)] + [room("top", 1, "room3")])
        boxes = sorted(frame(box) for box in by_class(root, "rect", "room"))
        lower = [box for box in boxes if box[1] == max(other[1] for other in boxes)]
        self.assertEqual(len(lower), 11)
        self.assertTrue(all(left[2] < right[0] for left, right in zip(lower, lower[1:])))

    def test_arrows(self):
        found = arrows(self.draw())
        self.assertEqual(set(found), {"svar uses base", "geometry uses base", "core uses base", "core uses svar"})
        implied = {name for name, arrow in found.items() if "faint" in arrow.get("marker-end")}
        self.assertEqual(implied, {"core uses base"})

    def test_arrows_point_at_markers_that_exist_and_run_down(self):
        root = self.draw()
        markers = {f"url(#{marker.get('id')})" for marker in root.iter(f"{SVG}marker")}
        for arrow in arrows(root).values():
            self.assertIn(arrow.get("marker-end"), markers)
            on_the_way = re.findall(r"M[\d.]+,([\d.]+)|C\S+ \S+ [\d.]+,([\d.]+)|V([\d.]+)", arrow.get("d"))
            heights = [float("".join(height)) for height in on_the_way]
            self.assertGreaterEqual(len(heights), 2)
            self.assertEqual(heights, sorted(heights))

    def test_long_arrows_pass_beside_the_boxes(self):
        root = self.draw([room("base", 0), room("mid", 1), room("top", 2, "base")])
        left, top, right, bottom = frame(by_class(root, "rect", "room")[1])
        x, height = re.search(r"([\d.]+),([\d.]+) V", arrows(root)["top uses base"].get("d")).groups()
        self.assertEqual(float(height), top)
        self.assertFalse(left <= float(x) <= right)

    def test_anything_is_a_note(self):
        root = self.draw()
        self.assertEqual(texts(root).count("may use all below"), 1)
        self.assertFalse([name for name in arrows(root) if "apps" in name])

    def test_planned_and_built(self):
        (self.folder / "libs" / "svar").mkdir(parents=True)
        (self.folder / "libs" / "core").write_text("a file is no room", encoding="utf-8")
        root = self.draw()
        self.assertEqual([box.get("class") for box in by_class(root, "rect", "room")],
                         ["room planned", "room built", "room planned", "room planned", "room planned"])
        dashed = [box.get("stroke-dasharray") is not None for box in by_class(root, "rect", "room")]
        self.assertEqual(dashed, [True, False, True, True, True])
        self.assertTrue({"in the repository", "planned", "may use"} <= set(texts(root)))

    def test_accessible_and_on_its_own_background(self):
        root = self.draw()
        self.assertEqual([root[0].tag, root[1].tag], [f"{SVG}title", f"{SVG}desc"])
        self.assertIn("attic: apps; first: core; ground: svar, geometry; cellar: base", root[1].text)
        background = next(root.iter(f"{SVG}rect"))
        self.assertEqual((background.get("width"), background.get("height")), (root.get("width"), root.get("height")))
        self.assertIn("sans-serif", root.get("font-family"))

    def test_deterministic(self):
        self.draw()
        first = (self.folder / "house.svg").read_bytes()
        self.draw()
        self.assertEqual(first, (self.folder / "house.svg").read_bytes())

    def test_markup_in_names(self):
        self.assertIn("a<b>&c", texts(self.draw([room("a<b>&c", 0)])))

    @unittest.skipUnless(REAL_ROOMS.exists(), "no rooms.json beside this tool")
    def test_the_real_house(self):
        document = json.loads(REAL_ROOMS.read_text(encoding="utf-8"))
        root = self.draw(document["rooms"], document["floors"])
        self.assertEqual(len(by_class(root, "rect", "room")), len(document["rooms"]))
        uses = sum(len(entry["may_use"]) for entry in document["rooms"] if entry["may_use"] != ["*"])
        self.assertEqual(len(arrows(root)), uses)


class RefusalTest(HouseTest):
    def refuse_rooms(self, rooms, *says):
        self.assert_refused({"floors": FLOORS, "rooms": rooms}, *says)

    def test_same_or_higher_floor(self):
        self.refuse_rooms([room("svar", 1, "geometry"), room("geometry", 1)], "svar (floor 1)", "geometry (floor 1)")
        self.refuse_rooms([room("svar", 1, "core"), room("core", 2)], "svar (floor 1)", "core (floor 2)")
        self.refuse_rooms([room("svar", 1, "svar")], "svar (floor 1) may not use svar")

    def test_unknown_room(self):
        self.refuse_rooms([room("svar", 1, "bass")], "svar", "bass")
        self.refuse_rooms([room("svar", 1, ["base"])], "svar")

    def test_bad_rooms(self):
        self.refuse_rooms([room("svar", 4)], "svar is on floor 4, expected 0 to 3")
        self.refuse_rooms([room("svar", -1)], "svar is on floor -1")
        self.refuse_rooms([room("svar", True)], "floor number")
        self.refuse_rooms([room("svar", 0), room("svar", 1)], "same name")
        self.refuse_rooms([room("", 0)], "not printable")
        self.refuse_rooms([room("a\u0001", 0)], "not printable")
        self.refuse_rooms([{"name": "svar"}], "a room needs")
        self.refuse_rooms([3], "a room needs")
        self.refuse_rooms([], "at least one room")

    def test_bad_files(self):
        for text in ("", "{", "[]", "3", "{}", '{"floors": [], "rooms": 3}', '{"floors": [1], "rooms": [1]}',
                     "[" * 100000):
            with self.subTest(text=text[:30]):
                self.assert_refused(text, "rooms.json: ")

    def test_absent_input_unwritable_output_and_usage(self):
        done = self.run_tool({"floors": FLOORS, "rooms": HOUSE}, "absent/house.svg")
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (2, 1))
        for arguments in ([], ["absent.json", "house.svg"]):
            done = subprocess.run([sys.executable, str(TOOL), *arguments], cwd=self.folder, capture_output=True,
                                  encoding="utf-8", timeout=60)
            self.assertEqual(done.returncode, 2)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
