#include "zip_tree.h"

#include <gslam/base/error.h>
#include <zip.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 30;   // of one file
constexpr std::uint64_t kFirstBytes = std::uint64_t(1) << 22;  // taken before any was read

struct Discard {
  void operator()(zip_t* archive) const noexcept { zip_discard(archive); }
  void operator()(zip_file_t* file) const noexcept { zip_fclose(file); }
};
using Archive = std::unique_ptr<zip_t, Discard>;

Archive openArchive(const std::string& path) {
  int problem = 0;
  Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &problem));
  if (archive != nullptr) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, problem);
  const std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw FileError(path, "cannot be read as a zip archive: " + text);
}

// As other systems write them, too: a\b, ./a
std::string tidyName(const char* name) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '\\', '/');
  while (path.compare(0, 2, "./") == 0) path.erase(0, 2);
  return path;
}

class ZipTree final : public FileTree {
 public:
  explicit ZipTree(const std::string& path) : FileTree(path) {
    idle_.push_back(openArchive(path));
    zip_t* const archive = idle_.front().get();
    const zip_int64_t count = zip_get_num_entries(archive, 0);
    for (zip_int64_t i = 0; i < count; ++i) {
      const char* const name = zip_get_name(archive, static_cast<zip_uint64_t>(i), 0);
      if (name != nullptr) add(tidyName(name), static_cast<zip_uint64_t>(i));
    }
    for (auto& one : listings_) {
      sortOnce(one.second.files);
      sortOnce(one.second.folders);
    }
  }

  const std::vector<std::string>& files(const std::string& folder) const override {
    return list(folder).files;
  }
  const std::vector<std::string>& folders(const std::string& folder) const override {
    return list(folder).folders;
  }

  std::vector<std::uint8_t> read(const std::string& file, std::size_t most) const override {
    const auto entry = entries_.find(file);
    if (entry == entries_.end()) throw FileError(nameOf(file), "does not exist");
    Archive archive = take();
    std::vector<std::uint8_t> bytes = readEntry(archive.get(), entry->second, most, nameOf(file));
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(archive));
    return bytes;
  }

 private:
  struct Listing {
    std::vector<std::string> files, folders;
  };

  void add(const std::string& path, zip_uint64_t entry) {
    const bool is_folder = path.empty() || path.back() == '/';
    std::string inner = is_folder ? path.substr(0, path.size() - (path.empty() ? 0 : 1)) : path;
    const std::string first = inner.substr(0, inner.find('/'));
    const bool is_left_behind = first == "__MACOSX" || nameIn(inner).compare(0, 1, ".") == 0;
    if (inner.empty() || is_left_behind) return;
    if (!is_folder) {
      listings_[folderOf(inner)].files.push_back(nameIn(inner));
      entries_.emplace(inner, entry);
      inner = folderOf(inner);
    }
    for (; !inner.empty() && known_.insert({inner, true}).second; inner = folderOf(inner)) {
      listings_[folderOf(inner)].folders.push_back(nameIn(inner));
    }
  }

  static void sortOnce(std::vector<std::string>& names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
  }

  const Listing& list(const std::string& folder) const {
    static const Listing kNone;
    const auto found = listings_.find(folder);
    return found == listings_.end() ? kNone : found->second;
  }

  // A handle serves one thread at a time.
  Archive take() const {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty()) {
        Archive archive = std::move(idle_.back());
        idle_.pop_back();
        return archive;
      }
    }
    return openArchive(root());
  }

  // The size that an archive states is not believed: memory is taken as bytes come.
  static std::vector<std::uint8_t> readEntry(zip_t* archive, zip_uint64_t entry, std::size_t most,
                                             const std::string& name) {
    const std::unique_ptr<zip_file_t, Discard> file(zip_fopen_index(archive, entry, 0));
    if (file == nullptr)
      throw FileError(name, std::string("cannot be read: ") + zip_strerror(archive));
    zip_stat_t facts;
    zip_stat_init(&facts);
    const bool is_known = zip_stat_index(archive, entry, 0, &facts) == 0;
    std::uint64_t size = is_known && (facts.valid & ZIP_STAT_SIZE) != 0 ? facts.size : 0;
    size = std::min({size + 1, kFirstBytes, static_cast<std::uint64_t>(most)});
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    std::size_t end = 0;
    while (end < most) {
      if (end == bytes.size()) bytes.resize(std::min(end * 2, most));
      const zip_int64_t count = zip_fread(file.get(), bytes.data() + end, bytes.size() - end);
      if (count < 0) {
        throw FileError(name, std::string("cannot be read: ") + zip_file_strerror(file.get()));
      }
      end += static_cast<std::size_t>(count);
      if (count == 0) break;
      if (end > kMostBytes) throw FileError(name, "is larger than 1 GiB, expected less");
    }
    bytes.resize(end);
    return bytes;
  }

  std::map<std::string, Listing> listings_;
  std::map<std::string, zip_uint64_t> entries_;
  std::map<std::string, bool> known_;  // folders
  mutable std::mutex mutex_;           // guards the handles
  mutable std::vector<Archive> idle_;
};

}  // namespace

std::shared_ptr<const FileTree> openZip(const std::string& path) {
  return std::make_shared<ZipTree>(path);
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
