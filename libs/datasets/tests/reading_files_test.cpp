#include <gslam/base/error.h>
#include <sys/stat.h>

#include <thread>

#include "../src/reading/decode.h"
#include "../src/reading/file_tree.h"
#include "../src/reading/remarks.h"
#include "../src/reading/whole_image.h"
#include "reading_case.h"

namespace {

using namespace gslam::reading;  // NOLINT(google-build-using-namespace)
using reading_case::isSame;
using reading_case::TempFolder;
using Names = std::vector<std::string>;

// What a tree must be like, whatever it is made of.
void expectTree(const FileTree& tree) {
  EXPECT_EQ(tree.files(""), (Names{"a.txt", "b.txt"}));
  EXPECT_EQ(tree.folders(""), (Names{"deep"}));
  EXPECT_EQ(tree.folders("deep"), (Names{"er"}));
  EXPECT_EQ(tree.files("deep/er"), (Names{"c.txt"}));
  EXPECT_TRUE(tree.files("nowhere").empty());
  EXPECT_TRUE(tree.has("deep/er/c.txt"));
  EXPECT_FALSE(tree.has("deep/er"));
  EXPECT_FALSE(tree.has("c.txt"));
  EXPECT_TRUE(tree.hasFolder("deep/er"));
  EXPECT_FALSE(tree.hasFolder("a.txt"));
  EXPECT_TRUE(tree.hasFolder(""));
  EXPECT_EQ(tree.text("deep/er/c.txt"), std::string(100000, 'c'));
  EXPECT_EQ(tree.read("deep/er/c.txt", 10).size(), 10U);
  EXPECT_EQ(tree.text("b.txt"), "");
  const std::string message = reading_case::messageOf([&] { (void)tree.read("none.txt"); });
  EXPECT_NE(message.find(tree.root() + "/none.txt"), std::string::npos) << message;
}

void fill(const TempFolder& folder) {
  folder.write("data/a.txt", "a");
  folder.write("data/b.txt", "");
  folder.write("data/.hidden", "h");
  folder.write("data/deep/er/c.txt", std::string(100000, 'c'));
}

TEST(reading_files, a_folder_and_an_archive_are_the_same_tree) {
  const TempFolder folder;
  fill(folder);
  reading_case::zipFolder(folder / "data", folder / "data.zip");
  expectTree(*FileTree::open(folder / "data"));
  expectTree(*FileTree::open(folder / "data.zip"));
  EXPECT_EQ(FileTree::open(folder / "data/")->baseName(), "data");
  EXPECT_EQ(FileTree::open(folder / "data.zip")->baseName(), "data");
  EXPECT_EQ(FileTree::open(folder / "data/deep/..")->baseName(), "data");
}

TEST(reading_files, a_part_is_a_tree) {
  const TempFolder folder;
  fill(folder);
  reading_case::zipFolder(folder / "data", folder / "data.zip", "inside/");
  const auto tree = below(FileTree::open(folder / "data.zip"), "inside");
  expectTree(*tree);
  EXPECT_EQ(tree->root(), folder / "data.zip/inside");
}

TEST(reading_files, threads_share_an_archive) {
  const TempFolder folder;
  fill(folder);
  reading_case::zipFolder(folder / "data", folder / "data.zip");
  const auto tree = FileTree::open(folder / "data.zip");
  std::vector<std::thread> threads;
  std::vector<int> good(4, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 50; ++k) good[i] += tree->text("deep/er/c.txt").size() == 100000 ? 1 : 0;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, (std::vector<int>{50, 50, 50, 50}));
}

TEST(reading_files, says_why_it_cannot_be_opened) {
  const TempFolder folder;
  folder.write("empty.zip", "");
  folder.write("wrong.zip", "no archive");
  folder.write("file.txt", "text");
  for (const char* name : {"empty.zip", "wrong.zip", "file.txt", "none"}) {
    const std::string message =
        reading_case::messageOf([&] { (void)FileTree::open(folder / name); });
    EXPECT_NE(message.find(folder / name), std::string::npos) << name << ": " << message;
  }
}

TEST(reading_files, every_cut_of_an_archive_is_an_error_or_a_tree) {
  const TempFolder folder;
  fill(folder);
  reading_case::zipFolder(folder / "data", folder / "data.zip");
  const std::string whole = reading_case::textOf(folder / "data.zip");
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::string bytes = whole;
    if (size % 2 == 0) bytes.resize(size);
    bytes[size * 7 % (bytes.empty() ? 1 : bytes.size())] ^= char(1 << size % 8);
    folder.write("cut.zip", bytes);
    std::string read;
    const std::string message = reading_case::messageOf([&] {
      const auto tree = FileTree::open(folder / "cut.zip");
      for (const std::string& name : tree->files("")) (void)tree->read(name);
      read = tree->text("deep/er/c.txt");
    });
    if (message.empty()) {
      ASSERT_EQ(read, std::string(100000, 'c')) << size;
    }
  }
}

