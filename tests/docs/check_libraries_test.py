"""check_libraries.py must see a README that lies and a paper that is missing."""

import pathlib
import tempfile
import unittest

import check_libraries


class CheckLibraries(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.library = self.root / "libs" / "one"
        self.write("README.md", "# One\n```cpp\nint a;\nint b;\n```\n")
        self.write("CHANGELOG.md", "# Changes\n\n## 1.2.0 - 2026-01-31\n\n## 1.1.0 - 2025-01-01\n")
        self.write("VERSION", "1.2.0\n")
        self.write("examples/one.cpp", "// One\nint a;\nint b;\n")
        self.write("tests/instantiate.cpp", "")
        for name in ("include", "bench"):
            (self.library / name).mkdir()
        (self.root / "docs").mkdir()
        for page in ("README.md", "docs/index.md"):
            (self.root / page).write_text("```cpp\nint b;\n```\n")

    def write(self, path, text):
        file = self.library / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def complaints(self):
        return list(check_libraries.check(self.root, [self.library]))

    def test_papers_in_order(self):
        self.assertEqual(self.complaints(), [])

    def test_a_readme_that_differs_from_its_example(self):
        self.write("examples/one.cpp", "int a;\nint c;\n")
        self.assertEqual(len(self.complaints()), 3)  # the library's, the project's, the site's
        self.assertIn("int a;", self.complaints()[0])

    def test_a_readme_without_an_example(self):
        self.write("README.md", "# One\n")
        self.assertIn("no ```cpp", self.complaints()[0])

    def test_a_placeholder(self):
        self.write("README.md", "# One\nFIGURES\n```cpp\nint a;\nint b;\n```\n")
        self.assertIn("FIGURES", self.complaints()[0])

    def test_a_changelog_behind_its_version(self):
        self.write("VERSION", "1.3.0\n")
        self.assertIn("1.2.0, VERSION says 1.3.0", self.complaints()[0])

    def test_a_missing_paper(self):
        (self.library / "CHANGELOG.md").unlink()
        self.assertIn("lacks CHANGELOG.md", self.complaints()[0])

    def test_a_package_inside_a_library(self):
        for path in ("tests/instantiate.cpp", "examples/two.cpp", "include/a.h", "bench/b.cpp"):
            self.write("inside/" + path, "int d;\n")
        inside = [self.library, self.library / "inside"]
        complaints = list(check_libraries.check(self.root, inside))
        self.assertEqual(len(complaints), 1)
        self.assertIn("inside: lacks README.md", complaints[0])
        self.write("inside/README.md", "# Two\n```cpp\nint d;\n```\n")
        self.assertEqual(list(check_libraries.check(self.root, inside)), [])


if __name__ == "__main__":
    unittest.main()
