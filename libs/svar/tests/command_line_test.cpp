// The spellings of parameters on the command line.
#include <gslam/svar/config.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using gslam::CommandLine;
using gslam::Config;
using gslam::ConfigError;
using gslam::Svar;

using Words = std::vector<std::string>;

// Parameters of every kind.
struct Player {
  Player() : config("player [options] DIR", "", "") {
    config.arg<double>("fps", 30, "frames a second").shortName("f");
    config.arg<int>("max_features", 1000, "features");
    config.arg<bool>("realtime", false, "pace");
    config.arg<std::string>("mode", "fast", "mode");
    config.arg<std::vector<double>>("camera.k", {1, 2}, "intrinsics");
    config.arg<Svar>("slam", Svar::object({{"levels", 8}}), "anything");
  }
  CommandLine parse(const Words& words) { return config.parse(words); }
  Config config;
};

std::string parseError(const Words& words) {
  Player player;
  const Svar before = player.config.snapshot();
  try {
    player.parse(words);
  } catch (const ConfigError& error) {
    EXPECT_EQ(player.config.snapshot(), before) << "changed by " << error.what();
    return error.what();
  }
  return "no error";
}

template <class T>
T parsed(const Words& words, const char* name) {
  Player player;
  const CommandLine line = player.parse(words);
  EXPECT_EQ(line.rest, Words());
  EXPECT_EQ(line.answer, "");
  return player.config.get<T>(name);
}

TEST(CommandLine, TakesAllSpellings) {
  const std::vector<Words> spellings = {
      {"--fps", "25.5"}, {"--fps=25.5"}, {"-fps", "25.5"}, {"-fps=25.5"},   {"fps=25.5"},
      {"-f", "25.5"},    {"-f=25.5"},    {"--f", "25.5"},  {"--fps=+25.5"}, {"--fps", "2.55e1"}};
  for (const Words& words : spellings) EXPECT_EQ(parsed<double>(words, "fps"), 25.5) << words[0];
}

TEST(CommandLine, TakesNumbersAsPeopleWriteThem) {
  const auto fps = [](const char* text) { return parsed<double>({"--fps", text}, "fps"); };
  EXPECT_EQ(fps("-3"), -3);
  EXPECT_EQ(fps("-.5"), -0.5);
  EXPECT_EQ(fps(".5"), 0.5);
  EXPECT_EQ(fps("5."), 5);
  EXPECT_EQ(fps("-5.e1"), -50);
  EXPECT_EQ(fps("+1e-3"), 1e-3);
  EXPECT_EQ(parsed<int>({"--max_features", "-2147483648"}, "max_features"), -2147483647 - 1);
  EXPECT_EQ(parsed<int>({"--max_features", "2e3"}, "max_features"), 2000);
}

TEST(CommandLine, RefusesWhatIsNoNumber) {
  for (const char* text :
       {"",    "abc", "1x", "0x10", "1e400", "inf", "nan", ".",    "+",   "+-3",  "--3",
        "1,5", " 1",  "1 ", "1e",   "++1",   "+.",  "-.",  "1..2", "NaN", "1_000"}) {
    const std::string expected = std::string("--fps: expected double, found \"") + text + "\"";
    EXPECT_EQ(parseError({std::string("--fps=") + text}), expected);
  }
  EXPECT_EQ(parseError({"--max_features=2.5"}), "--max_features: expected int32, found double 2.5");
  EXPECT_EQ(parseError({"--max_features=2147483648"}),
            "--max_features: expected int32, found int 2147483648");
}

TEST(CommandLine, TreatsDashesAndUnderscoresAlike) {
  EXPECT_EQ(parsed<int>({"--max-features", "5"}, "max_features"), 5);
  EXPECT_EQ(parsed<int>({"max-features=6"}, "max_features"), 6);
}

TEST(CommandLine, TakesAllSpellingsOfWhatIsInsideAndOfItsOwn) {
  Config config;
  config.arg<Svar>("my-slam", Svar::object({{"list", Svar::array({1, 2})}}), "");
  config.parse({"--my_slam.x=1", "my-slam.list.0=7"});
  EXPECT_EQ(config["my-slam"], Svar::object({{"list", Svar::array({7, 2})}, {"x", 1}}));
  EXPECT_THROW(config.parse({"--my-slam.list.2=7"}), ConfigError);
  EXPECT_THROW(config.parse({"--my-slam.x.y=7"}), ConfigError);
  EXPECT_THROW(config.parse({"config=/no/such/file.json"}), gslam::FileError);
  EXPECT_EQ(parseError({"help=1"}), "help: takes no value");
}

