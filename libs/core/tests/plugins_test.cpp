// Plugins: real libraries, found, checked and loaded; and files that only look like some.
#include <gmock/gmock.h>
#include <gslam/core/plugins.h>
#include <gslam/svar/json.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "problem_when.h"
#include "resident_bytes.h"

namespace {

using gslam::BuildFacts;
using gslam::PluginEntry;
using gslam::Plugins;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// A folder that is gone at the end, with all its files.
class Folder {
 public:
  Folder() {
    std::string pattern = testing::TempDir() + "gslam_plugins_XXXXXX";
    path_ = ::mkdtemp(&pattern[0]);
  }
  ~Folder() {
    for (const std::string& file : files_) std::remove(file.c_str());
    ::rmdir(path_.c_str());
  }
  const std::string& path() const { return path_; }
  std::string add(const std::string& name, const std::string& content) {
    files_.push_back(path_ + "/" + name);
    std::ofstream(files_.back(), std::ios::binary) << content;
    return files_.back();
  }
  std::string link(const std::string& name, const std::string& to) {
    files_.push_back(path_ + "/" + name);
    EXPECT_EQ(::symlink(to.c_str(), files_.back().c_str()), 0);
    return files_.back();
  }

 private:
  std::string path_;
  std::vector<std::string> files_;
};

const std::string kToy = GSLAM_TEST_PLUGIN_TOY;
const std::vector<std::string> kNowhere;

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

// The toy's file with its entry changed: how it would look, had it been built otherwise.
std::string changedToy(const std::function<void(PluginEntry&)>& change) {
  std::string content = contentOf(kToy);
  const std::string magic("GSLAMPG", 8);
  std::size_t place = content.find(magic);
  while (place != std::string::npos && place + sizeof(PluginEntry) <= content.size()) {
    PluginEntry entry;
    std::memcpy(static_cast<void*>(&entry), &content[place], sizeof(entry));
    if (entry.size == sizeof(entry) && std::string(entry.name) == "toy") {
      change(entry);
      std::memcpy(&content[place], static_cast<const void*>(&entry), sizeof(entry));
      return content;
    }
    place = content.find(magic, place + 1);
  }
  ADD_FAILURE() << "the toy has no entry";
  return content;
}

// What load() says of a file; empty where it loads.
std::string refusalOf(const std::string& path) {
  Plugins plugins(kNowhere);
  try {
    plugins.load(path);
    return "";
  } catch (const gslam::FileError& error) {
    EXPECT_EQ(error.path(), path);
    return error.what();
  }
}

std::string refusalOf(const std::function<void(PluginEntry&)>& change) {
  Folder folder;
  ::unsetenv("GSLAM_TEST_TOY_RAN");
  const std::string refusal = refusalOf(folder.add("toy.so", changedToy(change)));
  if (!refusal.empty()) {
    EXPECT_EQ(std::getenv("GSLAM_TEST_TOY_RAN"), nullptr) << "its code ran";
  }
  return refusal;
}

TEST(Plugins, LoadFromAFile) {
  Plugins plugins(kNowhere);
  const gslam::Plugin& toy = plugins.load(kToy);
  EXPECT_EQ(toy.name, "toy");
  EXPECT_EQ(toy.version, "2.3.4");
  EXPECT_EQ(toy.description, "A toy for tests");
  EXPECT_EQ(toy.path, kToy);
  ASSERT_EQ(toy.factories.slams().size(), 3u);
  EXPECT_EQ(toy.factories.slams()[0].name, "toy");
  EXPECT_EQ(toy.factories.datasets().size(), 1u);
  EXPECT_EQ(plugins.application("toy_waiter").make()->run({}), 42);
  EXPECT_EQ(plugins.dataset("toy_data").open("", {})->next(), nullptr);
  EXPECT_NE(plugins.slam("toy").make(), nullptr);
}

TEST(Plugins, WhatTheyMakeOutlivesThem) {
  std::unique_ptr<gslam::Slam> slam;
  {
    Plugins plugins(kNowhere);
    slam = plugins.slam(kToy + ":toy").make();
  }
  slam->configure({});
  slam->finish();
}

TEST(Plugins, AreFoundByAnyOfTheirFileNames) {
  for (const std::string name : {"libgslam_x.so", "libx.so", "gslam_x.so", "x.so"}) {
    Folder empty, folder;
    folder.link(name, kToy);
    Plugins plugins({empty.path(), folder.path() + "/not there", folder.path()});
    EXPECT_EQ(plugins.load("x").name, "toy") << name;
  }
}

TEST(Plugins, OfAnEarlierFolderComeFirst) {
  Folder first, second;
  first.link("libgslam_x.so", kToy);
  second.link("libgslam_x.so", GSLAM_TEST_PLUGIN_NATIVE);
  EXPECT_EQ(Plugins({first.path(), second.path()}).load("x").name, "toy");
  EXPECT_EQ(Plugins({second.path(), first.path()}).load("x").name, "native");
}

TEST(Plugins, AreLookedForWhereTheEnvironmentSays) {
  ::setenv("GSLAM_PLUGIN_PATH", "/one::/two/x:", 1);
  const std::vector<std::string> folders = gslam::defaultPluginFolders();
  ::unsetenv("GSLAM_PLUGIN_PATH");
  ASSERT_GE(folders.size(), 2u);
  EXPECT_EQ(folders[0], "/one");
  EXPECT_EQ(folders[1], "/two/x");
#ifdef __linux__
  ASSERT_GE(folders.size(), 4u);
  char own[4096] = {};
  ASSERT_GT(::readlink("/proc/self/exe", own, sizeof(own) - 1), 0);
  const std::string program = own, beside = program.substr(0, program.rfind('/'));
  EXPECT_EQ(folders[2], beside);
  EXPECT_EQ(folders[3], beside.substr(0, beside.rfind('/')) + "/lib/gslam/plugins");
#endif
}

TEST(Plugins, AreOneByWhateverPath) {
  Folder folder;
  Plugins plugins({folder.path()});
  const gslam::Plugin& toy = plugins.load(kToy);
  EXPECT_EQ(&plugins.load(folder.link("libother.so", kToy)), &toy);
  EXPECT_EQ(&plugins.load("other"), &toy);
  EXPECT_TRUE(plugins.loadAll().empty());
  std::size_t from_files = 0;
  for (const gslam::Plugin& plugin : plugins.loaded()) from_files += !plugin.path.empty();
  EXPECT_EQ(from_files, 1u);
}

TEST(Plugins, OfTheSameNameAreRefused) {
  Folder folder;
  const std::string twin = folder.add("twin.so", contentOf(kToy));
  Plugins plugins(kNowhere);
  plugins.load(kToy);
  EXPECT_THAT(problemWhen([&] { plugins.load(twin); }),
              AllOf(HasSubstr(twin), HasSubstr("'toy'"), HasSubstr(kToy)));
}

TEST(Plugins, MayBePartOfTheProgram) {  // see linked_plugin_test.cpp
  Plugins plugins(kNowhere);
  ASSERT_EQ(plugins.loaded().size(), 1u);
  EXPECT_EQ(plugins.loaded()[0].name, "linked");
  EXPECT_EQ(plugins.loaded()[0].path, "");
  EXPECT_EQ(&plugins.load("linked"), &plugins.loaded()[0]);
  EXPECT_EQ(plugins.application("linked_app").name, "linked_app");
}

TEST(Plugins, AreRefusedWhenTheyWereBuiltOtherwise) {
  const BuildFacts ours = gslam::thisBuild();
  const std::string major = std::to_string(ours.core.major);
  EXPECT_EQ(refusalOf([](PluginEntry& e) { e.built.core.minor += 1; }), "");

  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.magic[3] = 'X'; }), HasSubstr("GSLAMPG"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.interface_version = 77; }),
              AllOf(HasSubstr("version 77"), HasSubstr("version 1"), HasSubstr("rebuild")));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.size -= 8; }), HasSubstr("bytes"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.core.major += 1; }),
              AllOf(HasSubstr("core " + std::to_string(ours.core.major + 1)),
                    HasSubstr("core " + gslam::toText(ours.core)),
                    HasSubstr("rebuild it with core " + major + ".x")));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.messenger.minor += 1; }),
              AllOf(HasSubstr("messenger"), HasSubstr(gslam::toText(ours.messenger))));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.base.major += 1; }), HasSubstr("base"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.svar.major += 1; }), HasSubstr("svar"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.geometry.major += 1; }),
              HasSubstr("geometry"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { std::strcpy(e.built.standard_library, "libz++"); }),
              AllOf(HasSubstr("libz++"), HasSubstr(ours.standard_library)));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.standard_library_abi += 1; }),
              HasSubstr("ABI"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.string_abi ^= 1; }),
              AllOf(HasSubstr("_GLIBCXX_USE_CXX11_ABI=0"), HasSubstr("_GLIBCXX_USE_CXX11_ABI=1")));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.debug_mode ^= 1; }),
              AllOf(HasSubstr("with the debug mode"), HasSubstr("without it")));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.pointer_size = 4; }), HasSubstr("processor"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.byte_order = 2; }), HasSubstr("processor"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) { e.built.layout += 1; }), HasSubstr("other sizes"));
  EXPECT_THAT(refusalOf([](PluginEntry& e) {
                e.built.sanitizer = gslam::thisBuild().sanitizer == 1 ? 2 : 1;
              }),
              HasSubstr("sanitizer"));
}

