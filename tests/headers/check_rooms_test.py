"""check_rooms.py must see every kind of forbidden arrow."""

import pathlib
import tempfile
import unittest

import check_rooms


def room(name, floor, may_use, path=None):
    return {"name": name, "path": path or f"libs/{name}", "floor": floor, "may_use": may_use}


class CheckRooms(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        self.plan = {"processor_headers": ["immintrin.h"],
                     "system_headers": {"gslam/low/platform.h": ["cxxabi.h"]},
                     "interop_headers": {"gslam/high/eigen.h": ["Eigen/"]},
                     "rooms": [room("low", 0, []), room("high", 1, ["low"]),
                               room("apps", 2, ["*"], "apps")]}
        self.house = {"source": self.root, "components": [
            {"name": "low", "depends": {}, "folder": self.root / "libs/low"},
            {"name": "high", "depends": {"low": "1.0"}, "folder": self.root / "libs/high"}]}
        self.write("libs/low/include/gslam/low.h", "#include <vector>\n#include <immintrin.h>\n")
        self.write("libs/high/include/gslam/high.h", "#include <gslam/low.h>\n")

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def complaints(self):
        return list(check_rooms.check(self.house, self.plan))

    def assert_one_complaint(self, *words):
        complaints = self.complaints()
        self.assertEqual(len(complaints), 1, complaints)
        for word in words:
            self.assertIn(word, complaints[0])

    def test_a_good_house_passes(self):
        self.write("libs/low/include/gslam/low/platform.h", "#include <cxxabi.h>\n")
        self.write("libs/high/include/gslam/high/eigen.h", "#include <Eigen/Core>\n")
        self.write("apps/run.cpp", "#include <gslam/high.h>\n#include <zlib.h>\n")
        self.assertEqual(self.complaints(), [])

    def test_an_arrow_that_runs_up(self):
        self.write("libs/low/include/gslam/low/x.h", "# include  <gslam/high/a.h>\n")
        self.assert_one_complaint("low/x.h", "does not declare high")

    def test_an_arrow_from_a_test_file(self):
        self.write("libs/low/tests/x.cpp", '#include "gslam/high.h"\n')
        self.assert_one_complaint("tests/x.cpp", "high")

    def test_an_arrow_by_a_relative_path(self):
        self.write("libs/low/tests/x.cpp", '#include "../../high/include/gslam/high.h"\n')
        self.assert_one_complaint("tests/x.cpp", "high")

    def test_an_arrow_behind_comments(self):
        for i, line in enumerate(["#include /* up */ <gslam/high.h>", "/**/ #include <gslam/high.h>",
                                  "/* \n */#include <gslam/high.h>", "# \\\n include <gslam/high.h>"]):
            self.write("libs/low/tests/x.cpp", line + "\n")
            with self.subTest(i):
                self.assert_one_complaint("tests/x.cpp", "high")

    def test_an_include_in_a_comment_or_after_a_string_is_none(self):
        self.write("libs/low/tests/x.cpp", '// #include <gslam/high.h>\n/*\n#include <gslam/high.h>\n'
                   '*/\nconst char* url = "http://a/*b"; // "*/\n')
        self.assertEqual(self.complaints(), [])

    def test_an_include_that_a_macro_names(self):
        self.write("libs/low/tests/x.cpp", "#define H <gslam/high.h>\n#include H\n")
        self.assert_one_complaint("tests/x.cpp", "macro")

    def test_files_of_other_kinds(self):
        self.write("libs/low/tests/x.ipp", "#include <gslam/high.h>\n")
        self.assert_one_complaint("tests/x.ipp", "high")

    def test_a_header_under_a_name_that_is_not_its_own(self):
        for name in ("high_x.h", "low/x.hpp", "lower.h", "low/x.ipp"):
            self.write(f"libs/low/include/gslam/{name}", "\n")
            with self.subTest(name):
                self.assert_one_complaint(name, "not a header")
            (self.root / "libs/low/include/gslam" / name).unlink()

    def test_a_declared_dependency_that_the_plan_forbids(self):
        self.house["components"][0]["depends"] = {"high": "1.0"}
        self.assert_one_complaint("low depends on high", "does not allow")

    def test_a_plan_with_a_circle(self):
        self.plan["rooms"][0]["may_use"] = ["high"]
        self.assert_one_complaint("rooms.json", "low", "high", "lower floor")

    def test_a_plan_that_names_no_room(self):
        self.plan["rooms"][1]["may_use"] = ["low", "loft"]
        self.assert_one_complaint("loft", "no room")

    def test_a_foreign_header_in_a_public_one(self):
        self.write("libs/high/include/gslam/high/x.h", "#include <Eigen/Core>\n")
        self.assert_one_complaint("high/x.h", "Eigen/Core")

    def test_a_system_header_outside_its_one_file(self):
        self.write("libs/high/include/gslam/high/x.h", "#include <cxxabi.h>\n")
        self.assert_one_complaint("high/x.h", "cxxabi.h")

    def test_a_foreign_header_in_a_source_file_is_fine(self):
        self.write("libs/high/src/x.cpp", "#include <Eigen/Core>\n")
        self.assertEqual(self.complaints(), [])

    def test_an_interop_header_that_another_header_includes(self):
        self.write("libs/high/include/gslam/high/eigen.h", "#include <Eigen/Core>\n")
        self.write("libs/high/include/gslam/high/x.h", "#include <gslam/high/eigen.h>\n")
        self.assert_one_complaint("high/x.h", "opt-in")

    def test_a_new_library_may_use_what_it_declares_and_no_more(self):
        new = {"name": "new", "depends": {"high": "1.0"}, "folder": self.root / "libs/new"}
        self.house["components"].append(new)
        self.write("libs/new/include/gslam/new.h", "#include <gslam/high.h>\n")
        self.assertEqual(self.complaints(), [])
        self.write("libs/new/include/gslam/new/x.h", "#include <gslam/low.h>\n")
        self.assert_one_complaint("new/x.h", "does not declare low")

    def test_a_package_inside_another_folder_has_its_own_rules(self):
        nested = {"name": "high_formats", "depends": {"high": "1.0"},
                  "folder": self.root / "libs/high/formats"}
        self.house["components"].append(nested)
        self.write("libs/high/formats/include/gslam/high_formats/x.h", "#include <gslam/high.h>\n")
        self.assertEqual(self.complaints(), [])

    def test_an_upper_room_that_includes_its_own_floor(self):
        self.plan["rooms"].append(room("tools", 2, ["low"], "libs/tools"))
        self.write("apps/x.cpp", "#include <gslam/tools.h>\n")
        self.assert_one_complaint("apps/x.cpp", "gslam/tools.h")


if __name__ == "__main__":
    unittest.main()
