"""`gslam optimize`: reads, solves, writes and shows bundles and pose graphs.

The program is named by the environment variable GSLAM, the folder of real data by GSLAM_TEST_DATA.
"""

import gzip
import json
import os
import pathlib
import struct
import subprocess
import unittest

from folder import Folder

GSLAM = os.environ["GSLAM"]
DATA = pathlib.Path(os.environ.get("GSLAM_TEST_DATA", ""))
HAS_DATA = (DATA / "pose_graphs").is_dir()

# A square of odometry whose loop does not close, and a vertex that says where to begin.
SQUARE = """VERTEX_SE2 0 0 0 0
VERTEX_SE2 1 1 0 1.5
VERTEX_SE2 2 1 1 3.1
VERTEX_SE2 3 0 1 -1.5
FIX 0
EDGE_SE2 0 1 1 0 1.5708 10 0 0 10 0 10
EDGE_SE2 1 2 1 0 1.5708 10 0 0 10 0 10
EDGE_SE2 2 3 1 0 1.5708 10 0 0 10 0 10
EDGE_SE2 3 0 1.1 0 1.5708 10 0 0 10 0 10
"""


def optimize(*arguments):
    return subprocess.run([GSLAM, "optimize", *map(str, arguments)], capture_output=True,
                          text=True, timeout=120)


class OptimizeFolder(Folder):
    def json(self, *arguments):
        return json.loads(self.check(optimize(*arguments, "--json")).stdout)


class Use(OptimizeFolder):
    def test_wrong_use(self):
        square = self.write("square.g2o", SQUARE)
        self.check(optimize("--help"), out="--backend")
        self.check(optimize(), 2, err="FILE: must be given")
        self.check(optimize(self.folder / "none.g2o"), 1, err="cannot be opened")
        self.check(optimize(square, "--loss", "hubert"), 2, err="expected one of squared, huber")
        self.check(optimize(square, "--loss", "huber:-1"), 2, err="expected a number above 0")
        self.check(optimize(square, "--backend", "g2o"), 2, err="expected one of those that are")
        self.check(optimize(square, "--out", "x.out"), 2, err="cannot hold a pose graph")
        self.check(optimize(square, "--fix-intrinsics"), 2, err="is for bundles")
        self.check(optimize(self.write("a.txt", "hello\n")), 2, err="looks like none of BAL")

    def test_what_cannot_be_written_is_said_before_the_work(self):
        square, nowhere = self.write("square.g2o", SQUARE), self.folder / "nowhere" / "file"
        for option in ["--out", "--report", "--ply"]:
            result = self.check(optimize(square, option, nowhere), 1, err="there is no folder")
            self.assertEqual(result.stdout, "")

    def test_compressed_files_are_named(self):
        packed = self.folder / "square.g2o.gz"
        packed.write_bytes(gzip.compress(SQUARE.encode()))
        self.check(optimize(packed), 1, err="is compressed by gzip")

    def test_bad_files_are_refused_with_their_place(self):
        bad = self.write("bad.g2o", SQUARE.replace("1.1 0", "1.1 x"))
        self.check(optimize(bad), 1, err="bad.g2o:9:18: 'x' is y, expected a finite number")


class WithoutCost(OptimizeFolder):
    def test_a_cost_without_a_value_is_said_so(self):
        far = self.write("far.g2o", SQUARE.replace("1.1 0 1.5708", "1e200 0 1.5708"))
        page = self.folder / "page.html"
        self.check(optimize(far, "--report", page), 1, out="cost         no value to no value, of",
                   err="no finite value")
        self.assertIn("<td>no value to no value</td>", page.read_text(encoding="utf-8"))
        facts = json.loads(optimize(far, "--json").stdout)
        self.assertIsNone(facts["initial_cost"])
        self.assertFalse(facts["is_usable"])


