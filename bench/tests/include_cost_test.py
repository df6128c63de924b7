"""Tests of bench/include_cost: what it prints, skips and refuses."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parent.parent / "include_cost"


class IncludeCostTest(unittest.TestCase):
    """Runs the tool on headers in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "light.h").write_text("int light();\n", encoding="utf-8")
        (self.folder / "heavy.h").write_text("#include <map>\n#include <string>\n", encoding="utf-8")
        (self.folder / "wrong.h").write_text("int wrong(\n", encoding="utf-8")

    def run_tool(self, *arguments):
        command = [sys.executable, TOOL, "-I", self.folder, "--runs", "1", "--standards", "17", *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def cells(self, result, header):
        """Seconds of the header, and of the standard headers in it."""
        row = re.search(rf"^\| {header} \| (-?\d+\.\d\d) \((-?\d+\.\d\d)\) \|$", result.stdout, re.MULTILINE)
        self.assertIsNotNone(row, result.stdout + result.stderr)
        return [float(cell) for cell in row.groups()]

    def test_measures_a_header_and_the_standard_library_in_it(self):
        result = self.run_tool("light.h", "heavy.h")
        self.assertEqual(result.returncode, 0, result.stderr)
        light, heavy = self.cells(result, "light.h"), self.cells(result, "heavy.h")
        self.assertLess(light[0], heavy[0])
        self.assertGreater(heavy[1], 0)

    def test_skips_what_is_not_there(self):
        result = self.run_tool("light.h", "missing.h")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "skipped, not found: missing.h\n")
        self.assertNotIn("missing.h", result.stdout)

    def test_fails_above_the_bound(self):
        self.assertEqual(self.run_tool("heavy.h", "--max", "0.001").returncode, 1)
        self.assertEqual(self.run_tool("heavy.h", "--max", "1000").returncode, 0)

    def test_refuses_what_does_not_compile_and_nothing(self):
        result = self.run_tool("wrong.h")
        self.assertEqual(result.returncode, 2)
        self.assertIn("wrong.h does not compile", result.stderr)
        self.assertEqual(self.run_tool("missing.h").returncode, 2)


if __name__ == "__main__":
    unittest.main()