TEST(reading_files, untidy_paths_lead_to_the_same_files) {
  const TempFolder folder;
  fill(folder);
  reading_case::zipFolder(folder / "data", folder / "data.zip", "./in//side/");
  const auto plain = FileTree::open(folder / "data"),
             packed = below(FileTree::open(folder / "data.zip"), "in/side");
  for (const char* name : {"deep/er/c.txt", "./deep/er/c.txt", "deep//er/c.txt",
                           "deep/er/../er/c.txt", "x/../deep/./er/c.txt"}) {
    EXPECT_TRUE(plain->has(joined("", name))) << name;
    EXPECT_TRUE(packed->has(joined("", name))) << name;
  }
  EXPECT_EQ(joined("a/", "b/"), "a/b");
  EXPECT_EQ(joined("a", "../b"), "b");
  EXPECT_EQ(joined("/", "b"), "/b");
  EXPECT_EQ(joined("", "."), "");
  EXPECT_EQ(joined("..", "b"), "../b");
}

TEST(reading_files, what_systems_leave_behind_is_not_there) {
  const TempFolder folder;
  for (const char* name :
       {"data/.thumbs/a.png", "data/__MACOSX/a.png", "data/seq/._a.png", "data/seq/a.png"}) {
    folder.write(name, "x");
  }
  reading_case::zipFolder(folder / "data", folder / "data.zip");
  const auto packed = FileTree::open(folder / "data.zip");
  EXPECT_EQ(packed->folders(""), (Names{"seq"}));
  EXPECT_EQ(packed->files("seq"), (Names{"a.png"}));
  EXPECT_EQ(FileTree::open(folder / "data")->files("seq"), (Names{"a.png"}));
}

TEST(reading_files, what_has_no_end_is_refused) {
  const TempFolder folder;
  folder.write("data/a.png", "x");
  ASSERT_EQ(mkfifo((folder / "data/pipe.png").c_str(), 0600), 0);
  reading_case::fs::create_symlink("/dev/zero", folder / "data/zero.png");
  reading_case::fs::create_symlink("nowhere", folder / "data/lost.png");
  reading_case::fs::resize_file(folder / "data/a.png", std::uintmax_t(1) << 40);  // takes no room
  const auto tree = FileTree::open(folder / "data");
  EXPECT_EQ(tree->files("").size(), 4U);
  for (const std::string& name : tree->files("")) {
    EXPECT_THROW((void)tree->read(name), gslam::FileError) << name;
  }
  EXPECT_EQ(tree->read("a.png", 5).size(), 5U);
}

TEST(reading_files, long_names_in_archives_are_refused) {
  const TempFolder folder;
  folder.write("data/a", "x");
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "a/";
  reading_case::zipFolder(folder / "data", folder / "deep.zip", deep);
  EXPECT_THROW(FileTree::open(folder / "deep.zip"), gslam::FileError);
  reading_case::zipFolder(folder / "data", folder / "long.zip", std::string(5000, 'a') + "/");
  EXPECT_THROW(FileTree::open(folder / "long.zip"), gslam::FileError);
}

TEST(reading_files, whole_images_are_told_from_cut_ones) {
  const TempFolder folder;
  for (const char* name : {"a.png", "a.jpg", "b.jpg"}) {
    folder.writeImage(name, 3, name[0] == 'a' ? CV_8UC3 : CV_8UC1, 70, 50);
    const std::string text = reading_case::textOf(folder / name);
    const std::vector<std::uint8_t> whole(text.begin(), text.end());
    EXPECT_TRUE(isWholeImage(whole)) << name;
    EXPECT_TRUE(isSame(decodeImage(whole, name), cv::imread(folder / name, cv::IMREAD_UNCHANGED)));
    for (std::size_t size = 8; size < whole.size(); ++size) {
      const std::vector<std::uint8_t> cut(whole.begin(), whole.begin() + std::ptrdiff_t(size));
      ASSERT_FALSE(isWholeImage(cut)) << name << " of " << size << " bytes";
      ASSERT_THROW(decodeImage(cut, name), gslam::FileError);
    }
    std::vector<std::uint8_t> longer = whole;
    longer.insert(longer.end(), 1000, 0);  // as some programs write
    EXPECT_TRUE(isWholeImage(longer)) << name;
  }
}

TEST(reading_files, what_is_no_image_is_an_error_with_its_name) {
  for (const std::string& text : {std::string(), std::string("no image"), std::string(8, '\0')}) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const std::string message =
        reading_case::messageOf([&] { (void)decodeImage(bytes, "x/y.png"); });
    EXPECT_EQ(message.compare(0, 8, "x/y.png:"), 0) << message;
  }
}

TEST(reading_files, names_of_images) {
  for (const char* name : {"a.png", "a.JPG", "x.y.tiff", "b.Exr"}) EXPECT_TRUE(isImageName(name));
  for (const char* name : {"png", "a.txt", "a.png.txt", "a.", ""}) EXPECT_FALSE(isImageName(name));
}

TEST(reading_files, remarks_count_and_list_what_was_skipped) {
  Remarks remarks;
  remarks.say("one thing");
  for (int i = 0; i < 25; ++i) remarks.skip("images that are lost", std::to_string(i));
  remarks.say("one thing");
  remarks.skip("others", "x");
  EXPECT_EQ(remarks.skipped("images that are lost"), 25U);
  EXPECT_EQ(
      remarks.sentences(),
      (Names{"one thing", "skipped 25 images that are lost: 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, ..., 24",
             "skipped 1 others: x"}));
}

}  // namespace
