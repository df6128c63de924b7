#include "zip_tree.h"

#include <gslam/base/error.h>
#include <zip.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::uint64_t kFirstBytes = std::uint64_t(1) << 22;  // taken before any was read
constexpr std::size_t kMostName = 4096, kMostDepth = 64;       // of a path in an archive

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

// As other systems write them, too: a\b, ./a, /a. Those of folders keep '/' at their end.
std::string tidyName(const char* name) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '\\', '/');
  const bool is_folder = !path.empty() && path.back() == '/';
  path = joined("", path);
  path.erase(0, path.find_first_not_of('/'));
  return is_folder ? path + "/" : path;
}

// What systems leave behind: names that begin with a dot, and Apple's folder beside.
bool isLeftBehind(const std::string& path) {
  return path.empty() || path[0] == '.' || path.find("/.") != std::string::npos ||
         path.compare(0, 9, "__MACOSX/") == 0;
}

class ZipTree final : public FileTree {
 public:
  explicit ZipTree(const std::string& path) : FileTree(path) {
    idle_.push_back(openArchive(path));
    zip_t* const archive = idle_.front().get();
    const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(archive, 0));
    for (zip_uint64_t i = 0; i < count; ++i) {
      const char* const name = zip_get_name(archive, i, 0);
      if (name != nullptr) add(tidyName(name), i);
    }
    for (auto& one : listings_) {
      sortOnce(one.second.files);
      sortOnce(one.second.folders);
    }
    const auto isBefore = [](const Entry& a, const Entry& b) { return a.path < b.path; };
    if (!std::is_sorted(entries_.begin(), entries_.end(), isBefore)) {
      std::stable_sort(entries_.begin(), entries_.end(), isBefore);
    }
  }

  const std::vector<std::string>& files(const std::string& folder) const override {
    return list(folder).files;
  }
  const std::vector<std::string>& folders(const std::string& folder) const override {
    return list(folder).folders;
  }

  std::vector<std::uint8_t> read(const std::string& file, std::size_t most) const override {
    const auto entry =
        std::lower_bound(entries_.begin(), entries_.end(), file,
                         [](const Entry& one, const std::string& path) { return one.path < path; });
    if (entry == entries_.end() || entry->path != file) {
      throw FileError(nameOf(file), "does not exist");
    }
    Archive archive = take();
    std::vector<std::uint8_t> bytes = readEntry(archive.get(), entry->number, most, nameOf(file));
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(archive));
    return bytes;
  }

 private:
  struct Listing {
    std::vector<std::string> files, folders;
  };
  struct Entry {
    std::string path;
    zip_uint64_t number;
  };

  void add(const std::string& path, zip_uint64_t number) {
    if (isLeftBehind(path)) return;
    const auto depth = static_cast<std::size_t>(std::count(path.begin(), path.end(), '/'));
    if (path.size() > kMostName || depth > kMostDepth) {
      throw FileError(root(), "has a name of " + std::to_string(path.size()) + " bytes in " +
                                  std::to_string(depth) + " folders, expected at most " +
                                  std::to_string(kMostName) + " in " + std::to_string(kMostDepth));
    }
    std::string folder = folderOf(path);
    if (path.back() != '/') {
      listings_[folder].files.push_back(nameIn(path));
      entries_.push_back({path, number});
    }
    for (; !folder.empty() && known_.insert(folder).second; folder = folderOf(folder)) {
      listings_[folderOf(folder)].folders.push_back(nameIn(folder));
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
    const std::uint64_t stated = is_known && (facts.valid & ZIP_STAT_SIZE) != 0 ? facts.size : 0;
    const std::uint64_t limit = std::min<std::uint64_t>(most, kMostFileBytes + 1);
    std::vector<std::uint8_t> bytes(
        static_cast<std::size_t>(std::min({stated, kFirstBytes, limit - 1}) + 1));
    std::size_t end = 0;
    while (end < limit) {
      if (end == bytes.size()) {
        bytes.resize(static_cast<std::size_t>(std::min<std::uint64_t>(end * 2, limit)));
      }
      const zip_int64_t count = zip_fread(file.get(), bytes.data() + end, bytes.size() - end);
      if (count < 0) {
        throw FileError(name, std::string("cannot be read: ") + zip_file_strerror(file.get()));
      }
      end += static_cast<std::size_t>(count);
      if (count == 0) break;
    }
    if (end > kMostFileBytes) throw FileError(name, "is larger than 1 GiB, expected less");
    bytes.resize(end);
    return bytes;
  }

  std::unordered_map<std::string, Listing> listings_;
  std::vector<Entry> entries_;             // by path
  std::unordered_set<std::string> known_;  // folders
  mutable std::mutex mutex_;               // guards the handles
  mutable std::vector<Archive> idle_;
};

}  // namespace

std::shared_ptr<const FileTree> openZip(const std::string& path) {
  return std::make_shared<ZipTree>(path);
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
