"""The command as its users know it: a process with arguments, output and an exit status.

The program is named by the environment variable GSLAM.
"""

import json
import os
import signal
import subprocess
import time
import unittest

from folder import Folder

GSLAM = os.environ["GSLAM"]
COMMANDS = ["run", "play", "info", "eval", "map", "vocabulary", "optimize", "plugins", "datasets",
            "config"]


def gslam(*arguments, timeout=60, **environment):
    return subprocess.run([GSLAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout, env={**os.environ, **environment})


class Help(Folder):
    def test_lists_all_commands(self):
        result = self.check(gslam("--help"))
        for command in COMMANDS:
            self.assertIn(f"\n  {command} ", result.stdout)

    def test_each_command_has_one(self):
        for command in COMMANDS:
            for arguments in [(command, "--help"), ("help", command)]:
                result = self.check(gslam(*arguments), out=f"gslam {command}")
                self.assertEqual(result.stderr, "")

    def test_version(self):
        self.check(gslam("--version"), out="gslam 1.")


class WrongUse(Folder):
    def test_no_command(self):
        self.check(gslam(), 2, err="usage: gslam COMMAND")

    def test_suggests_the_right_command(self):
        self.check(gslam("pluggins"), 2, err="did you mean plugins?")
        self.check(gslam("xyzzyx"), 2, err="no command 'xyzzyx'")

    def test_suggests_the_right_option(self):
        self.check(gslam("play", "--datset", "carousel"), 2, err="did you mean")

    def test_what_must_be_given(self):
        self.check(gslam("play"), 2, err="a dataset: must be given")
        self.check(gslam("run", "--dataset", "carousel", "--slam", "", "--out", self.folder), 2,
                   err="--slam")
        self.check(gslam("info"), 2, err="DATASET")
        self.check(gslam("map"), 2, err="info FILE")

    def test_too_many_words(self):
        self.check(gslam("info", "a", "b"), 2, err="'b'")
        self.check(gslam("datasets", "a"), 2, err="'a'")

    def test_options_are_named(self):
        run = ["play", "carousel", "-s", "dead_reckoning"]
        self.check(gslam(*run, "--set", "gravty=1"), 2, err="--set gravty")
        self.check(gslam(*run, "--param.gravty", 1), 2, err="--set gravty")
        self.check(gslam(*run, "--set", "gravity=nan"), 2, err="--set")
        self.check(gslam(*run, "--set", 5), 2, err="--set: expected NAME=VALUE, found '5'")
        self.check(gslam(*run, "--set"), 2, err="found nothing")
        self.check(gslam(*run, "--first", 9999), 2, err="--first")
        self.check(gslam("run", "carousel", "-s", "dead_reckoning", "-o", ""), 2, err="--out")

    def test_options_that_would_do_nothing(self):
        self.check(gslam("play", "carousel", "--set", "gravity=1"), 2, err="--slam")
        self.check(gslam("play", "carousel", "--isolate"), 2, err="--slam")
        self.check(gslam("play", "carousel", "-s", "dead_reckoning", "--timeout", 1), 2,
                   err="--timeout: needs --isolate")

    def test_values_out_of_range(self):
        self.check(gslam("play", "-d", "carousel", "--speed", "-1"), 2, err="speed")
        self.check(gslam("play", "-d", "carousel", "--mode", "fast"), 2, err="mode")


class Plugins(Folder):
    def test_lists_what_they_bring(self):
        result = self.check(gslam("plugins"), out="example 1.0.0")
        self.assertIn("dataset carousel", result.stdout)
        self.assertIn("SLAM dead_reckoning", result.stdout)
        self.assertIn("needs an IMU", result.stdout)
        self.assertRegex(result.stdout, r"radius = 2\.0 +of the circle, metres\n")

    def test_json(self):
        facts = json.loads(self.check(gslam("plugins", "--json")).stdout)
        example = next(p for p in facts["plugins"] if p["name"] == "example")
        self.assertEqual(example["slams"][0]["needs"]["imu"], True)
        self.assertEqual(example["datasets"][0]["parameters"]["radius"], 2.0)
        self.assertEqual(example["datasets"][0]["help"]["radius"], "of the circle, metres")

    def test_refused_ones_are_named_with_the_reason(self):
        (self.folder / "libgslam_broken.so").write_text("no library")
        result = self.check(gslam("plugins", GSLAM_PLUGIN_PATH=str(self.folder)))
        self.assertIn("libgslam_broken.so", result.stdout)
        self.assertIn("example 1.0.0", result.stdout)

    def test_a_missing_one_says_where_it_was_looked_for(self):
        result = gslam("play", "-d", "carousel", "-s", "dead_reckonin",
                       GSLAM_PLUGIN_PATH=str(self.folder))
        self.check(result, 1, err=str(self.folder))
        self.assertIn("dead_reckoning", result.stderr)

    def test_datasets(self):
        self.check(gslam("datasets"), out="carousel")
        names = [one["name"] for one in json.loads(gslam("datasets", "--json").stdout)]
        for name in ["carousel", "kitti", "tum", "euroc", "cvmono", "folder", "synthetic"]:
            self.assertIn(name, names)


class Info(Folder):
    def test_says_what_there_is(self):
        result = self.check(gslam("info", "carousel"), out="front")
        for word in ["pinhole 320 x 240", "200 Hz", "ground truth 201 poses"]:
            self.assertIn(word, result.stdout)

    def test_json(self):
        facts = json.loads(
            self.check(gslam("info", "carousel", "--dataset-param.radius", 3, "--json")).stdout)
        self.assertEqual(facts["frames"], 201)
        # Chords of a circle, so a little less.
        self.assertAlmostEqual(facts["ground_truth"]["length_m"], 2 * 3.14159265 * 3, delta=0.01)

    def test_checks_what_it_reads(self):
        self.check(gslam("info", "--check", "carousel"), out="nothing is wrong with it")
        check = json.loads(self.check(gslam("info", "--check", "carousel", "--json")).stdout)["check"]
        self.assertEqual((check["frames"], check["errors"]), (201, []))

    def test_says_what_cannot_be_read(self):
        world = "synthetic://room?sensors=mono&frames=4&width=160&height=120"
        self.check(gslam("play", world, "--save", self.folder / "seq", "--as", "kitti"))
        sequence = self.folder / "seq" / "sequences" / "00"
        image = sequence / "image_0" / "000002.png"
        image.write_bytes(image.read_bytes()[:500])
        result = self.check(gslam("info", "--check", sequence), 1, out="format       kitti")
        self.assertIn("000002.png): cannot be read: ends early", result.stdout)
        result = self.check(gslam("info", "--format", "cvmono", sequence / "image_0"))
        self.assertIn("format       cvmono", result.stdout)
        self.check(gslam("info", "--format", "kiti", sequence), 1, err="kitti")

    def test_unknown_datasets(self):
        self.check(gslam("info", "carusel"), 1, err="carousel")
        self.check(gslam("info", self.folder), 1, err=str(self.folder))

    def test_wrong_parameters(self):
        self.check(gslam("info", "carousel", "--dataset-param.radios", 3), 2, err="radius")
        self.check(gslam("info", "carousel", "--dataset-param.radius", -3), 1, err="-3")
        self.check(gslam("info", "carousel", "--dataset-param.radius", "wide"), 2,
                   err="expected double")
        self.check(gslam("info", "carousel:/nowhere"), 1, err="the name alone")


def error_at_the_end(text):
    x, y, z = map(float, text.strip().splitlines()[-1].split()[1:4])
    return (x * x + y * y) ** 0.5  # once around: back where it began


class Run(Folder):
    def test_from_dataset_to_trajectory(self):
        out = self.folder / "a" / "b"
        self.check(gslam("run", "-d", "carousel", "-s", "dead_reckoning", "-o", out),
                   out="poses: 201 of 201 frames")
        lines = (out / "trajectory.txt").read_text().strip().splitlines()
        poses = [line for line in lines if not line.startswith("#")]
        self.assertEqual(len(poses), 201)
        self.assertTrue(all(len(pose.split()) == 8 for pose in poses))
        self.assertLess(error_at_the_end("\n".join(poses)), 0.05)
        report = json.loads((out / "run.json").read_text())
        self.assertEqual(report["slam"]["name"], "dead_reckoning")
        self.assertEqual(report["result"]["end"], "finished")

    def test_results_of_two_runs_do_not_mix(self):
        out = self.folder / "out"
        run = ["run", "carousel", "-s", "dead_reckoning", "-o", out, "--count", 3]
        self.check(gslam(*run))
        (out / "map.gmap").write_text("of a run before")
        self.check(gslam(*run))
        self.assertEqual(sorted(path.name for path in out.iterdir()),
                         ["frames.csv", "groundtruth.txt", "metrics.json", "run.json",
                          "trajectory.txt", "trajectory_final.txt"])

    def test_the_protocol_says_what_ran(self):
        out = self.folder / "out"
        self.check(gslam("run", "carousel", "-s", "dead_reckoning", "-o", out, "--count", 3))
        report = json.loads((out / "run.json").read_text())
        self.assertEqual(report["dataset"]["parameters"]["radius"], 2.0)
        self.assertEqual(report["slam"]["plugin"]["version"], "1.0.0")
        self.assertEqual(report["count"], 3)

    def test_the_parameters_count(self):
        out = self.folder / "out"
        self.check(gslam("run", "-d", "carousel", "-s", "dead_reckoning", "-o", out,
                         "--set", "gravity=9.7"))
        self.assertEqual(json.loads((out / "run.json").read_text())["slam"]["parameters"],
                         {"gravity": 9.7})
        z = float((out / "trajectory.txt").read_text().strip().splitlines()[-1].split()[3])
        self.assertAlmostEqual(z, 0.5 * 0.11 * 10 ** 2, delta=0.1)

    def test_isolated_is_the_same(self):
        texts = []
        for options in [[], ["--isolate"]]:
            out = self.folder / str(len(texts))
            self.check(gslam("run", "-d", "carousel", "-s", "dead_reckoning", "-o", out, *options))
            texts.append((out / "trajectory.txt").read_text())
        self.assertEqual(texts[0], texts[1])

    def test_an_application_runs_beside(self):
        result = self.check(gslam("play", "carousel", "-s", "dead_reckoning", "-a", "pose_printer",
                                  "--application-param.every", 100))
        self.assertIn("/dead_reckoning/pose 100 ", result.stderr)
        self.check(gslam("play", "carousel", "-a", "pose_printe"), 1, err="pose_printer")

    def test_a_part(self):
        report = json.loads(gslam("play", "-d", "carousel", "-s", "dead_reckoning", "--first", 10,
                                  "--count", 20, "--json").stdout)
        self.assertEqual((report["frames"], report["last_frame"]), (20, 29))

    def test_a_config_file(self):
        path = self.folder / "my.json"
        path.write_text(self.check(gslam("config", "-s", "dead_reckoning", "-d", "carousel")).stdout)
        config = json.loads(path.read_text())
        self.assertEqual(config["set"], {"gravity": 9.81})
        config["dataset-param"]["duration"] = 2.0
        path.write_text(json.dumps(config))
        report = json.loads(gslam("play", "-d", "carousel", "-s", "dead_reckoning", "--config", path,
                                  "--json").stdout)
        self.assertEqual(report["frames"], 41)

    def test_a_folder_that_cannot_be(self):
        file = self.folder / "file"
        file.write_text("")
        self.check(gslam("run", "-d", "carousel", "-s", "dead_reckoning", "-o", file / "x"), 1,
                   err=str(file))
        self.check(gslam("run", "-d", "carousel", "-s", "dead_reckoning", "-o", file), 1,
                   err="is no folder")

    def test_quiet_without_a_terminal(self):
        result = self.check(gslam("play", "-d", "carousel"))
        self.assertEqual(result.stderr, "")
        self.assertNotIn("\r", result.stdout)


class Save(Folder):
    world = "synthetic://corridor?frames=5"

    def test_as_a_public_dataset(self):
        for layout in ["tum", "euroc", "kitti"]:
            out = self.folder / layout
            result = gslam("play", self.world, "--save", out, "--as", layout)
            if result.returncode != 0:  # a world of one kind is not for all layouts
                self.assertIn(layout, result.stderr)
                self.assertFalse(out.exists())
                continue
            self.assertIn("saved: 5 frames", result.stdout)
            self.assertGreaterEqual(len(list(out.rglob("*.png"))), 5)
            self.check(gslam("play", self.world, "--save", out, "--as", layout), 1, err=str(out))
            result = self.check(gslam("info", "--check", out), out=f"format       {layout}")
            self.assertIn("checked 5 frames", result.stdout)

    def test_contact_sheet(self):
        sheet = self.folder / "sheet.png"
        self.check(gslam("play", self.world, "--contact-sheet", sheet))
        self.assertEqual(sheet.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_unknown_layout(self):
        self.check(gslam("play", self.world, "--save", self.folder / "x", "--as", "tun"), 2, err="tum")


class Interrupts(Folder):
    def start(self, *arguments):
        process = subprocess.Popen(
            [GSLAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, start_new_session=True)
        self.addCleanup(process.kill)
        return process

    @staticmethod
    def wait_until(condition):
        for _ in range(600):
            if condition():
                return
            time.sleep(0.1)
        raise TimeoutError("nothing happened for a minute")

    def test_ctrl_c_keeps_the_results(self):
        for options in [[], ["--isolate"]]:
            out = self.folder / f"out{len(options)}"
            process = self.start("run", "-d", "carousel", "-s", "dead_reckoning", "-o", out,
                                 "--mode", "real-time", *options)
            self.wait_until((out / "frames.csv").exists)  # from here on it plays, for 10 s
            time.sleep(1)
            os.killpg(process.pid, signal.SIGINT)  # as a terminal does: the whole group
            stdout, stderr = process.communicate(timeout=30)
            self.assertEqual(process.returncode, 130, stdout + stderr)
            self.assertIn("stopped", stdout)
            report = json.loads((out / "run.json").read_text())
            self.assertEqual(report["result"]["end"], "stopped")
            self.assertGreater(report["result"]["poses"], 0)
            poses = (out / "trajectory.txt").read_text().strip().splitlines()
            self.assertGreaterEqual(len(poses), report["result"]["poses"])


class Map(Folder):
    def test_files_that_are_no_maps(self):
        self.check(gslam("map", "info", self.folder / "none.gmap"), 1, err="none.gmap")
        bad = self.folder / "bad.gmap"
        bad.write_bytes(b"GSLAM" * 100)
        self.check(gslam("map", "info", bad), 1, err="bad.gmap")


if __name__ == "__main__":
    unittest.main()
