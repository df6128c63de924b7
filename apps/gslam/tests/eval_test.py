"""`gslam eval` as others script against it: its options, its JSON, its errors.

The program is named by the environment variable GSLAM, the folder of real data by GSLAM_TEST_DATA.
"""

import json
import math
import os
import pathlib
import subprocess
import unittest

from folder import Folder

GSLAM = os.environ["GSLAM"]
DATA = os.environ.get("GSLAM_TEST_DATA")
FIGURES = ["rmse", "mean", "median", "std", "min", "max", "sse", "count", "p90", "p95", "p99"]


def evaluate(*arguments, **environment):
    return subprocess.run([GSLAM, "eval", *map(str, arguments)], capture_output=True, text=True,
                          encoding="utf-8", timeout=60, env={**os.environ, **environment})


def pose(t):
    """x y z and a heading, all on a way that never repeats."""
    return (8 * math.sin(0.31 * t), 5 * math.cos(0.23 * t) + 0.2 * t, math.sin(0.17 * t), 0.4 * t)


def tum(stamps, scale=1.0, shift=0.0, offset=0.0, end="\n", unit=1.0):
    lines = ["# made by a test"]
    for t in stamps:
        x, y, z, heading = pose(t - 1000)
        lines.append(f"{(t + offset) * unit:.6f} {scale * x + shift:.9f} {scale * y:.9f} {scale * z:.9f} "
                     f"0 0 {math.sin(heading / 2):.12f} {math.cos(heading / 2):.12f}")
    return end.join(lines) + end


def stamps(count, step=0.05, first=1000.0):
    return [first + step * i for i in range(count)]


class EvalFolder(Folder):
    def setUp(self):
        super().setUp()
        self.ref = self.write("ref.txt", tum(stamps(600)))

    def figures(self, *arguments, status=0):
        return json.loads(self.check(evaluate(*arguments, "--json"), status).stdout)


class Json(EvalFolder):
    def test_has_what_the_contract_says(self):
        est = self.write("est.txt", tum(stamps(500), shift=0.1))
        result = self.figures("--ref", self.ref, "--est", est, "--align", "none", "--rpe", "1f",
                              "--rpe", "10f:all", "--rpe=5m", "--rpe", "2s,10deg", "--kitti",
                              "--segments", "10,20")
        for name in ["pairs", "dropped_ref", "dropped_est", "max_gap_s"]:
            self.assertIn(name, result["association"])
        self.assertEqual(result["association"]["pairs"], 500)
        self.assertEqual(result["association"]["dropped_ref"], 100)
        for name in ["time", "frames", "losses", "time_to_initialise_s"]:
            self.assertIn(name, result["coverage"])
        self.assertAlmostEqual(result["coverage"]["time"], 499.5 / 599, places=6)
        self.assertEqual(result["alignment"]["scale"], 1)
        self.assertEqual(len(result["alignment"]["rotation"]), 4)
        self.assertEqual(len(result["alignment"]["translation"]), 3)
        for kind in ["translation", "rotation_deg", "full"]:
            for name in FIGURES:
                self.assertIn(name, result["ape"][kind])
        self.assertAlmostEqual(result["ape"]["translation"]["rmse"], 0.1, places=6)
        self.assertEqual([one["delta"] for one in result["rpe"]],
                         ["1f", "10f:all", "5m", "2s", "10deg"])
        self.assertEqual(result["rpe"][1]["translation"]["count"], 490)
        self.assertLess(result["rpe"][0]["translation"]["max"], 1e-6)
        for name in ["t_err_percent", "r_err_deg_per_m", "segments"]:
            self.assertIn(name, result["kitti"])
        self.assertEqual([one["length_m"] for one in result["segments"]], [10, 20])
        self.assertGreater(result["score"]["value"], 0)

    def test_a_run_is_claimed_only_for_its_own_files(self):
        own = json.dumps({"program": "gslam run", "seed": 3})
        for text, name in [(own, "mine.txt"), ("no JSON", "trajectory.txt"),
                           ('{"seed": 3}', "trajectory.txt")]:
            self.write("run.json", text)
            est = self.write(name, tum(stamps(600)))
            protocol = self.figures("--ref", self.ref, "--est", est)["protocol"]
            self.assertNotIn("run", protocol)
            self.assertEqual(protocol["poses_used"], "as in the file")

    def test_the_protocol_says_what_was_compared(self):
        self.write("run.json", json.dumps({"program": "gslam run", "slam": "some", "seed": 3}))
        est = self.write("trajectory.txt", tum(stamps(600)))
        protocol = self.figures("--ref", self.ref, "--est", est)["protocol"]
        self.assertEqual(protocol["reference"]["format"], "tum")
        self.assertEqual(protocol["estimate"]["poses"], 600)
        self.assertEqual(protocol["estimate"]["file"], str(est))
        self.assertEqual(protocol["poses_used"], "live, all")
        self.assertEqual(protocol["run"]["seed"], 3)
        self.assertEqual(protocol["alignment"], "se3")
        self.assertEqual(protocol["association"]["method"], "one-to-one")
        for name in ["machine", "units", "versions"]:
            self.assertIn(name, protocol)

    def test_scale_is_found(self):
        est = self.write("est.txt", tum(stamps(600), scale=0.25))
        result = self.figures("--ref", self.ref, "--est", est, "--align", "sim3")
        self.assertAlmostEqual(result["alignment"]["scale"], 4, places=6)
        self.assertLess(result["ape"]["translation"]["max"], 1e-6)
        self.assertEqual(result["score"]["value"], 1)

    def test_the_time_offset_is_found(self):
        est = self.write("est.txt", tum(stamps(900, 1 / 30), offset=-2.5))
        result = self.figures("--ref", self.ref, "--est", est, "--time-offset", "auto",
                              "--association", "interpolate")
        self.assertAlmostEqual(result["association"]["time_offset_s"], 2.5, places=3)
        result = self.figures("--ref", self.ref, "--est", est, "--time-offset", "2.5",
                              "--association", "interpolate")
        self.assertLess(result["ape"]["translation"]["max"], 0.01)

    def test_a_lost_part_shows(self):
        part = [t for t in stamps(600) if not 1010 < t < 1015]
        result = self.figures("--ref", self.ref, "--est", self.write("est.txt", tum(part)))
        self.assertEqual(result["coverage"]["losses"], 1)
        self.assertAlmostEqual(result["coverage"]["longest_loss_s"], 5, places=1)
        self.assertLess(result["coverage"]["time"], 0.85)
        self.assertLess(result["score"]["value"], 0.9)


