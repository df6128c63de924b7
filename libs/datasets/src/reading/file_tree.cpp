#include "file_tree.h"

#include <dirent.h>
#include <gslam/base/error.h>
#include <gslam/core/detail/shared_library.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

#include "zip_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

std::string withoutSlash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

std::string lowered(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool isTidy(const std::string& path) {
  return path.find("//") == std::string::npos && path.find("/.") == std::string::npos &&
         (path.empty() || (path[0] != '.' && (path.size() == 1 || path.back() != '/')));
}

// As std::filesystem::path::lexically_normal() does, without '/' at the end.
std::string tidied(const std::string& path) {
  if (isTidy(path)) return path;
  std::string tidy = std::filesystem::path(path).lexically_normal().string();
  if (tidy.size() > 1 && tidy.back() == '/') tidy.pop_back();
  return tidy == "." ? "" : tidy;
}

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

// Devices and pipes have no end.
std::vector<std::uint8_t> readFile(const std::string& path, std::size_t most) {
  const detail::FileKind kind = detail::fileKind(path);
  if (kind == detail::FileKind::folder || kind == detail::FileKind::other) {
    throw FileError(path, "is no file, expected one");
  }
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) throw FileError(path, "cannot be opened", errno);
  std::error_code problem;
  const std::uint64_t size = std::filesystem::file_size(path, problem);
  if (problem) throw FileError(path, "cannot be read", problem.value());
  const std::uint64_t wanted = std::min<std::uint64_t>(size, most);
  if (wanted > kMostFileBytes) throw FileError(path, "is larger than 1 GiB, expected less");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(wanted));
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
  if (std::ferror(file.get()) != 0) throw FileError(path, "cannot be read", errno);
  return bytes;
}

struct CloseFolder {
  void operator()(DIR* folder) const noexcept { ::closedir(folder); }
};

class FolderTree final : public FileTree {
 public:
  explicit FolderTree(const std::string& root) : FileTree(root) {}

  const std::vector<std::string>& files(const std::string& folder) const override {
    return list(folder).files;
  }
  const std::vector<std::string>& folders(const std::string& folder) const override {
    return list(folder).folders;
  }
  std::vector<std::uint8_t> read(const std::string& file, std::size_t most) const override {
    return readFile(joined(root(), file), most);
  }

 private:
  struct Listing {
    std::vector<std::string> files, folders;
  };

  const Listing& list(const std::string& folder) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = listings_.find(folder);
    if (known != listings_.end()) return known->second;
    Listing listing = look(joined(root(), folder));
    return listings_.emplace(folder, std::move(listing)).first->second;
  }

  static Listing look(const std::string& path) {
    Listing listing;
    const std::unique_ptr<DIR, CloseFolder> folder(::opendir(path.c_str()));
    const bool is_none = folder == nullptr && (errno == ENOENT || errno == ENOTDIR);
    if (is_none) return listing;
    if (folder == nullptr) throw FileError(path, "cannot be listed", errno);
    errno = 0;
    while (const dirent* const entry = ::readdir(folder.get())) {
      if (entry->d_name[0] == '.') continue;
      (isFolder(path, *entry) ? listing.folders : listing.files).emplace_back(entry->d_name);
      errno = 0;
    }
    if (errno != 0) throw FileError(path, "cannot be listed", errno);
    std::sort(listing.files.begin(), listing.files.end());
    std::sort(listing.folders.begin(), listing.folders.end());
    return listing;
  }

  // A link that leads nowhere is a file: who reads it is told.
  static bool isFolder(const std::string& path, const dirent& entry) {
    if (entry.d_type == DT_DIR) return true;
    if (entry.d_type == DT_REG) return false;
    return detail::fileKind(path + "/" + entry.d_name) == detail::FileKind::folder;
  }

  mutable std::mutex mutex_;  // guards the map; what is in it stays as it is
  mutable std::map<std::string, Listing> listings_;
};

class PartOfTree final : public FileTree {
 public:
  PartOfTree(std::shared_ptr<const FileTree> whole, std::string folder)
      : FileTree(whole->nameOf(folder)), whole_(std::move(whole)), folder_(std::move(folder)) {}

  const std::vector<std::string>& files(const std::string& folder) const override {
    return whole_->files(joined(folder_, folder));
  }
  const std::vector<std::string>& folders(const std::string& folder) const override {
    return whole_->folders(joined(folder_, folder));
  }
  std::vector<std::uint8_t> read(const std::string& file, std::size_t most) const override {
    return whole_->read(joined(folder_, file), most);
  }

 private:
  std::shared_ptr<const FileTree> whole_;
  std::string folder_;
};

bool contains(const std::vector<std::string>& sorted, const std::string& name) {
  return std::binary_search(sorted.begin(), sorted.end(), name);
}

}  // namespace

FileTree::FileTree(std::string root) : root_(withoutSlash(std::move(root))) {}

std::shared_ptr<const FileTree> FileTree::open(const std::string& path) {
  switch (detail::fileKind(path)) {
    case detail::FileKind::none:
      throw FileError(path, "does not exist, expected a folder or a zip archive");
    case detail::FileKind::folder: {
      std::error_code problem;
      const std::filesystem::directory_iterator first(path, problem);
      if (problem) throw FileError(path, "cannot be listed", problem.value());
      return std::make_shared<FolderTree>(path);
    }
    default:
      break;
  }
  const std::string ending = lowered(path.size() < 4 ? path : path.substr(path.size() - 4));
  if (ending == ".zip") return openZip(path);
  throw FileError(path, "is a file, expected a folder or a zip archive");
}

bool FileTree::has(const std::string& file) const {
  return contains(files(folderOf(file)), nameIn(file));
}

bool FileTree::hasFolder(const std::string& folder) const {
  return folder.empty() || contains(folders(folderOf(folder)), nameIn(folder));
}

std::string FileTree::text(const std::string& file) const {
  const std::vector<std::uint8_t> bytes = read(file);
  return std::string(bytes.begin(), bytes.end());
}

std::string FileTree::nameOf(const std::string& file) const {
  return file.empty() ? root_ : joined(root_, file);
}

std::string FileTree::baseName() const {
  std::error_code problem;
  std::filesystem::path full = std::filesystem::absolute(root_, problem).lexically_normal();
  if (full.filename().empty()) full = full.parent_path();  // of "/data/." is "/data/"
  const std::string name = full.filename().string();
  const bool is_zip = name.size() > 4 && lowered(name.substr(name.size() - 4)) == ".zip";
  return is_zip ? name.substr(0, name.size() - 4) : name;
}

std::shared_ptr<const FileTree> below(std::shared_ptr<const FileTree> tree,
                                      const std::string& folder) {
  if (folder.empty()) return tree;
  return std::make_shared<PartOfTree>(std::move(tree), folder);
}

std::string joined(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return tidied(a + b);
  return tidied(a + "/" + b);
}

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string nameIn(const std::string& path) {
  return path.substr(path.rfind('/') + 1);  // from 0 on where there is none
}

bool endsWith(const std::string& name, const std::string& ending) {
  return name.size() > ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

bool isImageName(const std::string& name) {
  static const char* const kEndings[] = {"png", "jpg", "jpeg", "pgm", "ppm",  "pbm",
                                         "bmp", "tif", "tiff", "exr", "webp", "jp2"};
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return false;
  const std::string ending = lowered(name.substr(dot + 1));
  return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
