"""`gslam vocabulary`: trains, reads, converts and uses vocabularies, on real files and photographs.

The program is named by the environment variable GSLAM, the folder of real data by GSLAM_TEST_DATA.
"""

import json
import os
import pathlib
import signal
import subprocess
import time
import unittest

from folder import Folder

GSLAM = os.environ["GSLAM"]
DATA = pathlib.Path(os.environ.get("GSLAM_TEST_DATA", "")) / "vocabularies"
IMAGES = DATA / "slambook_images"
FILES = {"slambook_vocabulary.yml.gz": (10, 5, 4983), "kimera_dbow2_small_voc.yml.gz": (9, 3, 692)}
HAS_DATA = IMAGES.is_dir()


def vocabulary(*arguments):
    return subprocess.run([GSLAM, "vocabulary", *map(str, arguments)], capture_output=True,
                          text=True, timeout=120)


class VocabularyFolder(Folder):
    def json(self, *arguments):
        return json.loads(self.check(vocabulary(*arguments, "--json")).stdout)


class Help(VocabularyFolder):
    def test_each_part_has_one(self):
        listed = self.check(vocabulary("--help")).stdout
        for part in ["train", "info", "convert", "transform", "query"]:
            self.assertIn(f"\n  {part} ", listed)
            self.check(vocabulary(part, "--help"), out=f"gslam vocabulary {part}")

    def test_wrong_use(self):
        self.check(vocabulary(), 2, err="train")
        self.check(vocabulary("trian"), 2, err="did you mean train?")
        self.check(vocabulary("info"), 2, err="FILE")
        self.check(vocabulary("convert", "a.gvoc"), 2, err="FILE OUT")
        self.check(vocabulary("transform"), 2, err="VOCABULARY")
        self.check(vocabulary("train", "a.png"), 2, err="gslam vocabulary train --help")
        for option, value in [("-k", 1), ("-k", 65), ("-l", 0), ("--feature", "surf"), ("--every", 0),
                              ("--memory", "1X"), ("--memory", "1"), ("--memory", ""),
                              ("--storage", "int8"), ("--weighting", "idf2"), ("--threads", -1)]:
            result = vocabulary("train", "a.png", "--out", self.folder / "v.gvoc", option, value)
            self.check(result, 2, err=option)
        for name, options in [("v.yml", []), ("v.txt", ["-k", 30]), ("v.txt", ["-l", 11]),
                              ("v.txt", ["--feature", "sift"])]:
            self.check(vocabulary("train", "a.png", "--out", self.folder / name, *options), 2, err=name)
        self.assertEqual(list(self.folder.iterdir()), [])