class Text(EvalFolder):
    def test_has_the_coverage_beside_each_error(self):
        est = self.write("est.txt", tum(stamps(301)))
        result = self.check(evaluate("--ref", self.ref, "--est", est, "--align", "none", "--rpe",
                                     "1f", "--segments", "5"))
        errors = [line for line in result.stdout.splitlines()
                  if line.split(" ")[0] in ["APE", "RPE", "segments", "drift", "score"]]
        self.assertEqual(len(errors), 3 + 2 + 2 + 2)
        for line in errors:
            self.assertIn("50.2 %", line)

    def test_windows_line_ends_and_repeated_stamps(self):
        text = tum(stamps(600), end="\r\n")
        text += text.splitlines()[-1] + "\r\n"
        est = self.write("est.txt", text)
        self.check(evaluate("--ref", self.ref, "--est", est), out="1 more repeat a stamp")
        result = self.figures("--ref", self.ref, "--est", est)
        self.assertEqual(result["protocol"]["estimate"]["repeated_stamps"], 1)
        self.assertEqual(result["association"]["pairs"], 600)


class Formats(EvalFolder):
    def test_euroc(self):
        lines = ["#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z,v_x,v_y,v_z"]
        for t in stamps(600):
            x, y, z, heading = pose(t - 1000)
            lines.append(f"{round(t * 1e9)},{x:.9f},{y:.9f},{z:.9f},{math.cos(heading / 2):.12f},0,0,"
                         f"{math.sin(heading / 2):.12f},1,2,3")
        # Stamps of 1000 s are too small for nanoseconds since 1970: the format is said.
        ref = self.write("data.csv", "\n".join(lines) + "\n")
        result = self.figures("--ref", ref, "--ref-format", "euroc", "--est", self.ref, "--align",
                              "none")
        self.assertEqual(result["protocol"]["reference"]["format"], "euroc")
        self.assertEqual(result["association"]["pairs"], 600)
        self.assertLess(result["ape"]["translation"]["max"], 1e-6)
        self.assertLess(result["ape"]["rotation_deg"]["max"], 1e-5)

    def test_a_wrong_format_is_said(self):
        result = evaluate("--ref", self.ref, "--est", self.ref, "--est-format", "kitti")
        self.check(result, 1, err="ref.txt:2")
        result = evaluate("--ref", self.ref, "--est", self.ref, "--est-format", "map")
        self.check(result, 1, err="ref.txt")


