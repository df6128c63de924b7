"""What tests of the command share: a folder for each, and what a finished process must have said."""

import pathlib
import tempfile
import unittest


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def check(self, result, status=0, out="", err=""):
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        self.assertIn(out, result.stdout)
        self.assertIn(err, result.stderr)
        return result

    def write(self, name, content):
        """A file of this text, or of these bytes."""
        path = self.folder / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path
