"""`gslam run` measured with a SLAM system whose errors, cost and faults are known: slam_replay.

The program is named by the environment variable GSLAM, the folder of real data by GSLAM_TEST_DATA.
Times are compared in one direction only, since the machine may be busy.
"""

import csv
import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

GSLAM = os.environ["GSLAM"]
DATA = os.environ.get("GSLAM_TEST_DATA")
SHORT = ["carousel", "--dataset-param.duration", 2]  # 41 frames in 2 s
FRAMES = 41


def gslam(*arguments, timeout=60, **environment):
    return subprocess.run([GSLAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout, env={**os.environ, **environment})


def wait_until(condition):
    for _ in range(600):
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise TimeoutError("nothing happened for half a minute")


def worker_of(process):
    """Number of the process that runs for a `gslam run`."""
    path = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
    children = path.read_text().split()
    return int(children[0]) if children else None


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.truths = {}
        for name, arguments in {"short": SHORT, "long": ["carousel"]}.items():
            path = pathlib.Path(folder.name) / f"{name}.txt"
            made = gslam("info", *arguments, "--ground-truth", path)
            assert made.returncode == 0, made.stderr
            cls.truths[name] = path

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out"

    def arguments(self, *settings, options=(), dataset=SHORT, truth="short"):
        settings = [f"trajectory={self.truths.get(truth, truth)}", *settings]
        return ["run", *dataset, "--slam", "replay", "--out", self.out, *options, "--set", *settings]

    def run_it(self, *settings, status=0, err="", environment={}, **more):
        """Runs, and gives metrics.json."""
        result = gslam(*self.arguments(*settings, **more), **environment)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        self.assertIn(err, result.stderr)
        self.stdout = result.stdout
        return self.json("metrics.json")

    def json(self, name):
        return json.loads((self.out / name).read_text())

    def frames(self):
        with open(self.out / "frames.csv", newline="") as file:
            return list(csv.DictReader(file))

    def poses(self, name="trajectory.txt"):
        lines = (self.out / name).read_text().splitlines()
        return [line for line in lines if line and not line.startswith("#")]


class Visual(Runs):
    ROOM = "synthetic://room?frames=60&width=320&height=240"

    def test_is_what_runs_unless_another_is_named(self):
        result = gslam("run", self.ROOM, "--out", self.out, "--set", "features=500")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        metrics = self.json("metrics.json")
        self.assertEqual(metrics["coverage"]["frames"], 1)
        self.assertLess(metrics["ape"]["translation"]["rmse"], 0.05)
        self.assertEqual(self.json("run.json")["slam"]["name"], "visual")
        self.assertTrue((self.out / "map.gmap").exists())

    def test_says_what_is_wrong_with_a_parameter(self):
        result = gslam("run", self.ROOM, "--out", self.out, "--set", "sensor=sonar")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("sensor is 'sonar', expected one of auto, mono, stereo, rgbd", result.stderr)

    def test_says_what_a_dataset_lacks(self):
        result = gslam("run", self.ROOM + "&sensors=mono", "--out", self.out, "--set", "sensor=rgbd")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("depth", result.stderr)


class Accuracy(Runs):
    def test_noise_is_the_error(self):
        metrics = self.run_it("noise_m=0.05", "noise_deg=2", dataset=["carousel"], truth="long",
                              options=["--align", "none"])
        # 201 poses: the root mean square is off by 3 % of itself (one sigma).
        for kind, sigma in [("translation", 0.05), ("rotation_deg", 2)]:
            rmse = metrics["ape"][kind]["rmse"]
            self.assertAlmostEqual(rmse, sigma * math.sqrt(3), delta=0.12 * sigma * math.sqrt(3))
        self.assertEqual(metrics["association"]["pairs"], 201)
        self.assertEqual(metrics["coverage"]["frames"], 1)

    def test_without_noise_there_is_no_error(self):
        metrics = self.run_it(options=["--align", "none", "--rpe", "1f", "--rpe", "1m"])
        self.assertLess(metrics["ape"]["translation"]["max"], 1e-9)
        self.assertEqual([one["delta"] for one in metrics["rpe"]], ["1f", "1m"])
        self.assertEqual(metrics["score"]["value"], 1)

    def test_the_seed_counts(self):
        errors = [self.run_it("noise_m=0.1", f"seed={seed}")["ape"]["translation"]["rmse"]
                  for seed in [1, 1, 2]]
        self.assertEqual(errors[0], errors[1])
        self.assertNotEqual(errors[0], errors[2])
        self.assertEqual(self.json("run.json")["seed"], 2)

    def test_scale_is_found_by_sim3(self):
        metrics = self.run_it("scale=0.25", options=["--align", "sim3"])
        self.assertAlmostEqual(metrics["alignment"]["scale"], 4, places=9)
        self.assertLess(metrics["ape"]["translation"]["max"], 1e-9)

    def test_drift_is_found_over_parts_of_the_way(self):
        metrics = self.run_it("drift_percent=2", options=["--segments", "2"])
        self.assertAlmostEqual(metrics["segments"][0]["translation_percent"]["mean"], 2, delta=0.05)
        metrics = self.run_it("drift_deg_per_m=0.5", options=["--segments", "2"], truth="long",
                              dataset=["carousel"])
        self.assertAlmostEqual(metrics["segments"][0]["rotation_deg_per_m"]["mean"], 0.5, delta=0.01)

    def test_final_poses_are_measured_beside_the_live_ones(self):
        metrics = self.run_it("noise_m=0.1", "corrects=true", options=["--align", "none"])
        self.assertGreater(metrics["ape"]["translation"]["rmse"], 0.1)
        self.assertLess(metrics["final"]["ape"]["translation"]["rmse"], 1e-9)
        self.assertEqual(metrics["final"]["poses_used"], "final, all")
        self.assertEqual({frame["corrections"] for frame in self.frames()}, {"1"})
        self.assertEqual(len(self.poses("trajectory_final.txt")), FRAMES)

    def test_final_poses_of_a_map(self):
        metrics = self.run_it("noise_m=0.1", "keyframe_every=4", options=["--align", "none"])
        self.assertLess(metrics["final"]["ape"]["translation"]["rmse"], 1e-9)
        self.assertEqual(metrics["final"]["poses_used"], "final, keyframes")
        self.assertIn("keyframes", self.json("run.json")["poses"]["final"])
        facts = json.loads(gslam("map", "info", self.out / "map.gmap", "--json").stdout)
        self.assertEqual((facts["keyframes"], facts["points"]), (11, 11))
        result = gslam("eval", "--ref", self.out / "groundtruth.txt", "--est", self.out / "map.gmap",
                       "--json")
        self.assertEqual(json.loads(result.stdout)["association"]["pairs"], 11)

    def test_eval_says_the_same_of_the_files(self):
        metrics = self.run_it("noise_m=0.1")
        result = gslam("eval", "--ref", self.out / "groundtruth.txt", "--est",
                       self.out / "trajectory.txt", "--json")
        self.assertEqual(json.loads(result.stdout)["ape"], metrics["ape"])

    def test_no_ground_truth(self):
        seen = self.out.parent / "seen"
        made = gslam("play", "synthetic://room?frames=6&width=64&height=48", "--save", seen)
        self.assertEqual(made.returncode, 0, made.stderr)
        images = seen / "rgb"
        metrics = self.run_it(dataset=["--format", "cvmono", images])
        self.assertIsNone(metrics["ape"])
        self.assertIn("no ground truth", metrics["reason"])
        self.assertEqual(metrics["coverage"]["total_frames"], 6)
        self.assertEqual(metrics["cost"]["frames"]["results"], 6)
        self.assertIn("no ground truth", self.stdout)
        self.assertFalse((self.out / "groundtruth.txt").exists())


class BadManners(Runs):
    def test_poses_that_are_not_finite_are_lost(self):
        metrics = self.run_it("losses=10-19:nan")
        self.assertEqual(metrics["coverage"]["tracked_frames"], FRAMES - 10)
        self.assertEqual(metrics["association"]["pairs"], FRAMES - 10)
        self.assertEqual(self.json("run.json")["result"]["invalid_poses"], 10)
        self.assertEqual([frame["state"] for frame in self.frames()].count("lost"), 10)
        self.assertIn("not finite, or of no frame that was fed: 10", self.stdout)
        self.run_it("losses=10-19:nan", "fault=abort", "fault_at=25", status=1)
        self.assertEqual(self.json("run.json")["result"]["invalid_poses"], 10)

    def test_poses_of_no_frame_count_for_nothing(self):
        fair = self.run_it("noise_m=0.1")
        more = self.run_it("noise_m=0.1", "strays=20")
        self.assertEqual(len(self.poses()), FRAMES)
        self.assertEqual(len(self.poses("trajectory_final.txt")), FRAMES)
        for part in ["score", "ape", "coverage"]:
            self.assertEqual(more[part], fair[part])
        result = self.json("run.json")["result"]
        self.assertEqual((result["poses"], result["invalid_poses"]), (FRAMES, 20 * FRAMES))

    def test_a_pose_has_the_stamp_of_its_frame(self):
        fair = self.run_it("noise_m=0.1")
        wrong = self.run_it("noise_m=0.1", "stamp_error_s=-0.7")
        self.assertEqual(wrong["ape"], fair["ape"])
        self.assertEqual(wrong["final"]["ape"], fair["final"]["ape"])
        self.assertEqual(self.json("run.json")["result"]["wrong_stamps"], FRAMES)

    def test_no_answer_of_another_thread_is_lost(self):
        for latency in [0.001, 0.005, 0.02]:
            with self.subTest(latency):
                metrics = self.run_it("cpu_ms=1", f"latency_ms={latency}")
                self.assertEqual(metrics["coverage"]["tracked_frames"], FRAMES)
                self.assertEqual(len(self.poses()), FRAMES)


class Folders(Runs):
    """What `gslam run` did not write stays."""

    def test_a_folder_with_other_files_is_refused(self):
        self.out.mkdir()
        truth = self.out / "groundtruth.txt"
        truth.write_text("precious")
        for options in [[], ["--repeat", 2]]:
            result = gslam(*self.arguments(options=options))
            self.assertEqual((result.returncode, result.stdout), (1, ""))
            self.assertIn("has 'groundtruth.txt', but no run.json of `gslam run`", result.stderr)
        self.assertEqual([path.name for path in self.out.iterdir()], ["groundtruth.txt"])
        self.assertEqual(truth.read_text(), "precious")
        # A run.json of another program changes nothing.
        for text in ['{"slam": "x"}', "no JSON", "[]", '{"program": 1}']:
            (self.out / "run.json").write_text(text)
            self.assertEqual(gslam(*self.arguments()).returncode, 1)
            self.assertEqual((self.out / "run.json").read_text(), text)
            self.assertEqual(truth.read_text(), "precious")

    def test_other_files_beside_results_stay(self):
        self.run_it(options=["--repeat", 2])
        notes = [self.out / "notes.txt", self.out / "2" / "notes.txt"]
        for path in notes:
            path.write_text("precious")
        foreign = self.out / "3" / "1"
        foreign.mkdir(parents=True)
        (foreign / "map.gmap").write_text("precious")
        (self.out / "3" / "frames.csv").write_text("precious")
        result = gslam(*self.arguments(options=["--repeat", 3]))
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertTrue((self.out / "2" / "metrics.json").exists())  # nothing was begun
        self.run_it()
        self.assertEqual(sorted(path.name for path in (self.out / "2").iterdir()), ["notes.txt"])
        for path in [*notes, foreign / "map.gmap", self.out / "3" / "frames.csv"]:
            self.assertEqual(path.read_text(), "precious")
        self.assertFalse((self.out / "1").exists())

    def test_the_dataset_is_no_folder_for_results(self):
        data = self.out.parent / "data"
        made = gslam("play", "synthetic://room?frames=3&width=64&height=48", "--save", data)
        self.assertEqual(made.returncode, 0, made.stderr)
        before = {path: path.read_bytes() for path in data.rglob("*") if path.is_file()}
        for mark in [False, True]:
            if mark:
                (data / "run.json").write_text('{"program": "gslam run"}')
            result = gslam("run", data, "--slam", "replay", "--out", data, "--set",
                           f"trajectory={self.truths['short']}")
            self.assertNotEqual(result.returncode, 0)
            self.assertIn("run.json of" if not mark else "--out: is the dataset", result.stderr)
            for path, content in before.items():
                self.assertEqual(path.read_bytes(), content)

    def test_a_run_that_was_killed_leaves_a_folder_that_can_be_used(self):
        for options in [[], ["--repeat", 2]]:
            with self.subTest(options):
                shutil.rmtree(self.out, ignore_errors=True)
                process = subprocess.Popen(
                    [GSLAM, *map(str, self.arguments("delay_ms=100", options=options))],
                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                self.addCleanup(process.kill)
                path = self.out / "1" / "frames.csv" if options else self.out / "frames.csv"
                wait_until(path.exists)
                worker = worker_of(process)
                process.kill()
                process.wait(30)
                wait_until(lambda: not pathlib.Path(f"/proc/{worker}").exists())
                self.run_it(options=options)


class Making(Runs):
    """What fails before the first call: GSLAM_REPLAY_FAULT is for the constructor."""

    def check(self, fault, options, text):
        self.run_it()  # whose results are not to stay
        metrics = self.run_it(options=options, status=1, err=text,
                              environment={"GSLAM_REPLAY_FAULT": fault})
        result = self.json("run.json")["result"]
        self.assertEqual(result["end"], "failed")
        self.assertIn(text, result["failure"])
        self.assertEqual(metrics["coverage"]["total_frames"], FRAMES)
        self.assertEqual(metrics["coverage"]["frames"], 0)
        self.assertEqual(metrics["score"]["value"], 0)
        self.assertNotIn("no ground truth", metrics["reason"])
        self.assertFalse((self.out / "trajectory.txt").exists())
        return result["cause"]

    def test_a_constructor_fails(self):
        for fault, cause, text in [("exit", "exit", "with status 7"), ("abort", "signal", "SIGABRT"),
                                   ("throw", "exception", "as 'fault' asks for")]:
            for options in [[], ["--json"]]:
                with self.subTest(fault=fault, options=options):
                    self.assertEqual(self.check(fault, options, text), cause)
        self.assertEqual(self.check("abort", ["--isolate"], "SIGABRT"), "signal")

    def test_a_constructor_hangs(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                self.assertEqual(self.check("hang", ["--timeout", 1, *options], "within 1000 ms"),
                                 "timeout")

    def test_repeats_count_it(self):
        summary = self.run_it(options=["--repeat", 2], status=1, err="SIGABRT",
                              environment={"GSLAM_REPLAY_FAULT": "abort"})
        self.assertEqual(summary["coverage"]["frames"]["mean"], 0)
        self.assertEqual(summary["score"]["value"]["count"], 2)


class Coverage(Runs):
    def test_losses_count(self):
        metrics = self.run_it("losses=5-9,20-24:none,30-31:guessed")
        self.assertEqual(metrics["coverage"]["tracked_frames"], FRAMES - 12)
        self.assertEqual(metrics["coverage"]["losses"], 3)
        self.assertEqual(len(self.poses()), FRAMES - 10)  # guessed ones are poses
        states = [frame["state"] for frame in self.frames()]
        self.assertEqual([states.count(s) for s in ["lost", "", "guessed", "tracking"]],
                         [5, 5, 2, FRAMES - 12])

    def test_a_late_start(self):
        metrics = self.run_it("start_after=10")
        self.assertEqual(metrics["coverage"]["tracked_frames"], FRAMES - 10)
        self.assertAlmostEqual(metrics["coverage"]["time_to_initialise_s"], 0.5)
        self.assertEqual(self.frames()[9]["state"], "starting")

    def test_nothing_tracked_scores_nothing(self):
        metrics = self.run_it("losses=0-1000")
        self.assertIsNone(metrics["ape"])
        self.assertEqual(metrics["score"]["value"], 0)
        self.assertEqual(metrics["coverage"]["frames"], 0)
        self.assertEqual(metrics["reason"], "there are no poses")

    def test_frames_that_cannot_be_read(self):
        seen = self.out.parent / "seen"
        made = gslam("play", "synthetic://room?frames=6&width=64&height=48", "--save", seen)
        self.assertEqual(made.returncode, 0, made.stderr)
        image = sorted((seen / "rgb").glob("*.png"))[2]
        image.write_bytes(image.read_bytes()[:100])
        self.run_it(dataset=["--format", "cvmono", seen / "rgb"])
        self.assertEqual(self.json("run.json")["result"]["unreadable"], 1)
        frames = self.frames()
        self.assertEqual(len(frames), 6)
        unreadable = [frame for frame in frames if frame["unreadable"] == "1"]
        self.assertEqual([frame["frame"] for frame in unreadable], [""])

    def test_real_time_drops_what_comes_too_early(self):
        metrics = self.run_it("delay_ms=170", options=["--mode", "real-time"])
        frames = self.frames()
        dropped = [frame for frame in frames if frame["dropped"] == "1"]
        self.assertEqual([int(frame["frame"]) for frame in frames], list(range(FRAMES)))
        self.assertGreaterEqual(len(dropped), 20)  # at most one of three has its turn
        self.assertEqual(self.json("run.json")["result"]["dropped"], len(dropped))
        self.assertEqual(metrics["coverage"]["tracked_frames"], FRAMES - len(dropped))
        self.assertEqual(metrics["coverage"]["total_frames"], FRAMES)
        self.assertEqual(metrics["cost"]["frames"]["dropped"], len(dropped))


class Cost(Runs):
    def test_delay_is_frame_time(self):
        metrics = self.run_it("delay_ms=15")
        self.assertGreaterEqual(metrics["cost"]["frame_ms"]["min"], 15)
        self.assertLess(metrics["cost"]["cpu_ms"]["median"], 15)  # sleep is no work

    def test_an_answer_that_comes_later(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                metrics = self.run_it("latency_ms=40", options=options)
                self.assertGreaterEqual(metrics["cost"]["frame_ms"]["min"], 40)
                self.assertEqual(metrics["coverage"]["frames"], 1)
                self.assertEqual(len(self.frames()), FRAMES)

    def test_allocations_are_exact(self):
        counts = []
        for number in [0, 1000]:
            self.run_it(f"allocations={number}", "allocation_bytes=100")
            counts.append(sorted(int(frame["allocations"]) for frame in self.frames())[FRAMES // 2])
        self.assertEqual(counts[1] - counts[0], 1000)
        self.assertLess(counts[0], 10)  # of the recording
        self.run_it("allocations=1000", options=["--isolate"])
        alone = sorted(int(frame["allocations"]) for frame in self.frames())[FRAMES // 2]
        self.assertGreaterEqual(alone, 1000)
        self.assertLess(alone, 1100)

    def test_memory_grows(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                peaks = [self.run_it(f"grow_mb={mb}", options=options)["cost"]["peak_rss_mb"]
                         for mb in [0, 3]]
                self.assertGreater(peaks[1] - peaks[0], 3 * FRAMES - 5)
                self.assertLess(peaks[1] - peaks[0], 3 * FRAMES + 30)

    def test_cpu_of_two_threads(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                cost = self.run_it("cpu_ms=10", "cpu_threads=2", options=options)["cost"]
                self.assertGreaterEqual(cost["cpu_ms"]["min"], 19)
                self.assertLess(cost["cpu_ms"]["median"], 40)
                self.assertGreaterEqual(cost["cpu_s"], 0.019 * FRAMES)
                self.assertGreater(cost["cpu_percent"], 5)

    def test_what_was_measured_is_said(self):
        self.assertEqual(self.run_it()["cost"]["measured"], "process")
        self.assertEqual(self.run_it(options=["--isolate"])["cost"]["measured"], "slam")


class Failures(Runs):
    def check_partial(self, metrics, frames):
        """Of a run that failed at frame number `frames`."""
        result = self.json("run.json")["result"]
        self.assertEqual(result["end"], "failed")
        self.assertEqual(result["last_frame"], frames)
        self.assertEqual(len(self.poses()), frames)
        # What it did not come to counts as lost.
        self.assertEqual(metrics["coverage"]["tracked_frames"], frames)
        self.assertEqual(metrics["coverage"]["total_frames"], FRAMES)
        self.assertIsNotNone(metrics["ape"])
        self.assertEqual(metrics["cost"]["frames"]["results"], frames)
        self.assertEqual(metrics["protocol"]["run"]["result"], result)
        return result

    def test_crashes_of_each_kind(self):
        for fault, cause, text in [("signal", "signal", "SIGSEGV"), ("abort", "signal", "SIGABRT"),
                                   ("exit", "exit", "status 7"),
                                   ("throw", "exception", "as 'fault' asks for")]:
            for options in [[], ["--isolate"]]:
                with self.subTest(fault=fault, options=options):
                    metrics = self.run_it(f"fault={fault}", "fault_at=20", options=options, status=1,
                                          err=text)
                    result = self.check_partial(metrics, 20)
                    self.assertEqual(result["cause"], cause)
                    if fault != "throw":
                        self.assertIn("in feed() of frame 20", result["failure"])

    def test_the_reason_is_on_stderr_beside_json(self):
        result = gslam(*self.arguments("fault=signal", "fault_at=5", options=["--json"]))
        self.assertEqual(result.returncode, 1)
        self.assertIn("SIGSEGV", result.stderr)
        self.assertEqual(json.loads(result.stdout), self.json("metrics.json"))
        result = gslam(*self.arguments("fault=signal", "fault_at=5",
                                       options=["--json", "--repeat", 2]))
        self.assertEqual(result.stderr.count("SIGSEGV"), 2)
        self.assertEqual(json.loads(result.stdout), self.json("metrics.json"))

    def test_cost_up_to_a_crash(self):
        cost = self.run_it("cpu_ms=10", "fault=abort", "fault_at=5", status=1)["cost"]
        self.assertGreaterEqual(cost["cpu_s"], 0.04)  # counted in ticks of 10 ms

    def test_hangs(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                metrics = self.run_it("fault=hang", "fault_at=20",
                                      options=["--timeout", 1, *options], status=1,
                                      err="within 1000 ms in feed() of frame 20")
                self.assertEqual(self.check_partial(metrics, 20)["cause"], "timeout")

    def test_hangs_before_and_after_the_frames(self):
        self.run_it("fault=hang", "fault_in=configure", options=["--timeout", 1], status=1,
                    err="in configure()")
        self.assertEqual(self.json("metrics.json")["coverage"]["frames"], 0)
        metrics = self.run_it("fault=hang", "fault_in=finish", options=["--timeout", 1], status=1,
                              err="in finish()")
        self.assertEqual(metrics["coverage"]["frames"], 1)  # all frames were tracked
        self.assertEqual(len(self.poses()), FRAMES)

    def test_crash_in_configure(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                metrics = self.run_it("fault=abort", "fault_in=configure", options=options, status=1,
                                      err="in configure()")
                self.assertEqual(metrics["coverage"]["frames"], 0)
                self.assertEqual(metrics["coverage"]["total_frames"], FRAMES)

    def test_more_memory_than_allowed(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                self.run_it("grow_mb=100", options=["--memory", "1G", *options], status=1)
                report = self.json("run.json")
                self.assertEqual(report["result"]["cause"], "memory")
                self.assertLess(report["result"]["last_frame"], 12)
                self.assertEqual(report["limits"]["memory_bytes"], 2 ** 30)
                self.assertIn("1.00 GiB", report["limits"]["memory_by"])

    def test_wrong_parameters_of_the_system(self):
        self.run_it("losses=9-5", status=1, err="losses has '9-5', expected intervals")
        self.run_it("noise_m=-1", status=1, err="noise_m is -1")
        self.run_it("fault=sleep", status=1, err="signal, abort, exit")
        self.run_it(truth="/nowhere/gt.txt", status=1, err="/nowhere/gt.txt")

    def test_what_cannot_begin_leaves_the_old_results(self):
        self.run_it()
        before = self.json("metrics.json")
        for more, err in [(["--count", "x"], "count"), (["--cpus", "0-"], "--cpus"),
                          (["--cpus", "1023"], "--cpus: is '1023'"),
                          (["--memory", "much"], "--memory"), (["--align", "sim4"], "--align")]:
            result = gslam(*self.arguments(options=more))
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(err, result.stderr)
        result = gslam("run", "nodata", "-s", "replay", "-o", self.out)
        self.assertEqual((result.returncode, result.stdout), (1, ""))
        self.assertEqual(self.json("metrics.json"), before)


class Protocol(Runs):
    def test_says_what_ran_where(self):
        self.run_it("noise_m=0.1", "seed=5", options=["--align", "sim3"])
        report = self.json("run.json")
        self.assertEqual(report["slam"]["plugin"]["name"], "slam_replay")
        self.assertEqual(report["dataset"]["plugin"]["name"], "example")
        self.assertEqual(report["slam"]["parameters"]["noise_m"], 0.1)
        self.assertEqual((report["seed"], report["alignment"], report["mode"]),
                         (5, "sim3", "every-frame"))
        for name in ["cpu", "cores", "memory_mb", "system", "compiler"]:
            self.assertTrue(report["machine"][name], name)
        self.assertEqual(report["result"]["end"], "finished")
        for name in ["versions", "limits", "units", "association", "poses", "begun"]:
            self.assertIn(name, report)

    def test_json_alone_is_on_stdout(self):
        result = gslam(*self.arguments(options=["--json", "--application", "pose_printer"]))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout), self.json("metrics.json"))
        self.assertIn("/replay/pose", result.stderr)

    def test_cores_are_limited(self):
        for options in [[], ["--isolate"]]:
            with self.subTest(options):
                shutil.rmtree(self.out, ignore_errors=True)
                process = subprocess.Popen(
                    [GSLAM, *map(str, self.arguments(
                        options=["--cpus", "0", "--mode", "real-time", *options]))],
                    stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                self.addCleanup(process.kill)
                worker = wait_until(lambda: worker_of(process))
                wait_until(lambda: (self.out / "frames.csv").exists())  # here the system is made
                children = pathlib.Path(f"/proc/{worker}/task/{worker}/children").read_text().split()
                self.assertEqual(len(children), len(options))
                for number in [worker, *children]:
                    status = pathlib.Path(f"/proc/{number}/status").read_text()
                    self.assertIn("Cpus_allowed_list:\t0\n", status)
                own = pathlib.Path(f"/proc/{process.pid}/status").read_text()
                if os.cpu_count() > 1:
                    self.assertNotIn("Cpus_allowed_list:\t0\n", own)
                self.assertEqual(process.wait(30), 0)
                self.assertEqual(self.json("run.json")["limits"]["cpus"], [0])

    def test_results_come_while_it_runs(self):
        process = subprocess.Popen([GSLAM, *map(str, self.arguments("delay_ms=100"))],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        wait_until(lambda: (self.out / "trajectory.txt").exists() and len(self.poses()) > 3)
        self.assertLess(len(self.poses()), FRAMES)
        self.assertEqual(self.json("run.json")["result"]["end"], "unfinished")
        self.assertGreaterEqual(len(self.frames()), 3)
        worker = worker_of(process)
        process.kill()  # nobody is left who could end the other
        process.wait(30)
        wait_until(lambda: not pathlib.Path(f"/proc/{worker}").exists())
        self.assertEqual(self.json("run.json")["result"]["end"], "unfinished")
        self.assertGreater(len(self.poses()), 3)


class Repeats(Runs):
    def test_are_the_same(self):
        summary = self.run_it("noise_m=0.1", options=["--repeat", 3])
        self.assertEqual(summary["runs"], {"count": 3, "finished": 3, "failed": 0, "failures": []})
        figure = summary["ape"]["translation"]["rmse"]
        self.assertEqual((figure["min"], figure["count"]), (figure["max"], 3))
        self.assertLess(figure["std"], 1e-12)
        texts = {(self.out / str(n) / "trajectory.txt").read_text() for n in [1, 2, 3]}
        self.assertEqual(len(texts), 1)
        one = json.loads((self.out / "2" / "metrics.json").read_text())
        self.assertEqual(one["ape"]["translation"]["rmse"], figure["median"])
        self.assertEqual(summary["coverage"]["frames"]["min"], 1)
        self.assertIsNone(summary["alignment"]["rotation"])  # a mean would mean nothing
        # Those of fewer runs are not mixed with these.
        self.run_it(options=["--repeat", 1])
        self.assertEqual(sorted(path.name for path in self.out.iterdir()),
                         ["1", "metrics.json", "run.json"])
        self.run_it()
        self.assertFalse((self.out / "1").exists())

    def test_failures_are_counted(self):
        summary = self.run_it("fault=abort", "fault_at=5", options=["--repeat", 2], status=1)
        self.assertEqual((summary["runs"]["count"], summary["runs"]["failed"]), (2, 2))
        self.assertIn("SIGABRT", summary["runs"]["failures"][1]["failure"])
        self.assertEqual(summary["coverage"]["tracked_frames"]["max"], 5)
        self.assertEqual(summary["coverage"]["total_frames"]["min"], FRAMES)
        one = json.loads((self.out / "2" / "metrics.json").read_text())
        self.assertAlmostEqual(summary["score"]["value"]["mean"], one["score"]["value"] or 0)
        self.assertTrue((self.out / "2" / "trajectory.txt").exists())


class Interrupts(Runs):
    def start(self, *settings, **more):
        process = subprocess.Popen([GSLAM, *map(str, self.arguments(*settings, **more))],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True)
        self.addCleanup(process.kill)
        wait_until(lambda: (self.out / "trajectory.txt").exists() and len(self.poses()) > 2)
        return process

    def test_the_second_ends_a_run_that_hangs(self):
        process = self.start("fault=hang", "fault_at=5")
        wait_until(lambda: len(self.poses()) == 5)
        os.killpg(process.pid, signal.SIGINT)
        time.sleep(0.5)
        self.assertIsNone(process.poll())  # waits for the frame
        os.killpg(process.pid, signal.SIGINT)
        stdout, stderr = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130, stdout + stderr)
        result = self.json("run.json")["result"]
        self.assertEqual((result["end"], result["cause"]), ("stopped", "interrupt"))
        self.assertEqual(self.json("metrics.json")["coverage"]["tracked_frames"], 5)

    def test_in_the_first_moments(self):
        for wait in [0.02, 0.05, 0.1, 0.15, 0.2, 0.3]:
            with self.subTest(wait):
                shutil.rmtree(self.out, ignore_errors=True)
                process = subprocess.Popen(
                    [GSLAM, *map(str, self.arguments("delay_ms=100"))],
                    stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                self.addCleanup(process.kill)
                wait_until(lambda: worker_of(process))
                time.sleep(wait)
                process.send_signal(signal.SIGINT)
                stdout, stderr = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 130, stdout + stderr)
                self.assertTrue("before it began" in stderr or "stopped" in stdout, stdout + stderr)

    def test_a_later_run_does_not_begin(self):
        process = subprocess.Popen(
            [GSLAM, *map(str, self.arguments("delay_ms=30", options=["--repeat", 9, "--json"]))],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        wait_until(lambda: (self.out / "1" / "metrics.json").exists())
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertGreaterEqual(json.loads(stdout)["runs"]["finished"], 1, stderr)

    def test_no_further_run_begins(self):
        process = subprocess.Popen(
            [GSLAM, *map(str, self.arguments("delay_ms=50", options=["--repeat", 5]))],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True)
        self.addCleanup(process.kill)
        wait_until(lambda: (self.out / "1" / "frames.csv").exists())
        time.sleep(0.3)
        process.terminate()
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertFalse((self.out / "2").exists())
        self.assertEqual(self.json("metrics.json")["runs"]["finished"], 0)


@unittest.skipUnless(DATA, "GSLAM_TEST_DATA names no folder")
class Real(Runs):
    def test_tum(self):
        dataset = pathlib.Path(DATA) / "sequences" / "tum_rgbd_freiburg1_rpy"
        truth = self.out.parent / "truth.txt"
        made = gslam("info", dataset, "--ground-truth", truth)
        self.assertEqual(made.returncode, 0, made.stderr)
        metrics = self.run_it("noise_m=0.05", "losses=10-19", dataset=[dataset], truth=truth,
                              options=["--association", "interpolate", "--align", "none"])
        rmse = metrics["ape"]["translation"]["rmse"]
        frames = metrics["coverage"]["total_frames"]
        self.assertGreater(frames, 50)
        self.assertEqual(metrics["coverage"]["tracked_frames"], frames - 10)
        # As many poses: the root mean square is off by 1 / sqrt(6 n) of itself (one sigma).
        bound = 4 / math.sqrt(6 * (frames - 10))
        self.assertAlmostEqual(rmse / (0.05 * math.sqrt(3)), 1, delta=bound)

    def follow(self, dataset, *settings, count=20, **more):
        """Runs with the ground truth of a dataset on its first frames."""
        dataset = pathlib.Path(DATA) / "sequences" / dataset
        truth = self.out.parent / "truth.txt"
        made = gslam("info", dataset, "--ground-truth", truth)
        self.assertEqual(made.returncode, 0, made.stderr)
        options = ["--count", count, "--association", "interpolate", "--align", "none"]
        return self.run_it(*settings, dataset=[dataset], truth=truth, options=options, **more)

    def test_kitti(self):
        metrics = self.follow("kitti_06", "noise_m=0.05", "losses=5-9")
        self.check(metrics, 20, 15)

    def test_euroc(self):
        metrics = self.follow("euroc_V1_01_easy", "noise_m=0.05")
        tracked = metrics["coverage"]["tracked_frames"]
        self.check(metrics, 20, tracked)
        self.assertGreater(tracked, 10)

    def test_7scenes(self):
        metrics = self.follow("7scenes_redkitchen", "noise_m=0.05", "fault=abort", "fault_at=10",
                              status=1)
        self.assertEqual(metrics["coverage"]["tracked_frames"], 10)

    def check(self, metrics, frames, tracked):
        self.assertEqual(metrics["coverage"]["total_frames"], frames)
        self.assertEqual(metrics["coverage"]["tracked_frames"], tracked)
        self.assertEqual(metrics["association"]["pairs"], tracked)
        rmse = metrics["ape"]["translation"]["rmse"]
        bound = 4 / math.sqrt(6 * tracked)
        self.assertAlmostEqual(rmse / (0.05 * math.sqrt(3)), 1, delta=bound)


if __name__ == "__main__":
    unittest.main()
