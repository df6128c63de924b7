"""tally.py decides whether ./dev test passed: it must never lose a failure."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import tally

XML = '<testsuite>{}</testsuite>'
PASSED = '<testcase name="p" status="run"/>'
FAILED = '<testcase name="f" status="fail"/>'
SKIPPED = '<testcase name="s" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>'
NOT_FOUND = ('<testcase name="n" status="notrun"><skipped message="Unable to find executable"/>'
             '</testcase>')


class Tally(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def results(self, name, *cases):
        path = self.folder / name
        path.write_text(XML.format("".join(cases)))
        return str(path)

    def total(self, *paths):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            status = tally.main(["--total", *paths])
        return status, printed.getvalue().splitlines()

    def test_counts_over_files(self):
        status, lines = self.total(self.results("a.xml", PASSED, PASSED, SKIPPED),
                                   self.results("b.xml", PASSED))
        self.assertEqual((status, lines), (0, ["3 passed, 0 failed, 1 skipped"]))

    def test_one_failure_fails_all_and_is_named(self):
        status, lines = self.total(self.results("a.xml", PASSED), self.results("tsan.xml", FAILED))
        self.assertEqual((status, lines), (1, ["FAILED tsan: f", "1 passed, 1 failed, 0 skipped"]))

    def test_a_test_that_could_not_start_is_a_failure(self):
        status, lines = self.total(self.results("a.xml", PASSED, NOT_FOUND))
        self.assertEqual((status, lines), (1, ["FAILED a: n", "1 passed, 1 failed, 0 skipped"]))

    def test_counts_the_tests_that_one_process_ran(self):
        results, gtest = self.folder / "results", self.folder / "dev" / "gtest"
        results.mkdir()
        gtest.mkdir(parents=True)
        inner = ('<testsuites><testsuite><testcase classname="a" name="b" result="completed"/>'
                 '<testcase classname="a" name="c" result="skipped"/>{}</testsuite></testsuites>')
        bad = '<testcase classname="a" name="d"><failure message="no"/></testcase>'
        for status, more, expected in (
                ("run", "", "1 passed, 0 failed, 1 skipped"),
                ("fail", bad, "1 passed, 1 failed, 1 skipped"),
                ("fail", "", "0 passed, 1 failed, 0 skipped")):  # a leak, or what a crash left
            (gtest / "l.shard_0.xml").write_text(inner.format(more))
            path = self.results("results/dev.xml",
                                f'<testcase name="l.shard_0" status="{status}"/>')
            self.assertEqual(self.total(path)[1][-1], expected)

    def test_has_failures(self):
        for cases, expected in (([FAILED], 0), ([PASSED], 1), ([NOT_FOUND], 0), ([], 1)):
            path = self.results("a.xml", *cases)
            self.assertEqual(tally.main(["--has-failures", path]), expected, cases)
        self.assertEqual(tally.main(["--has-failures", str(self.folder / "none.xml")]), 1)

    def test_results_that_are_missing_or_broken_are_failures(self):
        (self.folder / "cut.xml").write_text("<testsuite><testcase")
        status, lines = self.total(self.results("a.xml", PASSED), str(self.folder / "none.xml"),
                                   str(self.folder / "cut.xml"))
        self.assertEqual(status, 1)
        self.assertEqual(lines[-1], "1 passed, 2 failed, 0 skipped")

    def test_nothing_passed_is_no_success(self):
        self.assertEqual(self.total(self.results("a.xml"))[0], 1)
        self.assertEqual(self.total(self.results("a.xml", SKIPPED))[0], 1)
        self.assertEqual(self.total()[0], 1)

    def test_steps_that_are_no_ctest(self):
        good, bad = str(self.folder / "x" / "lint.xml"), str(self.folder / "build.xml")
        tally.main(["--passed", good, "lint"])
        tally.main(["--failed", bad, "build of dev"])
        status, lines = self.total(good, bad)
        self.assertEqual((status, lines[-1]), (1, "1 passed, 1 failed, 0 skipped"))


if __name__ == "__main__":
    unittest.main()