class WrongUse(EvalFolder):
    def fails(self, *arguments, status=2, err):
        result = self.check(evaluate(*arguments), status, err=err)
        self.assertEqual(result.stdout, "")

    def test_options(self):
        files = ["--ref", self.ref, "--est", self.ref]
        self.fails("--est", self.ref, err="--ref: must be given")
        self.fails("--ref", self.ref, err="--est: must be given")
        self.fails(*files, "more", err="'more'")
        self.fails(*files, "--align", "sim4", err="--align")
        self.fails(*files, "--association", "nearest", err="one-to-one, interpolate or evo")
        self.fails(*files, "--rpe", "1x", err="10f:all")
        self.fails(*files, "--max-dt", "soon", err="--max-dt")
        self.fails(*files, "--max-dt", "-1", err="--max-dt")
        self.fails(*files, "--time-offset", "some", err="--time-offset")
        self.fails(*files, "--segments", "10,-5", err="--segments")
        self.fails(*files, "--ref-format", "xml", err="ref-format")
        self.fails(*files, "--cloud", self.ref, err="--ref-cloud")

    def test_files(self):
        ref = ["--ref", self.ref, "--est"]
        self.fails(*ref, self.folder / "none.txt", status=1, err="none.txt")
        self.fails(*ref, self.folder, status=1, err="folder")
        for name, text in [("empty", ""), ("nan", "0 0 0 nan 0 0 0 1\n"), ("words", "a b c\n"),
                           ("norm", "0 0 0 0 0 0 0 3\n"), ("short", "0 0 0 0\n")]:
            self.fails(*ref, self.write(name + ".txt", text), status=1, err=name + ".txt")
        self.fails(*ref, self.write("topics.bag", "#ROSBAG V2.0\n"), status=1, err="topics.bag")
        self.fails(*ref, self.write("no.bag", "no bag\n"), status=1, err="no.bag")

    def test_times_that_do_not_meet(self):
        later = self.write("later.txt", tum(stamps(600), offset=500))
        self.fails("--ref", self.ref, "--est", later, status=1, err="--time-offset auto")
        between = self.write("between.txt", tum(stamps(500), offset=0.02))
        self.fails("--ref", self.ref, "--est", between, status=1, err="--max-dt")

    def test_units_are_named(self):
        milli = self.write("milli.txt", tum(stamps(600), unit=1e3))
        self.fails("--ref", self.ref, "--est", milli, status=1, err="1e3 times larger")
        result = self.figures("--ref", self.ref, "--est", milli, "--est-stamps", "milliseconds")
        self.assertEqual(result["association"]["pairs"], 600)
        nano = self.write("nano.txt", tum(stamps(60, first=1.4e9), unit=1e9))
        self.fails("--ref", self.ref, "--est", nano, status=1, err="--est-stamps nanoseconds")

    def test_an_alignment_that_is_refused(self):
        lines = [f"{t} {t} 0 0 0 0 0 1" for t in range(60)]
        line = self.write("line.txt", "\n".join(lines) + "\n")
        result = self.check(evaluate("--ref", line, "--est", line, "--rpe", "1f", "--json"), 1,
                            err="lie on a line")
        self.assertIsNone(json.loads(result.stdout)["ape"])
        self.assertEqual(json.loads(result.stdout)["rpe"][0]["translation"]["max"], 0)
        self.check(evaluate("--ref", line, "--est", line, "--align", "origin"))

    def test_kitti_files_have_no_times(self):
        kitti = self.write("kitti.txt", "".join(
            f"1 0 0 {i} 0 1 0 {i * i / 50} 0 0 1 {math.sin(i)}\n" for i in range(50)))
        self.fails("--ref", self.ref, "--est", kitti, err="--times")
        self.fails("--ref", kitti, "--est", kitti, "--rpe", "1s", status=1, err="--times")
        self.fails("--ref", kitti, "--est", kitti, "--association", "interpolate", status=1,
                   err="number frames")
        times = self.write("times.txt", "".join(f"{0.1 * i:e}\n" for i in range(50)))
        result = self.figures("--ref", kitti, "--est", kitti, "--times", times, "--rpe", "1s")
        self.assertAlmostEqual(result["association"]["max_gap_s"], 0.1)
        self.assertEqual(result["rpe"][0]["translation"]["count"], 4)


