"""Tests of bench/report: figures worked out by hand, gates, bad inputs, the chart."""
import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

TOOL = Path(__file__).resolve().parent.parent / "report"
SVG = "{http://www.w3.org/2000/svg}"
CONTEXT = {"date": "2025-01-01T12:00:00+00:00", "num_cpus": 8, "mhz_per_cpu": 3600, "cpu_scaling_enabled": False,
           "library_build_type": "release"}


def run_of(name, cpu, real=None, index=0, **more):
    """One measured entry as Google Benchmark writes it."""
    return {"name": name, "run_name": name, "run_type": "iteration", "repetition_index": index, "threads": 1,
            "iterations": 100, "real_time": cpu if real is None else real, "cpu_time": cpu, "time_unit": "ns", **more}


def aggregate_of(name, kind, cpu, **more):
    """One aggregate entry (median, cv, ...) of a repeated benchmark."""
    return {"name": f"{name}_{kind}", "run_name": name, "run_type": "aggregate", "aggregate_name": kind,
            "iterations": 3, "real_time": cpu, "cpu_time": cpu, "time_unit": "ns", **more}


class ReportTest(unittest.TestCase):
    """Runs the tool as a user would, in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def write(self, name, content):
        text = content if isinstance(content, str) else json.dumps(content)
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def results(self, *entries, name="results.json", **context):
        return self.write(name, {"context": {**CONTEXT, **context}, "benchmarks": list(entries)})

    def run_tool(self, *arguments):
        return subprocess.run([sys.executable, str(TOOL), *arguments], cwd=self.folder, capture_output=True,
                              encoding="utf-8", timeout=60)

    def page(self, *arguments, status=0):
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stdout

    def table(self, *arguments, status=0):
        """{row: {implementation: cell}} of the printed page."""
        lines = [line[2:-2].split(" | ") for line in self.page(*arguments, status=status).splitlines()
                 if line.startswith("| ")]
        return {cells[0]: dict(zip(lines[0][1:], cells[1:])) for cells in lines[2:]}

    def assert_refused(self, *arguments, says):
        """Exit status 2 and one sentence with these words."""
        done = self.run_tool(*arguments)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, done.stderr)


class CellTest(ReportTest):
    def test_ratio_best_and_order_of_columns(self):
        file = self.results(run_of("publish/boost/16", 50), run_of("publish/gslam/16", 20),
                            run_of("publish/raw/16", 10))
        self.assertEqual(self.table(file), {"publish/16": {"gslam": "20.0 ns", "boost": "50.0 ns x2.5",
                                                           "raw": "**10.0 ns** x0.50"}})
        self.assertIn("| benchmark | gslam | boost | raw |\n", self.page(file))

    def test_names(self):
        file = self.results(run_of("plain", 1), run_of("sort/1024", 2), run_of("named/n:3", 3),
                            run_of("many/threads:2", 4), run_of("exp/sophus/8/threads:2", 5),
                            run_of("exp/gslam/8/min_time:0.5/repeats:3/threads:2", 6))
        table = self.table(file)
        self.assertEqual([(row, cells["gslam"], cells["sophus"]) for row, cells in table.items()],
                         [("plain", "1.00 ns", "-"), ("sort/1024", "2.00 ns", "-"), ("named/n:3", "3.00 ns", "-"),
                          ("many/threads:2", "4.00 ns", "-"), ("exp/8/threads:2", "6.00 ns", "**5.00 ns** x0.83")])

    def test_units(self):
        times = {"a": 0.1234, "b": 999.4, "c": 999.6, "d": 45678, "e": 999600, "f": 12345678901}
        table = self.table(self.results(*(run_of(name, time) for name, time in times.items())))
        self.assertEqual([cells["gslam"] for cells in table.values()],
                         ["0.123 ns", "999 ns", "1.00 us", "45.7 us", "1.00 ms", "12346 ms"])

    def test_time_unit_of_the_file(self):
        file = self.results(run_of("a", 1.5, time_unit="us"), run_of("b", 2, time_unit="ms"),
                            run_of("c", 3, time_unit="s"))
        self.assertEqual([cells["gslam"] for cells in self.table(file).values()], ["1.50 us", "2.00 ms", "3000 ms"])

    def test_items_per_second_gives_time_per_item(self):
        # 4e6 items a second: 250 ns an item on the CPU clock; the wall clock is 2000/1000 of it.
        file = self.results(run_of("a", 1000, 2000, items_per_second=4e6))
        self.assertEqual(self.table(file)["a"]["gslam"], "250 ns")
        self.assertEqual(self.table(file, "--real")["a"]["gslam"], "500 ns")

    def test_real_clock(self):
        file = self.results(run_of("a", 10, 30), run_of("b/gslam/real_time", 1, 40),
                            run_of("c/manual_time", 1, 50, items_per_second=1e9))
        self.assertEqual([cells["gslam"] for cells in self.table(file).values()], ["10.0 ns", "40.0 ns", "1.00 ns"])
        self.assertEqual([cells["gslam"] for cells in self.table(file, "--real").values()],
                         ["30.0 ns", "40.0 ns", "1.00 ns"])

    def test_median_of_repetitions_and_their_variation(self):
        # 10, 12, 20: median 12, mean 14, deviation sqrt((16 + 4 + 36) / 2) = 5.29, which is 38 % of the mean.
        file = self.results(*(run_of("a", time, index=i) for i, time in enumerate((20, 10, 12))))
        self.assertEqual(self.table(file)["a"]["gslam"], "12.0 ns ±38 %")

    def test_median_of_an_even_number_without_indices(self):
        entries = [run_of("a", time) for time in (10, 10.2)]
        for entry in entries:
            del entry["repetition_index"]
        self.assertEqual(self.table(self.results(*entries))["a"]["gslam"], "10.1 ns")

    def test_aggregates_come_first(self):
        file = self.results(run_of("a", 10), run_of("a", 11, index=1), aggregate_of("a", "mean", 99),
                            aggregate_of("a", "median", 33), aggregate_of("a", "stddev", 0),
                            aggregate_of("a", "cv", 0.09))
        self.assertEqual(self.table(file)["a"]["gslam"], "33.0 ns ±9 %")

    def test_aggregates_alone_and_small_variation(self):
        # Google Benchmark writes NaN for the variation of a counter that is always 0.
        file = self.results(aggregate_of("a", "median", 33, allocs=0),
                            aggregate_of("a", "cv", 0.05, allocs=float("nan")))
        self.assertEqual(self.table(file)["a"]["gslam"], "33.0 ns (0 allocs)")

    def test_what_is_found_beside_the_time(self):
        file = self.results(run_of("a/gslam", 10, lost=0, p999=1.26e-12, other=3), run_of("a/peer", 20, right=98, wrong=2))
        self.assertEqual(self.table(file)["a"], {"gslam": "**10.0 ns** (lost 0 %, p999 1e-12)",
                                                 "peer": "20.0 ns x2.0 (right 98 %, wrong 2 %)"})

    def test_allocs(self):
        file = self.results(run_of("a/gslam", 10, allocs=0.0), run_of("a/peer", 20, allocs=1.5))
        self.assertEqual(self.table(file)["a"],
                         {"gslam": "**10.0 ns** (0 allocs)", "peer": "20.0 ns x2.0 (1.5 allocs)"})

    def test_complexity_fits_are_left_out(self):
        file = self.results(run_of("a/gslam/8", 10), {"name": "a/gslam_BigO", "run_name": "a/gslam",
                            "run_type": "aggregate", "aggregate_name": "BigO", "cpu_coefficient": 1})
        self.assertEqual(list(self.table(file)), ["a/8"])

    def test_several_files_share_rows(self):
        ours, peer = self.results(run_of("a/gslam", 10)), self.results(run_of("a/peer", 30), name="peer.json")
        self.assertEqual(self.table(ours, peer)["a"]["peer"], "30.0 ns x3.0")

    def test_skipped_is_no_error(self):
        file = self.results(run_of("a/gslam", 10), run_of("a/peer", 0, skipped=True, skip_message="no GPU"))
        self.assertEqual(self.table(file)["a"]["peer"], "skipped: no GPU")


class PageTest(ReportTest):
    def test_header(self):
        page = self.page(self.results(run_of("a", 10)), "--title", "Messenger")
        self.assertTrue(page.startswith("# Messenger\n"))
        self.assertIn("2025-01-01T12:00:00+00:00, 8 CPUs at 3600 MHz, release build\n", page)
        self.assertNotIn("Warning", page)

    def test_warnings(self):
        file = self.results(run_of("a/gslam", 10), run_of("a/peer", 10, items_per_second=1e9),
                            library_build_type="debug", cpu_scaling_enabled=True)
        page = self.page(file)
        for words in ("debug build", "scaling was enabled", "a: only some implementations count items"):
            self.assertIn(words, page)
        self.assertEqual(page.count("> **Warning:**"), 3)

    def test_harness_knows_better_than_the_library(self):
        page = self.page(self.results(run_of("a", 10), library_build_type="debug", code_build_type="release",
                                      compiler="g++ 12"))
        self.assertIn("MHz, g++ 12, release build\n", page)
        self.assertNotIn("Warning", page)

    def test_without_context(self):
        self.write("bare.json", {"benchmarks": [run_of("a", 10)]})
        self.assertIn("unknown CPUs", self.page("bare.json"))

    def test_markdown_file_and_no_other_output(self):
        file = self.results(run_of("a", 10))
        page = self.page(file)
        self.assertEqual(self.page(file, "--markdown", "page.md"), "")
        self.assertEqual((self.folder / "page.md").read_text(encoding="utf-8"), page)

    def test_markup_in_names_is_escaped(self):
        self.assertIn("| a\\<int\\|\\*> | ", self.page(self.results(run_of("a<int|*>", 10))))

    def test_errors_stand_in_their_cell(self):
        broken = run_of("a/peer", 0, error_occurred=True, error_message="no device | here")
        file = self.results(run_of("a/gslam", 10), broken)
        self.assertIn("| a | 10.0 ns | error: no device \\| here |", self.page(file, status=2))
        self.assert_refused(file, says="a/peer reports error: no device | here")

    def test_help_explains_the_names(self):
        self.assertIn("<case>/<implementation>[/args]", self.page("--help"))


class GateTest(ReportTest):
    def setUp(self):
        super().setUp()
        self.file = self.results(run_of("a/gslam/16", 10), run_of("a/peer/16", 40), run_of("b/peer", 5))

    def check(self, gates, status, results=None):
        self.write("gates.json", gates)
        return self.page(results or self.file, "--gates", "gates.json", "--markdown", "page.md", status=status)

    def test_ratio(self):
        gate = {"row": "a/16", "peer": "peer", "max_ratio": 0.25}
        self.assertEqual(self.check([gate], 0), "PASS a/16: 0.25 (10 ns / 40 ns), bound 0.25 of peer\n")
        gate["max_ratio"] = 0.249
        self.assertEqual(self.check([gate], 1), "FAIL a/16: 0.25 (10 ns / 40 ns), bound 0.249 of peer\n")

    def test_absolute(self):
        self.assertEqual(self.check([{"row": "a/16", "max_ns": 12}], 0), "PASS a/16: 10 ns, bound 12 ns\n")
        self.assertEqual(self.check([{"row": "a/16", "max_ns": 9.5}], 1), "FAIL a/16: 10 ns, bound 9.5 ns\n")

    def test_peer_missing_is_skipped(self):
        gate = {"row": "a/16", "peer": "absent", "max_ratio": 0.5}
        self.assertEqual(self.check([gate], 0), "SKIP (peer not measured) a/16: 10 ns, bound 0.5 of absent\n")

    def test_ours_missing_fails(self):
        for gate in ({"row": "b", "peer": "peer", "max_ratio": 9}, {"row": "b", "max_ns": 9}, {"row": "c", "max_ns": 9},
                     {"row": "c", "peer": "absent", "max_ratio": 9}):
            self.assertIn(f"FAIL {gate['row']}: gslam not measured", self.check([gate], 1))

    def test_ours_with_an_error_fails(self):
        file = self.results(run_of("a/gslam/16", 0, error_occurred=True), run_of("a/peer/16", 40), name="error.json")
        self.assertIn("FAIL a/16: gslam not measured", self.check([{"row": "a/16", "max_ns": 99}], 2, file))

    def test_one_failure_among_many(self):
        output = self.check([{"row": "a/16", "max_ns": bound} for bound in (12, 1, 13)], 1)
        self.assertEqual([line[:4] for line in output.splitlines()], ["PASS", "FAIL", "PASS"])

    def test_after_the_page_on_stdout(self):
        self.write("gates.json", [{"row": "a/16", "max_ns": 12}])
        self.assertTrue(self.page(self.file, "--gates", "gates.json").endswith("|\n\nPASS a/16: 10 ns, bound 12 ns\n"))

    def test_bad_gates(self):
        for gates in ("[", {}, [], [1], [{"row": "a/16"}], [{"row": "a/16", "max_ns": 0}], [{"row": 1, "max_ns": 1}],
                      [{"row": "a/16", "max_ns": float("nan")}], [{"row": "a/16", "max_ns": True}],
                      [{"row": "a/16", "peer": "gslam", "max_ratio": 2}],
                      [{"row": "a/16", "peer": "peer", "max_ns": 2}],
                      [{"row": "a/16", "peer": "peer", "max_ration": 2}]):
            with self.subTest(gates=gates):
                self.write("gates.json", gates)
                self.assert_refused(self.file, "--gates", "gates.json", says="gates.json: ")


class BadInputTest(ReportTest):
    def test_no_results(self):
        good = json.dumps({"context": CONTEXT, "benchmarks": [run_of("a", 10)]})
        for text, words in (("", "complete JSON"), ("hello", "complete JSON"), (good[:-20], "complete JSON"),
                            ("[" * 100000, "complete JSON"), ("[]", '"benchmarks"'), ("{}", '"benchmarks"'),
                            ('{"benchmarks": 3}', '"benchmarks"'), ('{"benchmarks": []}', "no measurement"),
                            ('{"benchmarks": [3]}', "no name"), ('{"benchmarks": [{}]}', "no name")):
            with self.subTest(text=text[:40]):
                self.assert_refused(self.write("bad.json", text), says=["bad.json: ", words])

    def test_unreadable_files(self):
        (self.folder / "binary.json").write_bytes(b"\xff\xfe\x00")
        self.assert_refused("binary.json", says="binary.json: ")
        self.assert_refused("absent.json", says="absent.json: ")
        self.assert_refused(".", says=".: ")

    def test_times_that_are_none(self):
        for time in (float("nan"), float("inf"), 0, -1, None, "10", True, [], 10 ** 400):
            with self.subTest(time=str(time)[:20]):
                self.assert_refused(self.results(run_of("a", time, 5)), says="a: cpu_time is ")
                self.assert_refused(self.results(run_of("a", 5, items_per_second=time)), says="items_per_second is ")

    def test_real_time_is_checked_where_it_is_used(self):
        self.assert_refused(self.results(run_of("a", 5, -1)), "--real", says="a: real_time is -1")

    def test_one_bad_repetition(self):
        self.assert_refused(self.results(run_of("a", 5), run_of("a", -1, index=1), aggregate_of("a", "median", 5)),
                            says="cpu_time is -1")

    def test_other_fields(self):
        self.assert_refused(self.results(run_of("a", 5, allocs=-1)), says="allocs is -1")
        self.assert_refused(self.results(run_of("a", 5, time_unit="h")), says="time_unit is h")
        self.assert_refused(self.results(aggregate_of("a", "mean", 5)), says="neither runs nor a median")

    def test_duplicates(self):
        first, second = self.results(run_of("a/gslam", 1)), self.results(run_of("a/gslam", 2), name="second.json")
        self.assert_refused(first, second, says=["twice", "results.json", "second.json"])
        self.assert_refused(first, first, says="twice")
        self.assert_refused(self.results(run_of("a", 1), run_of("a", 2)), says="twice")
        self.assert_refused(self.results(run_of("a", 1), run_of("a/gslam", 2)), says="twice")

    def test_unwritable_output(self):
        self.assert_refused(self.results(run_of("a", 1)), "--svg", "absent/chart.svg", says="absent")


class ChartTest(ReportTest):
    def chart(self, *entries, status=0):
        self.page(self.results(*entries), "--svg", "chart.svg", "--title", "A <b> & c", status=status)
        return ElementTree.parse(self.folder / "chart.svg").getroot()

    def bars(self, root):
        return [float(bar.get("width")) for bar in root.iter(f"{SVG}rect") if bar.get("class") == "bar"]

    def texts(self, root):
        return [element.text for element in root.iter(f"{SVG}text")]

    def test_linear_bars(self):
        root = self.chart(run_of("a/gslam", 10), run_of("a/peer", 40), run_of("b/gslam", 20))
        self.assertEqual(self.bars(root), [150.0, 600.0, 300.0])
        self.assertTrue({"A <b> & c", "a", "b", "gslam", "peer", "40.0 ns x4.0"} <= set(self.texts(root)))
        self.assertNotIn("logarithmic", "".join(filter(None, self.texts(root))))

    def test_logarithmic_bars(self):
        root = self.chart(run_of("a/gslam", 10), run_of("a/p", 100), run_of("a/q", 1000))
        short, middle, long = self.bars(root)
        self.assertAlmostEqual(middle - short, long - middle, delta=0.2)
        self.assertIn("time per item (cpu_time), shorter is better, logarithmic axis", self.texts(root))

    def test_the_axis_turns_logarithmic_above_50(self):
        for ratio, expected in ((50, False), (51, True)):
            root = self.chart(run_of("a/gslam", 10), run_of("a/p", 10 * ratio))
            self.assertEqual("logarithmic" in " ".join(filter(None, self.texts(root))), expected)

    def test_errors_have_words_and_no_bar(self):
        broken = run_of("a/p", 0, error_occurred=True, error_message="bad\u0001 <x>")
        root = self.chart(run_of("a/gslam", 10), broken, status=2)
        self.assertEqual(len(self.bars(root)), 1)
        self.assertIn("p: error: bad <x>", self.texts(root))

    def test_only_errors_and_surrogates(self):
        root = self.chart(run_of("a/gslam", 0, error_occurred=True, error_message="\ud800"), status=2)
        self.assertEqual(self.bars(root), [])

    def test_accessible_light_and_deterministic(self):
        entries = [run_of(f"case{i}/{name}", 3 + i) for i in range(9) for name in ("x", "gslam", "y")]
        root = self.chart(*entries)
        first = (self.folder / "chart.svg").read_bytes()
        self.chart(*entries)
        self.assertEqual(first, (self.folder / "chart.svg").read_bytes())
        self.assertEqual([root[0].tag, root[1].tag], [f"{SVG}title", f"{SVG}desc"])
        self.assertEqual((root[2].get("width"), root[2].get("fill")), (root.get("width"), "#fbfcfd"))
        self.assertEqual(len(self.bars(root)), 27)


if __name__ == "__main__":
    unittest.main()