TEST(Plugins, AreRefusedWhenTheyAreNone) {
  Folder folder;
  const std::string here = folder.path();
  EXPECT_THAT(refusalOf(here + "/none.so"), HasSubstr("does not exist"));
  EXPECT_THAT(refusalOf(here + "/"), HasSubstr("is a folder"));
  EXPECT_THAT(refusalOf("/dev/null"), HasSubstr("neither a file"));
  EXPECT_THAT(refusalOf(folder.add("empty.so", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusalOf(folder.add("text.so", "#!/bin/sh\necho hello\n")), HasSubstr("no shared"));
  EXPECT_THAT(refusalOf(folder.add("short.so", "\177ELF")), HasSubstr("cut off"));
  EXPECT_THAT(refusalOf(folder.add("zeros.so", "\177ELF" + std::string(5000, '\0'))),
              HasSubstr("another kind of processor"));
  EXPECT_THAT(refusalOf(GSLAM_TEST_PLUGIN_NONE), HasSubstr("does not export `gslam_plugin`"));
  EXPECT_THAT(refusalOf(GSLAM_TEST_PLUGIN_FUNCTION), HasSubstr("not as data"));
}

#ifdef __linux__
TEST(Plugins, AreRefusedWhenTheyWereBuiltForAnotherProcessor) {
  std::string content = contentOf(kToy);
  content[18] = char(0xF3);  // e_machine: RISC-V
  content[19] = 0;
  Folder folder;
  EXPECT_THAT(refusalOf(folder.add("riscv.so", content)), HasSubstr("another kind of processor"));
  content = contentOf(kToy);
  content[16] = 2;  // e_type: a program
  EXPECT_THAT(refusalOf(folder.add("program.so", content)), HasSubstr("no shared library"));
}

TEST(Plugins, AreRefusedWhereverTheyWereCutOff) {
  const std::string content = contentOf(kToy);
  Folder folder;
  for (std::size_t size = 0; size < content.size(); size += size < 300 ? 1 : content.size() / 60) {
    EXPECT_NE(refusalOf(folder.add("cut.so", content.substr(0, size))), "") << size;
  }
}

TEST(Plugins, AreReadSafelyHoweverDamaged) {
  const std::string content = contentOf(kToy);
  std::mt19937 random(1);
  Folder folder;
  std::uint64_t sections = 0;  // e_shoff
  std::memcpy(&sections, &content[40], sizeof(sections));
  for (int i = 0; i < 300; ++i) {
    std::string damaged = content;
    for (int k = 0; k < 4; ++k) {
      const std::size_t from = i % 2 == 0 ? 16 : std::size_t(sections);
      const std::size_t span = i % 2 == 0 ? 48 : content.size() - from;
      damaged[from + random() % span] = char(random());
    }
    const std::string path = folder.add("damaged.so", damaged);
    EXPECT_NO_THROW(gslam::detail::readPluginFile(path));
  }
}
#endif

TEST(Plugins, ThatThrowLeaveAllAsItWas) {
  Plugins plugins(kNowhere);
  plugins.load(kToy);
  const std::size_t slams = plugins.registry().slams().size();
  const std::string failure = problemWhen([&] { plugins.load(GSLAM_TEST_PLUGIN_THROWS); });
  EXPECT_THAT(failure, AllOf(HasSubstr(GSLAM_TEST_PLUGIN_THROWS), HasSubstr("'broken'"),
                             HasSubstr("no batteries")));
  EXPECT_EQ(plugins.registry().slams().size(), slams);
  EXPECT_EQ(plugins.loaded().size(), 2u);
}

TEST(Plugins, MayNotBringANameThatIsTaken) {
  Plugins plugins(kNowhere);
  gslam::SlamFactory own;
  own.name = "toy_crashes";
  own.make = [] { return std::unique_ptr<gslam::Slam>(); };
  plugins.add(own);
  const std::string failure = problemWhen([&] { plugins.load(kToy); });
  EXPECT_THAT(failure, AllOf(HasSubstr("'toy_crashes'"), HasSubstr("this program")));
  EXPECT_EQ(plugins.registry().slams().size(), 1u);
  EXPECT_EQ(plugins.registry().datasets().size(), 0u);
}

TEST(Plugins, LoadAllSaysWhoWasRefused) {
  Folder folder;
  folder.link("libgslam_toy.so", kToy);
  const std::string text = folder.add("text.so", "hello");
  const std::string broken = folder.link("throws.so", GSLAM_TEST_PLUGIN_THROWS);
  folder.add("readme.txt", "hello");
  Plugins plugins({folder.path(), "/not/there", folder.path()});
  const auto& refused = plugins.loadAll();
  ASSERT_EQ(refused.size(), 2u);
  EXPECT_EQ(refused[0].path, text);
  EXPECT_THAT(refused[0].reason, AllOf(HasSubstr("no shared library"), Not(HasSubstr(text))));
  EXPECT_EQ(refused[1].path, broken);
  EXPECT_THAT(refused[1].reason, HasSubstr("no batteries"));
  EXPECT_EQ(plugins.registry().slams().size(), 3u);
  EXPECT_EQ(plugins.loadAll().size(), 2u);  // the same again
  EXPECT_EQ(plugins.registry().slams().size(), 3u);
}

TEST(Plugins, AreResolvedByNameOrPath) {
  Folder folder;
  folder.link("libgslam_x.so", kToy);
  EXPECT_EQ(Plugins({folder.path()}).dataset("x").name, "toy_data");          // its only one
  EXPECT_EQ(Plugins({folder.path()}).slam("toy_throws").name, "toy_throws");  // of all plugins
  EXPECT_EQ(Plugins(kNowhere).application(kToy).name, "toy_waiter");
  EXPECT_EQ(Plugins(kNowhere).slam(kToy + ":toy_throws").name, "toy_throws");
  Plugins plugins({folder.path()});
  EXPECT_THAT(problemWhen([&] { plugins.slam(kToy); }),
              AllOf(HasSubstr("several"), HasSubstr(kToy + ":toy"), HasSubstr("toy_throws")));
  EXPECT_THAT(problemWhen([&] { plugins.slam("x"); }), HasSubstr("several"));
  EXPECT_THAT(
      problemWhen([&] { plugins.slam(kToy + ":toy_thrws"); }),
      AllOf(HasSubstr("no SLAM system 'toy_thrws'"), HasSubstr("did you mean toy_throws?")));
  EXPECT_THAT(problemWhen([&] { plugins.slam("./none.so"); }), HasSubstr("does not exist"));
  EXPECT_THAT(problemWhen([&] { plugins.slam(""); }), HasSubstr("is empty"));
  EXPECT_THAT(problemWhen([&] { plugins.load(""); }), HasSubstr("is empty"));
}

TEST(Plugins, ThatAreMissingSayWhereTheyWereLookedFor) {
  Folder folder;
  folder.link("libgslam_x.so", kToy);
  folder.add("text.so", "hello");
  Plugins plugins({folder.path(), "/not/there"});
  EXPECT_THAT(problemWhen([&] { plugins.slam("toi"); }),
              AllOf(HasSubstr("no SLAM system 'toi'"), HasSubstr("did you mean toy?"),
                    HasSubstr(folder.path()), HasSubstr("/not/there (does not exist)"),
                    HasSubstr("GSLAM_PLUGIN_PATH"), HasSubstr("text.so: is no shared library")));
  EXPECT_THAT(problemWhen([&] { plugins.load("toi"); }),
              AllOf(HasSubstr("libgslam_toi.so"), HasSubstr(folder.path())));
}

TEST(Plugins, RecognizeDatasets) {
  Folder folder;
  const std::string path = folder.add("toy_data.bin", "x");
  Plugins plugins({folder.path()});
  EXPECT_THAT(problemWhen([&] { plugins.datasetFor(path); }), HasSubstr("none"));
  plugins.load(kToy);
  EXPECT_EQ(plugins.datasetFor(path).name, "toy_data");
  EXPECT_THAT(problemWhen([&] { plugins.datasetFor(kToy); }),
              AllOf(HasSubstr(kToy), HasSubstr("toy_data")));
  EXPECT_THAT(problemWhen([&] { plugins.datasetFor("/not/there"); }), HasSubstr("does not exist"));
  gslam::DatasetFactory other = plugins.dataset("toy_data");
  other.name = "other";
  plugins.add(other);
  other.name = "thrower";
  other.recognizes = [](const std::string&) -> bool { throw gslam::Error("no"); };
  plugins.add(other);
  EXPECT_THAT(problemWhen([&] { plugins.datasetFor(path); }), HasSubstr("toy_data, other"));
}

TEST(Plugins, ExceptionsKeepTheirTypes) {
  Plugins plugins(kNowhere);
  const gslam::SlamFactory factory = plugins.slam(kToy + ":toy_throws");
  EXPECT_THROW(factory.make(), gslam::ArgumentError);
}

TEST(Plugins, LogIntoTheProgramsLog) {
  std::vector<std::string> records;
  Plugins before(kNowhere);
  const gslam::SlamFactory factory = before.slam(kToy + ":toy");
  gslam::setLogSink([&](const gslam::LogRecord& record) { records.push_back(record.message); });
  factory.make()->configure({});
  EXPECT_TRUE(records.empty());
  before.connectLogs();
  factory.make()->configure({});
  gslam::setLogSink(nullptr);
  before.connectLogs();
  factory.make()->configure({});
  EXPECT_THAT(records, testing::ElementsAre("the toy is configured"));
}

TEST(Plugins, AreDescribedForMachines) {
  Folder folder;
  folder.add("text.so", "hello");
  folder.link("toy.so", kToy);
  Plugins plugins({folder.path()});
  gslam::ApplicationFactory own;
  own.name = "own";
  own.make = [] { return std::unique_ptr<gslam::Application>(); };
  plugins.add(own);
  plugins.loadAll();
  const gslam::Svar all = gslam::parseJson(gslam::printJson(gslam::describe(plugins)));
  ASSERT_EQ(all["plugins"].size(), 3u);
  EXPECT_EQ(all["plugins.0.applications"].size(), 1u);
  EXPECT_EQ(all.get<std::string>("plugins.0.applications.0.name"), "own");
  EXPECT_EQ(all.get<std::string>("plugins.2.version"), "2.3.4");
  EXPECT_EQ(all.get<std::string>("plugins.2.slams.0.name"), "toy");
  EXPECT_EQ(all.get<int>("plugins.2.slams.0.parameters.keep"), 0);
  EXPECT_EQ(all.get<std::string>("plugins.2.slams.0.help.keep"), "frames that are kept");
  EXPECT_TRUE(all.get<bool>("plugins.2.slams.0.needs.imu"));
  EXPECT_EQ(all.get<int>("plugins.2.slams.0.needs.cameras"), 1);
  EXPECT_EQ(all["refused"].size(), 1u);
  EXPECT_THAT(all.get<std::string>("refused.0.path"), HasSubstr("text.so"));
}

TEST(Plugins, LoadedAThousandTimesLeakNothing) {
  long before = 0;
  for (int i = 0; i < 1000; ++i) {
    Plugins plugins(kNowhere);
    EXPECT_NE(plugins.slam(kToy + ":toy").make(), nullptr);
    plugins.load(kToy);
    if (i == 100) before = residentBytes();
  }
  if (gslam::thisBuild().sanitizer == 0) {
    EXPECT_LE(residentBytes() - before, 64 << 10);
  }
}

}  // namespace