class Plot(EvalFolder):
    def draw(self, est, *more, name="plot.png", **environment):
        """The picture's bytes, and what was printed."""
        picture = self.folder / name
        result = self.check(evaluate("--ref", self.ref, "--est", est, "--plot", picture, *more,
                                     **environment))
        return picture.read_bytes(), result.stdout

    def test_a_picture_of_each_trajectory(self):
        # Scaled, it does not fit by a rigid motion; a part is missing in the third.
        wrong = self.write("wrong.txt", tum(stamps(600), scale=0.9))
        part = self.write("part.txt", tum([t for t in stamps(600) if not 1010 < t < 1015]))
        pictures = [self.draw(est)[0] for est in [self.ref, wrong, part]]
        for picture in pictures:
            self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
            self.assertGreater(min(int.from_bytes(picture[i:i + 4], "big") for i in [16, 20]), 500)
        self.assertEqual(len(set(pictures)), 3)
        # The same again, in place of what was there.
        self.assertEqual(self.draw(self.ref)[0], pictures[0])

    def test_a_plot_in_letters(self):
        part = self.write("part.txt", tum([t for t in stamps(600) if not 1010 < t < 1015]))
        text = self.draw(part, LC_ALL="C")[1]
        self.assertTrue(text.isascii())
        rows = [line for line in text.splitlines() if line.startswith("|")]
        self.assertTrue(5 <= len(rows) <= 20)
        for row in rows:
            self.assertEqual(len(row), len(rows[0]))
            self.assertLessEqual(len(row), 62)
        drawn = "".join(rows)
        for letter in "#.SE":
            self.assertIn(letter, drawn)
        # What is not lost covers all of the truth.
        whole = self.draw(self.ref, LC_ALL="C")[1]
        self.assertNotIn(".", "".join(line for line in whole.splitlines() if line.startswith("|")))
        self.assertIn("x to the right: ", text)
        self.assertIn(f"plot         {self.folder / 'plot.png'}", text)
        dots = self.draw(part, LC_ALL="", LC_CTYPE="", LANG="C.UTF-8")[1]
        self.assertTrue(any("\u2800" < letter <= "\u28ff" for letter in dots))

    def test_looks_along_the_axis_with_the_least_way(self):
        for axes, names in [((0, 1), "xy"), ((0, 2), "xz"), ((1, 2), "yz")]:
            lines = []
            for t in range(100):
                position = [0.01 * math.sin(t)] * 3
                position[axes[0]] = 2 * math.sin(0.1 * t)
                position[axes[1]] = 5 * math.cos(0.1 * t)
                lines.append(f"{t} " + " ".join(f"{one:.6f}" for one in position) + " 0 0 0 1")
            self.ref = self.write("ref.txt", "\n".join(lines) + "\n")
            text = self.draw(self.ref)[1]
            self.assertIn(f"{names[0]} to the right: -2.00 to 2.00 m, {names[1]} up: -5.00 to 5.00 m",
                          text)

    def test_one_pose_and_poses_at_one_place(self):
        for count in [1, 50]:
            self.ref = self.write("ref.txt", "".join(f"{t} 1 2 3 0 0 0 1\n" for t in range(count)))
            picture, text = self.draw(self.ref, "--align", "none")
            self.assertEqual(picture[:4], b"\x89PNG")
            self.assertIn("S: start and end", text)

    def test_json_stays_json(self):
        json.loads(self.draw(self.ref, "--json")[1])

    def test_what_cannot_be_written(self):
        files = ["--ref", self.ref, "--est", self.ref, "--plot"]
        for name in ["plot.jpg", "plot"]:
            result = self.check(evaluate(*files, self.folder / name), 2, err="--plot")
            self.assertIn("such as plot.png", result.stderr)
            self.assertFalse((self.folder / name).exists())
        missing = self.folder / "none" / "plot.png"
        result = self.check(evaluate(*files, missing), 1, err="choose a file in a folder that is there")
        self.assertIn(str(missing), result.stderr)
        self.assertEqual(result.stdout, "")
        full = self.folder / "full.png"
        full.symlink_to("/dev/full")
        self.check(evaluate(*files, full), 1, err="No space left")

    def test_nothing_is_drawn_without_an_alignment(self):
        line = self.write("line.txt", "".join(f"{t} {t} 0 0 0 0 0 1\n" for t in range(60)))
        picture = self.folder / "plot.png"
        self.check(evaluate("--ref", line, "--est", line, "--plot", picture), 1, err="was not drawn")
        self.assertFalse(picture.exists())