class Worlds(VocabularyFolder):
    """Computed worlds, for which no data is needed."""

    world = "synthetic://room?frames=6&width=320&height=240"

    def train(self, *options):
        path = self.folder / "world.gvoc"
        return path, self.json("train", self.world, "--out", path, "-l", 3, *options)

    def test_trains_on_a_dataset(self):
        path, report = self.train()
        self.assertEqual(report["images"], 6)
        self.assertGreater(report["training_descriptors"], 1000)
        facts = self.json("info", path, "--verify")
        for key in ["words", "nodes", "depth", "branching", "weights"]:
            self.assertEqual(facts[key], report[key])
        self.assertTrue(facts["mapped"])
        self.assertEqual([p.name for p in self.folder.iterdir()], ["world.gvoc"])

    def test_every(self):
        self.assertEqual(self.train("--every", 4)[1]["images"], 2)
        bags = self.json("transform", self.train()[0], self.world, "--every", 2)
        self.assertEqual([bag["image"].rpartition(":")[2] for bag in bags], ["0", "2", "4"])

    def test_threads_and_memory_do_not_matter(self):
        contents = []
        for options in [["--threads", 1], ["--threads", 2], ["--memory", "8M"]]:
            contents.append(self.train(*options)[0].read_bytes())
        self.assertEqual(contents[0], contents[1])
        self.assertEqual(contents[0], contents[2])
        self.assertNotEqual(contents[0], self.train("--seed", 1)[0].read_bytes())

    def test_floats_in_less_memory(self):
        path, report = self.train("--feature", "sift", "--features", 100)
        self.assertEqual(report["descriptor"], {"type": "float32", "size": 128})
        bags = self.json("transform", path, self.world, "--features", 100)
        for storage, part in [("float16", 0.55), ("int8", 0.3)]:
            small = self.folder / f"{storage}.gvoc"
            self.check(vocabulary("convert", path, small, "--storage", storage))
            facts = self.json("info", small, "--verify")
            self.assertEqual(facts["descriptor"]["type"], storage)
            self.assertLess(facts["bytes"], part * report["bytes"])
            common = total = 0
            for bag, other in zip(bags, self.json("transform", small, self.world, "--features", 100)):
                common += len(set(bag["words"]) & set(other["words"]))
                total += len(bag["words"])
            self.assertGreater(common, 0.9 * total)  # few descriptors are near a border
            self.check(vocabulary("convert", path, self.folder / "v.txt"), 1, err="expected binary")

    def test_more_descriptors_than_memory(self):
        path = self.folder / "v.gvoc"
        report = self.json("train", self.world, self.world, "--out", path, "-l", 3, "--feature",
                           "sift", "--features", 2000, "--memory", "4M")
        self.assertGreater(report["training_descriptors"] * (4 * 128 + 17), 4 << 20)
        self.assertGreater(report["passes"], 2)
        self.check(vocabulary("info", path, "--verify"), out="128 float32")

    def test_weights(self):
        path, _ = self.train()
        for weighting in ["tf", "binary"]:
            out = self.folder / f"{weighting}.gvoc"
            self.check(vocabulary("convert", path, out, "--weighting", weighting, "--scoring", "dot"))
            facts = self.json("info", out)
            self.assertEqual((facts["weighting"], facts["scoring"]), (weighting, "dot"))
            self.assertEqual(facts["weights"], {"zero": 0, "least_above_zero": 1.0, "most": 1.0})
            self.check(vocabulary("convert", out, path, "--weighting", "idf"), 2, err="--weighting")
        values = {v for bag in self.json("transform", self.folder / "binary.gvoc", self.world)
                  for v in bag["values"]}
        self.assertEqual(values, {1.0})

    def test_all_features_find_a_place_again(self):
        for feature in ["orb", "sift", "brisk", "akaze"]:
            path, report = self.train("--feature", feature, "--features", 200)
            self.assertEqual(report["feature"], feature)
            self.assertLessEqual(report["training_descriptors"], 6 * 201)
            found = self.json("query", path, self.world, self.world, "--features", 200, "--top", 1)
            for i, image in enumerate(found):
                if i >= 6:
                    self.assertEqual(image["places"][0]["id"], i - 6)
                    self.assertAlmostEqual(image["places"][0]["score"], 1, delta=1e-9)

    def test_ctrl_c_writes_nothing(self):
        path = self.folder / "never.gvoc"
        world = "synthetic://room?frames=100000&width=320&height=240"
        process = subprocess.Popen([GSLAM, "vocabulary", "train", world, "--out", path],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("nothing was written", err)
        self.assertEqual(list(self.folder.iterdir()), [])


class BadInput(VocabularyFolder):
    def train(self, *images):
        return vocabulary("train", *images, "--out", self.folder / "v.gvoc")

    def test_images(self):
        world = "synthetic://room?frames=2&width=160&height=120"
        subprocess.run([GSLAM, "play", world, "--save", self.folder / "set", "--as", "tum"],
                       capture_output=True, timeout=60, check=True)
        image = min((self.folder / "set").rglob("*.png")).read_bytes()
        self.check(self.train("nowhere"), 1, err="nowhere: does not exist, expected an image")
        self.check(self.train(self.write("a.txt", b"hello")), 1, err="a.txt: is nothing")
        self.check(self.train(self.write("e.png", b"")), 1, err="e.png: is nothing")
        self.check(self.train(self.write("cut.png", image[:len(image) // 2])), 1,
                   err="cut.png: cannot be decoded")
        (self.folder / "empty").mkdir()
        self.check(self.train(self.folder / "empty"), 1, err="expected an image")
        black = self.write("black.pgm", b"P5\n200 200\n255\n" + bytes(200 * 200))
        self.check(self.train(black), 1, err="no orb features were found in 1 images")
        result = vocabulary("train", black, "--out", self.folder / "none" / "v.gvoc")
        self.check(result, 1, err="No such file or directory")
        self.assertFalse((self.folder / "v.gvoc").exists())

    def test_vocabularies(self):
        good = self.folder / "good.gvoc"
        self.check(vocabulary("train", "synthetic://room?frames=2&width=320&height=240", "--out", good,
                              "-l", 3))
        whole = good.read_bytes()
        flipped = bytearray(whole)
        flipped[-10] ^= 1
        cut = self.write("cut.gvoc", whole[:-1])
        damaged = self.write("damaged.gvoc", flipped)
        for part in [["info"], ["convert"], ["transform"], ["query"]]:
            end = {"info": [], "convert": [self.folder / "out.gvoc"]}.get(part[0], ["carousel"])
            self.check(vocabulary(*part, self.folder / "no.gvoc", *end), 1, err="no.gvoc: cannot be opened")
            self.check(vocabulary(*part, self.write("e.gvoc", b""), *end), 1, err="is empty")
            self.check(vocabulary(*part, self.write("x.gvoc", b"hello world"), *end), 1,
                       err="is no vocabulary of")
            self.check(vocabulary(*part, cut, *end), 1, err="cut off")
        self.check(vocabulary("info", damaged), out="--verify checks all of it")
        self.check(vocabulary("info", "--verify", damaged), 1, err="damaged.gvoc: is damaged")
        self.check(vocabulary("convert", damaged, self.folder / "out.gvoc"), 1, err="is damaged")
        self.assertFalse((self.folder / "out.gvoc").exists())
        self.check(vocabulary("convert", good, self.folder / "out.yml"), 2, err="out.yml")
        self.check(vocabulary("convert", good, self.folder / "out.gvoc", "--storage", "int8"), 2,
                   err="--storage")
        self.check(vocabulary("transform", good, "carousel", "--feature", "brisk"), 2, err="--feature")

    def test_databases(self):
        vocabularies = []
        for seed in [0, 1]:
            vocabularies.append(self.folder / f"{seed}.gvoc")
            self.check(vocabulary("train", "synthetic://room?frames=3&width=320&height=240", "--out",
                                  vocabularies[-1], "-l", 3, "--seed", seed))
        world = "synthetic://room?frames=2&width=320&height=240"
        saved = self.folder / "saved"
        self.check(vocabulary("query", vocabularies[0], world, "--save", saved))
        query = ["query", vocabularies[0], world, "--database"]
        self.check(vocabulary(*query, self.folder / "none"), 1, err="none: cannot be opened")
        self.check(vocabulary(*query, vocabularies[0]), 1, err="is no database")
        self.check(vocabulary(*query, self.write("cut", saved.read_bytes()[:-1])), 1, err="cut")
        self.check(vocabulary(*query, saved, "--recent", 1), 2, err="--recent")
        self.check(vocabulary("query", vocabularies[1], world, "--database", saved), 1,
                   err="made with another vocabulary")
        self.check(vocabulary("query", vocabularies[0], world, "--save", self.folder / "no" / "x"), 1,
                   err="there is no folder")


@unittest.skipUnless(HAS_DATA or os.environ.get("CI") == "true", "needs GSLAM_TEST_DATA")
class RealFiles(VocabularyFolder):
    def test_info(self):
        for name, shape in FILES.items():
            facts = self.json("info", DATA / name)
            self.assertEqual((facts["branching"], facts["depth"], facts["words"]), shape)
            self.assertEqual(facts["descriptor"], {"type": "binary", "size": 32})
            self.assertEqual((facts["kind"], facts["gzipped"]), ("YAML of DBoW2 or DBoW3", True))
            self.check(vocabulary("info", DATA / name), out="compressed by gzip")

    def test_there_and_back(self):
        for name in FILES:
            own, text, again = [self.folder / n for n in ["a.gvoc", "a.txt", "b.gvoc"]]
            for source, target in [(DATA / name, own), (own, text), (text, again)]:
                self.check(vocabulary("convert", source, target), out="words written to")
            self.assertEqual(own.read_bytes(), again.read_bytes())
            self.assertEqual(self.json("info", text)["kind"], "ORB-SLAM text")
            fingerprints = {self.json("info", f)["fingerprint"] for f in [DATA / name, own, text]}
            self.assertEqual(len(fingerprints), 1)
            bags = [self.check(vocabulary("transform", f, IMAGES / "1.png")).stdout
                    for f in [DATA / name, own, text]]
            self.assertEqual(bags[0], bags[1])
            self.assertEqual(bags[0], bags[2])
            self.assertGreater(len(bags[0].split()), 100)

    def test_transform(self):
        path = DATA / "slambook_vocabulary.yml.gz"
        lines = self.check(vocabulary("transform", path, IMAGES)).stdout.splitlines()
        names = [pathlib.Path(line.split("\t")[0]).name for line in lines]
        self.assertEqual(names, [f"{i}.png" for i in range(1, 11)])  # as people number
        bags = self.json("transform", path, IMAGES, "--levels-up", 3)
        for line, bag in zip(lines, bags):
            words = dict(word.split(":") for word in line.split("\t")[1].split())
            self.assertEqual([int(w) for w in words], bag["words"])
            self.assertEqual([float(v) for v in words.values()], bag["values"])
            self.assertAlmostEqual(sum(bag["values"]), 1, delta=1e-9)
            self.assertEqual(len(bag["node_begins"]), len(bag["nodes"]) + 1)
            self.assertEqual(bag["node_begins"][-1], len(bag["node_features"]))
            self.assertEqual(len(set(bag["node_features"])), len(bag["node_features"]))
            self.assertLess(max(bag["node_features"]), bag["features"])
        frames = self.check(vocabulary("transform", path, f"cvmono:{IMAGES}")).stdout.splitlines()
        self.assertEqual([f.split("\t")[1] for f in frames], [line.split("\t")[1] for line in lines])

    def test_trains_on_photographs(self):
        path = self.folder / "photographs.txt"
        result = self.check(vocabulary("train", IMAGES, "--out", path, "-l", 3))
        for word in ["images       10,", "K 10, L 3", "balance", f"written to   {path}"]:
            self.assertIn(word, result.stdout)
        self.assertEqual(result.stderr, "")
        self.assertEqual(self.json("info", path)["words"], 1000)
        self.check(vocabulary("train", IMAGES, "--out", self.folder / "v.gvoc"), out="note: there are less")

    def test_finds_the_place_again(self):
        """The tenth image shows the place of the first."""
        trained = self.folder / "trained.gvoc"
        self.check(vocabulary("train", IMAGES, "--out", trained, "-l", 4))
        for path in [trained, DATA / "slambook_vocabulary.yml.gz"]:
            found = self.json("query", path, IMAGES, "--top", 3)
            self.assertEqual(found[0]["places"], [])
            self.assertEqual(found[9]["places"][0]["id"], 0)
            self.assertEqual(found[9]["places"][0]["image"], str(IMAGES / "1.png"))
            self.assertGreater(found[9]["places"][0]["score"], 1.1 * found[9]["places"][1]["score"])
            for i, image in enumerate(found):
                self.assertEqual(image["id"], i)
                self.assertLessEqual(len(image["places"]), 3)
                self.assertTrue(all(place["id"] < i for place in image["places"]))
        recent = self.json("query", trained, IMAGES, "--top", 0, "--recent", 4)
        self.assertEqual([len(image["places"]) for image in recent], [0] * 5 + [1, 2, 3, 4, 5])
        self.check(vocabulary("query", trained, IMAGES), out="10.png: ")

    def test_a_saved_database(self):
        path, saved = DATA / "slambook_vocabulary.yml.gz", self.folder / "places"
        first = [IMAGES / f"{i}.png" for i in range(1, 6)]
        self.check(vocabulary("query", path, *first, "--save", saved))
        found = self.json("query", path, IMAGES / "3.png", "--database", saved, "--top", 2)
        self.assertEqual(found[0]["places"][0]["id"], 2)
        self.assertAlmostEqual(found[0]["places"][0]["score"], 1, delta=1e-9)
        self.assertNotIn("id", found[0])
        rest = [IMAGES / f"{i}.png" for i in range(6, 11)]
        both = self.json("query", path, *rest, "--database", saved, "--save", saved, "--top", 3)
        whole = self.json("query", path, IMAGES, "--top", 3)
        for one, other in zip(both, whole[5:]):
            self.assertEqual(one["id"], other["id"])
            self.assertEqual([(p["id"], p["score"]) for p in one["places"]],
                             [(p["id"], p["score"]) for p in other["places"]])


if __name__ == "__main__":
    unittest.main()