TEST(CommandLine, SetsAndClearsFlags) {
  for (const Words& words : std::vector<Words>{{"--realtime"},
                                               {"-realtime"},
                                               {"--realtime=true"},
                                               {"--realtime", "true"},
                                               {"--realtime", "on"},
                                               {"--realtime=1"},
                                               {"realtime=yes"}}) {
    EXPECT_TRUE(parsed<bool>(words, "realtime")) << words[0];
  }
  for (const Words& words : std::vector<Words>{{"--realtime", "--no-realtime"},
                                               {"--realtime", "--norealtime"},
                                               {"--realtime", "--no_realtime"},
                                               {"--realtime=false"},
                                               {"--realtime", "false"},
                                               {"--realtime=0"},
                                               {"-no-realtime"}}) {
    EXPECT_FALSE(parsed<bool>(words, "realtime")) << words.back();
  }
  EXPECT_EQ(parseError({"--realtime=maybe"}),
            "--realtime: expected true or false, found \"maybe\"");
  EXPECT_EQ(parseError({"--no-realtime=true"}), "--no-realtime: takes no value");
  EXPECT_EQ(parseError({"--no-fps"}), "--no-fps: is no parameter (--help lists them)");
}

TEST(CommandLine, FlagLeavesWhatIsNotItsValue) {
  Player player;
  EXPECT_EQ(player.parse({"--realtime", "folder", "1"}).rest, (Words{"folder", "1"}));
}

TEST(CommandLine, KeepsTheRestInOrder) {
  Player player;
  const CommandLine line =
      player.parse({"a", "--fps", "1", "-", "-7", "-.5", "b c", "--", "--fps", "--", "x=1"});
  EXPECT_EQ(line.rest, (Words{"a", "-", "-7", "-.5", "b c", "--fps", "--", "x=1"}));
  EXPECT_EQ(player.parse({"/a=b", "./fps=3", "1=2"}).rest, (Words{"/a=b", "./fps=3", "1=2"}));
}

TEST(CommandLine, LastOneCounts) {
  EXPECT_EQ(parsed<double>({"--fps", "1", "fps=2", "-f", "3"}, "fps"), 3);
}

TEST(CommandLine, NeedsAValueWhereOneIsExpected) {
  EXPECT_EQ(parseError({"--fps"}), "--fps: expected a value after it");
  EXPECT_EQ(parseError({"--mode", "--realtime"}),
            "--mode: expected a value, found --realtime; a value that begins with a dash is "
            "written --mode=--realtime");
  EXPECT_EQ(parsed<std::string>({"--mode=--realtime"}, "mode"), "--realtime");
  EXPECT_EQ(parsed<std::string>({"--mode", "-"}, "mode"), "-");
  EXPECT_EQ(parsed<std::string>({"--mode="}, "mode"), "");
  EXPECT_EQ(parsed<std::string>({"--mode", "a=b"}, "mode"), "a=b");
}

TEST(CommandLine, SuggestsTheNearestName) {
  EXPECT_EQ(parseError({"--fsp=1"}),
            "--fsp: is no parameter, did you mean --fps? (--help lists them)");
  EXPECT_EQ(parseError({"-raeltime"}),
            "-raeltime: is no parameter, did you mean -realtime? (--help lists them)");
  EXPECT_EQ(parseError({"max_feature=1"}),
            "max_feature: is no parameter, did you mean max_features? (--help lists them)");
  EXPECT_EQ(parseError({"--xyzzy"}), "--xyzzy: is no parameter (--help lists them)");
  EXPECT_EQ(parseError({"--camera.kk=1"}),
            "--camera.kk: is no parameter, did you mean --camera.k? (--help lists them)");
  EXPECT_EQ(parseError({"---fps=1"}),
            "---fps: is no parameter, did you mean --fps? "
            "(--help lists them)");
  EXPECT_EQ(parseError({"--=1"}), "--: is no parameter (--help lists them)");
}

