// A folder that stands for /proc or /sys.
#ifndef GSLAM_EVALUATION_TESTS_FAKE_FILES_H
#define GSLAM_EVALUATION_TESTS_FAKE_FILES_H

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

class FakeFiles {
 public:
  FakeFiles() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gslam_cost_XXXXXX").string();
    if (mkdtemp(&pattern[0]) == nullptr) ADD_FAILURE() << pattern;
    root_ = pattern;
  }
  FakeFiles(const FakeFiles&) = delete;
  FakeFiles& operator=(const FakeFiles&) = delete;
  ~FakeFiles() {
    std::error_code ignored;
    std::filesystem::remove_all(root_, ignored);
  }

  std::string root() const { return root_.string(); }
  void write(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = root_ / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  std::string read(const std::string& path) const {
    std::ifstream file(root_ / path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void remove(const std::string& path) const { std::filesystem::remove_all(root_ / path); }

 private:
  std::filesystem::path root_;
};

#endif  // GSLAM_EVALUATION_TESTS_FAKE_FILES_H
