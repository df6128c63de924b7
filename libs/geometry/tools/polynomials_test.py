"""The coefficients in the headers are those that polynomials.py makes."""
import re
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
DETAIL = HERE.parent / "include/gslam/geometry/detail"


class PolynomialsTest(unittest.TestCase):
    def test_headers_have_what_the_script_makes(self):
        text = "".join((DETAIL / f"{name}.h").read_text(encoding="utf-8")
                       for name in ("stumpff", "arctangent", "exponential"))
        present = {number.rstrip("f") for number in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?f?", text)}
        values = {float(number) for number in present}
        for kind in ("double", "float"):
            made = subprocess.run([sys.executable, "-B", HERE / "polynomials.py", kind], check=True,
                                  capture_output=True, text=True).stdout
            coefficients = re.findall(r"T\((.*)\)", made)
            self.assertGreater(len(coefficients), 30)
            for coefficient in coefficients:
                self.assertIn(float(coefficient), values, f"{kind} {coefficient}")


if __name__ == "__main__":
    unittest.main()
