// Parameters: declaration, sources and their order, help, dump, completion.
#include <gslam/svar/config.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "error_text.h"

namespace {

using gslam::ArgumentError;
using gslam::Config;
using gslam::ConfigError;
using gslam::Svar;
using gslam::SvarError;

// A file that lives as long as this.
class File {
 public:
  File(const std::string& name, const std::string& text) : path_(testing::TempDir() + name) {
    std::ofstream(path_) << text;
  }
  ~File() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// An environment variable that lives as long as this.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Variable() { unsetenv(name_); }

 private:
  const char* name_;
};

std::string whatIsWrong(Config& config, const std::vector<std::string>& arguments) {
  try {
    config.parse(arguments);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Config, HasDefaultsBeforeParsing) {
  Config config;
  config.arg<double>("fps", 30, "frames a second");
  config.arg<std::string>("camera.model", "pinhole", "model");
  EXPECT_EQ(config.get<double>("fps"), 30);
  EXPECT_EQ(config["camera/model"], "pinhole");
  EXPECT_EQ(config.origin("fps"), "default");
}

TEST(Config, LaterSourcesWin) {
  const File first("first.json",
                   R"({"a": 1, "b": 1, "c": 1, "d": 1, "camera": {"fx": 1, "fy": 1}})");
  const File second("second.json", R"({"b": 2, "c": 2, "d": 2, "camera": {"fy": 2}})");
  const Variable c("GSLAM_C", "3");
  const Variable d("GSLAM_D", "3");
  const Variable fx("GSLAM_CAMERA_FX", "3.5");
  Config config;
  for (const char* name : {"a", "b", "c", "d", "e"}) config.arg<int>(name, 0, "number");
  config.arg<double>("camera.fx", 0, "focal length");
  config.arg<double>("camera.fy", 0, "focal length");
  config.parse({"--d=4", "--config", first.path(), "--config=" + second.path()});
  EXPECT_EQ(config.snapshot(), Svar::object({{"a", 1},
                                             {"b", 2},
                                             {"c", 3},
                                             {"d", 4},
                                             {"e", 0},
                                             {"camera", Svar::object({{"fx", 3.5}, {"fy", 2}})}}));
  EXPECT_EQ(config.origin("a"), first.path());
  EXPECT_EQ(config.origin("b"), second.path());
  EXPECT_EQ(config.origin("c"), "GSLAM_C");
  EXPECT_EQ(config.origin("d"), "command line");
  EXPECT_EQ(config.origin("e"), "default");
  EXPECT_EQ(config.origin("camera.fx"), "GSLAM_CAMERA_FX");
  config.set("a", 7);
  EXPECT_EQ(config.origin("a"), "program");
  EXPECT_THROW(config.origin("f"), ArgumentError);
}

TEST(Config, SaysWhereAWrongValueWasGiven) {
  const File wrong_type("type.json", R"({"camera": {"fx": "wide"}})");
  const File unknown("unknown.json", R"({"camera": {"fz": 1}})");
  const File too_large("large.json", R"({"fps": 1000})");
  const File list("list.json", "[1]");
  const File broken("broken.json", "{\"fps\": }");
  Config config;
  config.arg<double>("fps", 30, "frames a second").range(1, 120);
  config.arg<double>("camera.fx", 500, "focal length");
  const auto wrong = [&](const File& file) {
    return whatIsWrong(config, {"--fps=5", "--config", file.path()});
  };
  EXPECT_EQ(wrong(wrong_type),
            wrong_type.path() + ": camera.fx: expected double, found string \"wide\"");
  EXPECT_EQ(
      wrong(unknown),
      unknown.path() + ": camera.fz is no parameter, did you mean camera.fx? (--help lists them)");
  EXPECT_EQ(wrong(too_large), too_large.path() + ": fps: expected 1 to 120, found int 1000");
  EXPECT_EQ(wrong(list), list.path() + ": expected an object with parameters, found array of 1");
  EXPECT_THROW(config.parse({"--config", broken.path()}), gslam::ParseError);
  EXPECT_THROW(config.parse({"--config", "/no/such/file.json"}), gslam::FileError);
  EXPECT_THROW(config.parse({"--config", "file.toml"}), gslam::FileError);
  EXPECT_EQ(whatIsWrong(config, {"--fps", "0.5"}), "--fps: expected 1 to 120, found double 0.5");
  const Variable fps("GSLAM_FPS", "fast");
  EXPECT_EQ(whatIsWrong(config, {}), "GSLAM_FPS: expected double, found \"fast\"");
  EXPECT_EQ(config.get<double>("fps"), 30);  // nothing was taken over
}

TEST(Config, EnvironmentMayHaveAnotherNameOrNone) {
  const Variable mine("MINE_FPS", "5");
  const Variable gslam("GSLAM_FPS", "6");
  Config named("", "", "MINE_");
  Config none("", "", "");
  named.arg<int>("fps", 1, "");
  none.arg<int>("fps", 1, "");
  named.parse({});
  none.parse({});
  EXPECT_EQ(named.get<int>("fps"), 5);
  EXPECT_EQ(none.get<int>("fps"), 1);
}

TEST(Config, TakesFilesWithDottedNames) {
  const File file("dotted.json", R"({"Camera.fx": 517.3, "Camera": {"fy": 516.5}, "slam.x.y": 1})");
  Config config;
  config.arg<double>("Camera.fx", 0, "");
  config.arg<double>("Camera.fy", 0, "");
  config.arg<Svar>("slam", nullptr, "");
  config.loadFile(file.path());
  EXPECT_EQ(config.get<double>("Camera.fx"), 517.3);
  EXPECT_EQ(config.get<double>("Camera.fy"), 516.5);
  EXPECT_EQ(config.get<int>("slam.x.y"), 1);
}

TEST(Config, KeepsToTypesWhenTheProgramWrites) {
  Config config;
  config.arg<int>("level", 3, "").range(0, 8);
  config.arg<std::string>("mode", "fast", "").choices({"fast", "slow"});
  EXPECT_EQ(errorText([&] { config.set("level", 9); }), "level: expected 0 to 8, found int 9");
  EXPECT_EQ(errorText([&] { config.set("mode", "idle"); }),
            "mode: expected one of \"fast\", \"slow\", found string \"idle\"");
  EXPECT_THROW(config.set("level", "3"), SvarError);
  EXPECT_THROW(config.erase("level"), SvarError);
  config.set("level", 8);
  const auto& level = config.bind<int>("level");
  config.parse({"--level", "2"});
  EXPECT_EQ(level, 2);
}

TEST(Config, RefusesDeclarationsThatCannotBe) {
  Config config;
  config.arg<int>("fps", 1, "").shortName("f");
  config.arg<int>("camera.fx", 1, "");
  for (const char* name :
       {"", ".", "a.", ".a", "a..b", "1a", "-a", "a b", "a=b", "a/b", "\xC3\xA4", "a.-b"}) {
    EXPECT_THROW(config.arg<int>(name, 1, ""), ArgumentError) << name;
  }
  for (const char* name :
       {"fps", "f", "help", "config", "dump-config", "dump_config", "camera", "fps.x"}) {
    EXPECT_THROW(config.arg<int>(name, 1, ""), ArgumentError) << name;
  }
  EXPECT_THROW(config.arg<int>("g", 1, "").shortName("fps"), ArgumentError);
  EXPECT_THROW(config.arg<int>("level", 9, "").range(0, 8), SvarError);
  EXPECT_THROW(config.arg<double>("nan", 0.0 / 1, "").range(1, 8), SvarError);
  EXPECT_THROW(config.arg<std::string>("mode", "c", "").choices({"a", "b"}), SvarError);
}

TEST(Config, RefusesNamesThatMeanTheSame) {
  Config config;
  config.arg<bool>("realtime", true, "");
  config.arg<int>("no-slam", 1, "").shortName("x-y");
  for (const char* name : {"no-realtime", "no_realtime", "x_y", "no_slam"}) {
    EXPECT_THROW(config.arg<int>(name, 1, ""), ArgumentError) << name;
  }
  EXPECT_THROW(config.arg<bool>("slam", false, ""), ArgumentError);
  EXPECT_NO_THROW(config.arg<int>("norealtime", 1, ""));
  config.arg<Svar>("my-cam", nullptr, "");
  EXPECT_THROW(config.arg<int>("my_cam.fx", 1, ""), ArgumentError);
}

TEST(Config, DeclaresNothingWhereItFails) {
  Config config("player", "", "");
  config.set("fps", "fast");
  config.set("level", 9);
  EXPECT_THROW(config.arg<double>("fps", 30, ""), SvarError);
  EXPECT_THROW(config.arg<std::uint64_t>("large", ~std::uint64_t(0), ""), SvarError);
  EXPECT_THROW(config.arg<int>("level", 3, "").range(0, 8), SvarError);  // it is 9 already
  EXPECT_EQ(config.help().find("--fps"), std::string::npos);
  EXPECT_EQ(whatIsWrong(config, {"--large=1"}), "--large: is no parameter (--help lists them)");
  EXPECT_THROW(config.origin("fps"), ArgumentError);
  config.bind<std::map<std::string, std::string>>("texts", {});
  EXPECT_THROW(config.arg<int>("texts.n", 1, ""), SvarError);
  EXPECT_NO_THROW(config.set("other", 1));
}

TEST(Config, TakesNothingOverWhereSomethingIsMissing) {
  Config config("player", "", "");
  config.arg<int>("needed", "");
  config.arg<int>("fps", 30, "");
  EXPECT_EQ(whatIsWrong(config, {"--fps=25"}), "--needed: must be given");
  EXPECT_EQ(config.get<int>("fps"), 30);
  EXPECT_EQ(config.origin("fps"), "default");
}

TEST(Config, SaysWhereABoundVariableRefusedAValue) {
  const File file("bound.json", R"({"camera": {"fx": 2.5}})");
  Config config("player", "", "");
  config.arg<double>("camera.fx", 1, "");
  config.bind<int>("camera.fx");
  EXPECT_EQ(whatIsWrong(config, {"--camera.fx=2.5"}),
            "--camera.fx: expected int32, found double 2.5");
  EXPECT_EQ(whatIsWrong(config, {"--config", file.path()}),
            file.path() + ": camera.fx: expected int32, found double 2.5");
  EXPECT_EQ(config.get<double>("camera.fx"), 1);
}

TEST(Config, KnowsOriginsInCallbacks) {
  Config config;
  config.arg<int>("n", 1, "");
  config.arg<double>("nan", std::nan(""), "");
  std::string seen;
  const gslam::Watch watch = config.watch("n", [&](const Svar&) { seen = config.origin("n"); });
  config.parse({"--n=2"});
  EXPECT_EQ(seen, "command line");
  EXPECT_EQ(config.origin("nan"), "default");
}

TEST(Config, FilesMayNestAndSpellNamesAsTheyLike) {
  Config config;
  config.arg<int>("my_cam.fx", 1, "");
  config.arg<Svar>("my_slam", nullptr, "");
  const auto load = [&](const std::string& text) {
    const File file("spelled.json", text);
    try {
      config.loadFile(file.path());
    } catch (const ConfigError& error) {
      return std::string(error.what()).substr(file.path().size() + 2);
    }
    return config["my_cam.fx"].as<int>() == 2 ? std::string("2") : std::string("1");
  };
  EXPECT_EQ(load("null"), "1");
  EXPECT_EQ(load("{}"), "1");
  EXPECT_EQ(load(R"({"my_cam": null, "my_slam": null})"), "1");
  EXPECT_EQ(load(R"({"my-cam": {"fx": 2}, "my-slam.x": 3})"), "2");
  EXPECT_EQ(config["my_slam"], Svar::object({{"x", 3}}));
  EXPECT_EQ(load(R"({"my_cam": 5})"), "my_cam: expected an object with parameters, found int 5");
  EXPECT_EQ(load(R"({"my_slam.a/b": 5})"), "my_slam.a/b is no name");
  EXPECT_EQ(config.snapshot().size(), 2u);
}

TEST(Config, LargeFilesTakeTimeInProportion) {
  const int count = 20000;
  Svar values = Svar::object();
  for (int i = 0; i < count; ++i) values.set("/slam.n" + std::to_string(i), i);
  const File file("huge.json", gslam::printJson(values));
  Config config;
  config.arg<Svar>("slam", nullptr, "");
  config.loadFile(file.path());  // took minutes
  EXPECT_EQ(config["slam"].size(), static_cast<std::size_t>(count));
}

TEST(Config, MayBeParsedAgain) {
  Config config("player", "", "");
  config.arg<int>("a", 1, "");
  config.arg<int>("b", 1, "");
  config.set("a", 2);
  config.parse({"--b=3"});
  EXPECT_EQ(config.get<int>("a"), 2);
  EXPECT_EQ(config.origin("a"), "program");
  config.parse({"--a=4"});
  EXPECT_EQ(config.get<int>("b"), 3);
  EXPECT_EQ(config.origin("a"), "command line");
  EXPECT_EQ(config.origin("b"), "command line");
}

TEST(Config, MissingParameterIsAnError) {
  Config config("player", "", "");
  config.arg<std::string>("calibration", "file of the camera");
  EXPECT_FALSE(config.contains("calibration"));
  EXPECT_EQ(whatIsWrong(config, {}), "--calibration: must be given: file of the camera");
  EXPECT_NE(config.parse({"--help"}).answer, "");
  EXPECT_THROW(config.set("calibration", 3), SvarError);
  config.parse({"--calibration", "a.yaml"});
  EXPECT_EQ(config.get<std::string>("calibration"), "a.yaml");
}

TEST(Config, MapsAndStructsAreGivenAsJson) {
  Config config;
  config.arg<std::map<std::string, int>>("sizes", {{"a", 1}}, "");
  config.parse({"--sizes={\"b\": 2}"});
  EXPECT_EQ((config.get<std::map<std::string, int>>("sizes")),
            (std::map<std::string, int>{{"a", 1}, {"b", 2}}));
  EXPECT_EQ(whatIsWrong(config, {"--sizes={\"b\": 2.5}"}),
            "--sizes: sizes.b: expected int32, found double 2.5");
}

TEST(Config, DumpIsReadBack) {
  Config config;
  config.arg<double>("stamp", 1305031102.175304, "");
  config.arg<std::vector<std::string>>("names", {"a", "b"}, "");
  config.arg<Svar>("slam", Svar::object({{"deep", Svar::object({{"x", nullptr}})}}), "");
  config.arg<bool>("camera.on", true, "");
  config.arg<int>("needed", "");
  const std::string fresh = config.dump();
  config.parse({"--no-camera.on", "--slam.deep.y", "2", "--needed=3", "--names=c"});
  const File file("dump.json", config.dump());
  Config again;
  again.arg<double>("stamp", 0, "");
  again.arg<std::vector<std::string>>("names", {}, "");
  again.arg<Svar>("slam", Svar::object({{"deep", Svar::object({{"x", nullptr}})}}), "");
  again.arg<bool>("camera.on", true, "");
  again.arg<int>("needed", "");
  again.parse({"--config", file.path()});
  EXPECT_EQ(again.snapshot(), config.snapshot());
  EXPECT_EQ(fresh.find("needed"), std::string::npos);
}

Config& declarePlayer(Config& config) {
  config.arg<double>("fps", 30, "frames a second").range(1, 120).shortName("f");
  config.arg<bool>("realtime", false, "pace frames by their stamps");
  config
      .arg<std::string>("mode", "fast",
                        "how frames are chosen, which is a long story with many words")
      .choices({"fast", "slow"})
      .shortName("m");
  config.arg<std::vector<int>>("levels", {1, 2}, "of the pyramid").group("Tracker");
  config.arg<Svar>("slam", nullptr, "parameters of the SLAM system").group("Tracker");
  config.arg<std::string>("a-very-long-name-of-a-parameter", "", "z\xC3\xBCrich").group("Tracker");
  config.arg<int>("size", "of it");
  return config;
}

TEST(Help, IsGroupedAlignedAndWrapped) {
  Config config("player [options] DIR", "Plays a sequence.", "X_");
  declarePlayer(config).parse({"--fps=25", "--help"});
  EXPECT_EQ(config.help(72), R"(Usage: player [options] DIR
Plays a sequence.

Options:
  -f, --fps DOUBLE    frames a second (1 to 120; default 30; now 25 from
                      command line)
  --realtime, --no-realtime
                      pace frames by their stamps (default false)
  -m, --mode STRING   how frames are chosen, which is a long story with
                      many words (one of "fast", "slow"; default "fast")
  --size INT32        of it (required)

Tracker:
  --levels INT32,...  of the pyramid (default [1,2])
  --slam VALUE, --slam.NAME VALUE
                      parameters of the SLAM system
  --a-very-long-name-of-a-parameter STRING
                      zürich (default "")

General:
  --config FILE       read parameters from a file; may be given several
                      times
  --dump-config       print all values as JSON, which --config reads,
                      and end
  --bash-completion   print a script for bash, to be sourced, and end
  -h, --help          print this and end

Later ones win: defaults, files, environment (X_NAME), command line.
)");
}

TEST(Help, TakesOddDeclarations) {
  Config config("player", "", "");
  config.arg<Svar>("threshold", 5, "");
  config.arg<Svar>("slam", Svar::object(), "");
  config.arg<int>("height", 1, "").shortName("h");
  config.arg<int>("needed", "");
  config.arg<double>("nan", std::nan(""), "none yet");
  const std::string help = config.help();
  EXPECT_EQ(help.substr(0, help.find("General")), R"(Usage: player

Options:
  --threshold VALUE, --threshold.NAME VALUE
                      (default 5)
  --slam VALUE, --slam.NAME VALUE
  -h, --height INT32  (default 1)
  --needed INT32      (required)
  --nan DOUBLE        none yet (default double nan)

)");
  EXPECT_EQ(help.find("-h, --help"), std::string::npos);
}

TEST(Help, FitsItsWidth) {
  Config config("player [options] DIR", std::string(300, 'x') + " " + std::string(30, 'y'));
  declarePlayer(config);
  for (const std::size_t width : {0u, 40u, 60u, 100u, 1000u}) {
    std::size_t lines = 0;
    std::string line;
    for (const char c : config.help(width)) {
      if (c != '\n') line.push_back(c);
      if (c != '\n') continue;
      const std::size_t most = width < 40 ? 40 : width;
      EXPECT_TRUE(line.size() <= most + 1 || line.find("xxx") == 0 ||
                  line.find("--a-very") != std::string::npos)
          << line;
      EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
      line.clear();
      ++lines;
    }
    EXPECT_GT(lines, 20u);
  }
}

// --- completion, by bash itself

std::string outputOf(const std::string& command) {
  std::string output;
  std::FILE* const pipe = popen(command.c_str(), "r");
  char buffer[256];
  while (std::fgets(buffer, sizeof(buffer), pipe) != nullptr) output += buffer;
  pclose(pipe);
  return output;
}

// What bash offers for the last of the words.
std::string offers(const Config& config, const std::string& words, int last) {
  const File script("completion.sh", config.bashCompletion());
  return outputOf("cd " + testing::TempDir() +
                  " && bash --norc -c 'set -u; . ./completion.sh; COMP_WORDS=(" + words +
                  "); COMP_CWORD=" + std::to_string(last) +
                  "; _player_complete; printf \"%s\\n\" \"${COMPREPLY[@]}\"' 2>&1");
}

TEST(BashCompletion, OffersNamesChoicesAndFiles) {
  if (std::system("bash --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no bash";
  Config config("player [options] DIR");
  declarePlayer(config);
  config.arg<std::string>("kind", "it'\"s", "").choices({"it'\"s", "a $(b) *", "third"});
  config.arg<double>("ratio", 1, "").choices({1, 0.5});
  EXPECT_EQ(offers(config, "player --re", 1), "--realtime\n");
  EXPECT_EQ(offers(config, "player --no", 1), "--no-realtime\n");
  EXPECT_EQ(offers(config, "player x --f", 2), "--fps\n");
  EXPECT_EQ(offers(config, "player --mode \"\"", 2), "fast\nslow\n");
  EXPECT_EQ(offers(config, "player --mode s", 2), "slow\n");
  EXPECT_EQ(offers(config, "player --mode = s", 3), "slow\n");
  EXPECT_EQ(offers(config, "player --mode =", 2), "fast\nslow\n");
  EXPECT_EQ(offers(config, "player --kind \"\"", 2), "it'\"s\na $(b) *\nthird\n");
  EXPECT_EQ(offers(config, "player -m s", 2), "slow\n");
  EXPECT_EQ(offers(config, "player -m = f", 3), "fast\n");
  EXPECT_EQ(offers(config, "player --ratio \"\"", 2), "1\n0.5\n");
  EXPECT_EQ(offers(config, "player completion.s", 1), "completion.sh\n");
  EXPECT_NE(offers(config, "player -", 1).find("--bash-completion\n"), std::string::npos);
}

}  // namespace
