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
SKIPPED = '<testcase name="s" status="notrun"/>'


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
