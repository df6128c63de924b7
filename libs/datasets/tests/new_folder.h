// A folder for what a test writes.
#ifndef GSLAM_DATASETS_TESTS_NEW_FOLDER_H
#define GSLAM_DATASETS_TESTS_NEW_FOLDER_H

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

/// A new folder that goes with this.
class NewFolder {
 public:
  NewFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "gslam_datasets_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

#endif  // GSLAM_DATASETS_TESTS_NEW_FOLDER_H