TEST(CommandLine, TakesLists) {
  const auto k = [](const char* text) {
    return parsed<std::vector<double>>({"--camera.k", text}, "camera.k");
  };
  EXPECT_EQ(k("1,2.5,-3"), (std::vector<double>{1, 2.5, -3}));
  EXPECT_EQ(k("[1, 2.5]"), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(k("4"), std::vector<double>{4});
  EXPECT_EQ(k("-4,1"), (std::vector<double>{-4, 1}));
  EXPECT_EQ(k(""), std::vector<double>());
  EXPECT_EQ(parseError({"--camera.k=1,x"}), "--camera.k: expected double, found \"x\"");
  EXPECT_EQ(parseError({"--camera.k=1,"}),
            "--camera.k: expected an element behind the last comma, found \"1,\"");
  EXPECT_EQ(parseError({"--camera.k=[1,true]"}),
            "--camera.k: camera.k.1: expected double, found bool true");
  EXPECT_NE(parseError({"--camera.k=[1,"}), "no error");
}

TEST(CommandLine, TakesListsOfAllKinds) {
  Config config("", "", "");
  config.arg<std::array<int, 2>>("size", {{640, 480}}, "");
  config.arg<std::vector<bool>>("flags", {}, "");
  config.arg<std::vector<std::string>>("names", {}, "");
  config.parse({"--size=1,2", "--flags", "yes,off,1", "--names=a,,b c"});
  EXPECT_EQ((config.get<std::array<int, 2>>("size")), (std::array<int, 2>{{1, 2}}));
  EXPECT_EQ(config.get<std::vector<bool>>("flags"), (std::vector<bool>{true, false, true}));
  EXPECT_EQ(config.get<Words>("names"), (Words{"a", "", "b c"}));
  config.parse({"--names", R"(["a,b", ""])", "--flags="});
  EXPECT_EQ(config.get<Words>("names"), (Words{"a,b", ""}));
  EXPECT_EQ(config["flags"].size(), 0u);
  EXPECT_THROW(config.parse({"--size=1,2,3"}), ConfigError);
  EXPECT_NE(config.help().find("--size INT32,..."), std::string::npos);
}

TEST(CommandLine, ReachesIntoOpenParameters) {
  Player player;
  player.parse({"--slam.features", "2000", "--slam.matcher.name=orb", "slam.on=true",
                "--slam.list=[1,2]", "--slam.text=\"5\"", "--slam.nul=nul"});
  EXPECT_EQ(player.config["slam"], Svar::object({{"levels", 8},
                                                 {"features", 2000},
                                                 {"matcher", Svar::object({{"name", "orb"}})},
                                                 {"on", true},
                                                 {"list", Svar::array({1, 2})},
                                                 {"text", "5"},
                                                 {"nul", "nul"}}));
  EXPECT_EQ(parsed<int>({"--slam={\"levels\":3}", "--slam.x=1"}, "slam.levels"), 3);
  EXPECT_NE(parseError({"--slam={\"levels\":3"}), "no error");
  EXPECT_EQ(parseError({"--slam..x=1"}), "--slam..x: is no name");
}

TEST(CommandLine, AsksQuestions) {
  Player player;
  EXPECT_EQ(player.parse({"--help", "--fps", "25"}).answer.substr(0, 7), "Usage: ");
  EXPECT_EQ(player.config.get<int>("fps"), 25);  // so the help shows it
  EXPECT_EQ(player.parse({"-h"}).answer, player.config.help());
  EXPECT_EQ(player.parse({"--dump-config"}).answer, player.config.dump());
  EXPECT_EQ(player.parse({"--dump_config", "--help"}).answer, player.config.dump());
  EXPECT_EQ(player.parse({"--bash-completion"}).answer, player.config.bashCompletion());
  EXPECT_EQ(player.parse({"--", "--help"}).answer, "");
  EXPECT_EQ(parseError({"--help=1"}), "--help: takes no value");
}

TEST(CommandLine, OfMainBeginsWithTheProgram) {
  Config config;
  config.arg<int>("n", 1, "number");
  const char* const arguments[] = {"/usr/bin/counter", "--n", "3", "x", nullptr};
  EXPECT_EQ(config.parse(4, arguments).rest, Words{"x"});
  EXPECT_EQ(config.get<int>("n"), 3);
  EXPECT_EQ(config.help().substr(0, 25), "Usage: counter [options]\n");
  EXPECT_EQ(Config().parse(0, nullptr).rest, Words());
}

TEST(CommandLine, AnyTextIsAnErrorOrTakenNeverACrash) {
  const Words bits = {"-",    "--", "=", "fps",       "no-",  "realtime", ".",
                      "slam", "3",  "[", "{\"a\":1}", "\xFF", "",         "config",
                      "h",    "'",  ",", "camera.k",  " "};
  for (const std::string& a : bits) {
    for (const std::string& b : bits) {
      for (const std::string& c : bits) {
        Player player;
        try {
          player.parse({a + b + c, b});
        } catch (const gslam::Error& error) {
          EXPECT_STRNE(error.what(), "");
        }
      }
    }
  }
}

}  // namespace