class Clouds(EvalFolder):
    def ply(self, name, points):
        head = (f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\n"
                "property float y\nproperty float z\nend_header\n")
        return self.write(name, head + "".join("%g %g %g\n" % p for p in points))

    def test_distances_after_the_alignment_of_the_trajectory(self):
        wall = [(0.05 * i, 0.05 * j, 0) for i in range(40) for j in range(40)]
        cloud = self.ply("cloud.ply", [(x / 2, y / 2, 0.01) for x, y, _ in wall])
        est = self.write("est.txt", tum(stamps(600), scale=0.5))
        result = self.figures("--ref", self.ref, "--est", est, "--align", "sim3", "--cloud", cloud,
                              "--ref-cloud", self.ply("wall.ply", wall))
        self.assertAlmostEqual(result["cloud"]["distance"]["mean"], 0.02, places=5)
        self.assertEqual(result["cloud"]["completeness"], 1)


@unittest.skipUnless(DATA, "GSLAM_TEST_DATA names no folder")
class Real(EvalFolder):
    def test_evos_figures(self):
        folder = pathlib.Path(DATA) / "trajectories"
        reference = json.loads((folder / "evo_reference.json").read_text())
        for name, one in reference.items():
            case, evo = one["case"], one["evo"]
            arguments = ["--ref", folder / "evo" / case["ref"], "--est", folder / "evo" / case["est"],
                         "--association", "evo", "--align", case["align"]]
            if case["metric"] == "rpe":
                arguments += ["--rpe", f"{case['delta']}f" + (":all" if "all" in name else "")]
            result = self.figures(*arguments)
            errors = result["ape"] if case["metric"] == "ape" else result["rpe"][0]
            for figure, expected in evo.items():
                self.assertAlmostEqual(errors[case["relation"]][figure], expected,
                                       delta=1e-6 * abs(expected) + 1e-12, msg=f"{name} {figure}")

    def test_topics_of_ros_recordings(self):
        bags = pathlib.Path(DATA) / "bags"
        odometry = bags / "ros1" / "test2_jackal_imu_odom.bag"
        result = evaluate("--ref", odometry, "--est", odometry)
        if "built without datasets_ros" in result.stderr:
            self.skipTest(result.stderr)
        # The only topic with poses is found; to say it is the same.
        self.check(result, out="topic /jackal_velocity_controller/odom")
        files = ["--ref", odometry, "--est", odometry, "--est-topic",
                 "/jackal_velocity_controller/odom"]
        result = self.figures(*files)
        self.assertEqual(result["protocol"]["estimate"]["format"], "ros")
        self.assertEqual(result["protocol"]["estimate"]["topic"], files[-1])
        self.assertEqual(result["association"]["pairs"], result["protocol"]["reference"]["poses"])
        self.assertGreater(result["association"]["pairs"], 1000)
        self.assertLess(result["ape"]["translation"]["max"], 1e-9)

    def test_topics_that_have_to_be_said(self):
        bags = pathlib.Path(DATA) / "bags"
        several = bags / "ros1" / "example.bag"
        result = evaluate("--ref", self.ref, "--est", several)
        if "built without datasets_ros" in result.stderr:
            self.skipTest(result.stderr)
        self.check(result, 2, err="--est-topic: must be given")
        self.assertIn("/tf_static, /tf", result.stderr)
        self.check(evaluate("--ref", self.ref, "--est", several, "--est-topic", "/odom"), 1,
                   err="/tf_static")
        self.check(evaluate("--ref", self.ref, "--est", bags / "ros2" / "talker"), 1,
                   err="has no topic with poses; it has /rosout")
        self.check(evaluate("--ref", self.ref, "--est", self.ref, "--est-topic", "/odom"), 2,
                   err="--est-topic: is for ROS recordings")

    def test_kitti(self):
        folder = pathlib.Path(DATA) / "trajectories" / "evo"
        result = self.figures("--ref", folder / "KITTI_00_gt.txt", "--est",
                              folder / "KITTI_00_ORB.txt", "--align", "none", "--kitti")
        self.assertEqual(len(result["kitti"]["segments"]), 8)
        self.assertEqual(result["association"]["pairs"], 4541)
        self.assertIsNone(result["association"]["max_gap_s"])


if __name__ == "__main__":
    unittest.main()