class PoseGraphs(OptimizeFolder):
    def test_a_square_is_closed(self):
        square = self.write("square.g2o", SQUARE)
        out = self.folder / "out.g2o"
        facts = self.json(square, "--out", out)
        self.assertTrue(facts["is_usable"])
        self.assertEqual(facts["problem"], {"kind": "pose graph", "group": "SE2", "poses": 4,
                                            "edges": 4})
        self.assertLess(facts["final_cost"], 0.1 * facts["initial_cost"])
        again = self.json(out)
        self.assertAlmostEqual(again["initial_cost"], facts["final_cost"], delta=1e-12)

    def test_the_table_has_a_line_for_each_iteration(self):
        square = self.write("square.g2o", SQUARE)
        lines = self.check(optimize(square), out="problem      pose graph in SE2").stdout.split("\n")
        count = len(self.json(square)["iterations"])
        table = [line for line in lines if line.strip()[:1].isdigit()]
        self.assertEqual(len(table), count)

    def test_formats_may_change(self):
        square = self.write("square.g2o", SQUARE)
        first = self.json(square, "--iterations", 0, "--out", self.folder / "square.graph")
        second = self.json(self.folder / "square.graph", "--iterations", 0)
        self.assertAlmostEqual(first["final_cost"], second["initial_cost"], delta=1e-12)

    def test_pictures(self):
        square = self.write("square.g2o", SQUARE)
        page, cloud = self.folder / "page.html", self.folder / "cloud.ply"
        self.check(optimize(square, "--report", page, "--ply", cloud))
        html = page.read_text()
        self.assertIn("square.g2o: pose graph", html)
        self.assertNotIn("http", html)  # needs no network
        self.assertIn("edges from a pose to the next", html)
        self.assertIn("other edges", html)
        self.assertIn("<figcaption>before</figcaption>", html)
        self.assertNotIn("</span> cameras", html)
        for path in [cloud, self.folder / "cloud.before.ply"]:
            header, _, body = path.read_bytes().partition(b"end_header\n")
            self.assertIn(b"element vertex 12", header)  # 4 poses, 2 for each edge
            self.assertEqual(len(body), 12 * 15 + 4 * 8)
            self.assertEqual(struct.unpack_from("<3f", body), (0, 0, 0))

    @unittest.skipUnless(HAS_DATA, "GSLAM_TEST_DATA names no folder")
    def test_a_chordal_start_finds_the_sphere(self):
        sphere = DATA / "pose_graphs" / "sphere2500.g2o"
        facts = self.json(sphere, "--init", "chordal", "--residual", "chordal")
        self.assertLess(facts["final_cost"], 1.001 * 1687 / 2)


@unittest.skipUnless(HAS_DATA, "GSLAM_TEST_DATA names no folder")
class Bundles(OptimizeFolder):
    LADYBUG = DATA / "bundle_adjustment" / "problem-49-7776-pre.txt"

    def test_the_file_has_the_cost_that_was_reached(self):
        out, page = self.folder / "out.txt", self.folder / "page.html"
        facts = self.json(self.LADYBUG, "--iterations", 5, "--out", out, "--report", page)
        self.assertAlmostEqual(facts["initial_cost"], 8.509125e5, delta=0.5)
        self.assertLess(facts["final_cost"], 3e4)
        again = self.json(out, "--iterations", 0)
        self.assertAlmostEqual(again["initial_cost"] / facts["final_cost"], 1, delta=1e-12)
        self.assertIn("7776 points", page.read_text())

    def test_fixed_cameras_stay(self):
        out = self.folder / "out.txt"
        self.json(self.LADYBUG, "--iterations", 3, "--fix-intrinsics", "--out", out)
        cameras = [path.read_text().split()[3 + 4 * 31843:][6:9] for path in [self.LADYBUG, out]]
        self.assertEqual([float(x) for x in cameras[0]], [float(x) for x in cameras[1]])

    def test_bundler_goes_to_colmap_and_back_to_bal(self):
        source = DATA / "bundle_adjustment" / "bundler_balbianello" / "balbianello.out"
        first = self.json(source, "--iterations", 0, "--out", f"{self.folder}/model/")
        second = self.json(self.folder / "model", "--iterations", 0, "--out",
                           self.folder / "model.bal")
        third = self.json(self.folder / "model.bal", "--iterations", 0)
        for facts in [second, third]:
            self.assertAlmostEqual(facts["initial_cost"] / first["initial_cost"], 1, delta=1e-10)
        self.check(optimize(source, "--init", "tree"), 2, err="is for pose graphs")


if __name__ == "__main__":
    unittest.main()
