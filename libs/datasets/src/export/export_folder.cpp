#include "export_folder.h"

#include <gslam/base/error.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace gslam {
inline namespace v1 {
namespace exporting {
namespace {

namespace fs = std::filesystem;

void makeFolders(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path, "cannot be made: " + error.message());
}

}  // namespace

void writeWholeFile(const std::string& path, const void* data, std::size_t size) {
  errno = 0;
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) throw FileError(path, "cannot be written", errno);
  const bool is_written = std::fwrite(data, 1, size, file) == size;
  const int problem = errno;
  const bool is_closed = std::fclose(file) == 0;
  if (is_written && is_closed) return;
  const int reason = is_written ? errno : problem;
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) fs::remove(path, ignored);
  throw FileError(path, "cannot be written", reason);
}

TextFile::TextFile(const std::string& path) : path_(path) {
  errno = 0;
  file_ = std::fopen(path.c_str(), "wb");
  if (file_ == nullptr) throw FileError(path, "cannot be written", errno);
}

TextFile::~TextFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void TextFile::line(const std::string& text) {
  errno = 0;
  const bool is_written = std::fwrite(text.data(), 1, text.size(), file_) == text.size() &&
                          std::fputc('\n', file_) != EOF;
  if (!is_written) throw FileError(path_, "cannot be written", errno);
  size_ += text.size() + 1;
}

void TextFile::flush() {
  errno = 0;
  if (std::fflush(file_) != 0) throw FileError(path_, "cannot be written", errno);
}

void TextFile::abandon() noexcept {
  if (file_ == nullptr) return;
  std::fclose(file_);  // may write the rest, which is then cut off
  file_ = nullptr;
  std::error_code ignored;
  if (kept_ == 0) {
    fs::remove(path_, ignored);
  } else {
    fs::resize_file(path_, kept_, ignored);
  }
}

ExportFolder::ExportFolder(const std::string& path) : path_(path) {
  if (path.empty()) throw ArgumentError("folder", "is empty, expected a path");
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error)) {
    throw FileError(path, "is no folder, expected a new or an empty one");
  }
  makeFolders(path);
  const bool is_empty = fs::is_empty(path, error);
  if (error) throw FileError(path, "cannot be read: " + error.message());
  if (!is_empty) throw FileError(path, "is not empty, expected a new or an empty folder");
}

void ExportFolder::write(const std::string& name, const std::string& text) {
  writeBytes(name, text.data(), text.size());
}

void ExportFolder::write(const std::string& name, const Bytes& bytes) {
  writeBytes(name, bytes.data(), bytes.size());
}

void ExportFolder::writeBytes(const std::string& name, const void* data, std::size_t size) {
  const std::string path = prepare(name);
  if (sizes_.count(name) == 0) {
    writeWholeFile(path, data, size);
    not_kept_.push_back(name);
  } else {  // the old one stays until the new one is whole
    writeWholeFile(path + ".tmp", data, size);
    std::error_code error;
    fs::rename(path + ".tmp", path, error);
    if (error) throw FileError(path, "cannot be replaced: " + error.message());
  }
  sizes_[name] = size;
}

TextFile& ExportFolder::openText(const std::string& name) {
  std::unique_ptr<TextFile>& file = texts_[name];
  file = std::make_unique<TextFile>(prepare(name));
  return *file;
}

bool ExportFolder::link(const std::string& target, const std::string& name) {
  std::error_code error;
  fs::create_directory_symlink(target, prepare(name), error);
  return !error;
}

void ExportFolder::makeFolder(const std::string& name) {
  makeFolders(path_ + "/" + name);
}

void ExportFolder::remove(const std::string& name) {
  texts_.erase(name);
  sizes_.erase(name);
  std::error_code ignored;
  fs::remove(path_ + "/" + name, ignored);
}

void ExportFolder::keep() {
  for (const auto& text : texts_) text.second->flush();
  for (const auto& text : texts_) text.second->keep();
  not_kept_.clear();
}

void ExportFolder::abandon() noexcept {
  for (const auto& text : texts_) text.second->abandon();
  std::error_code ignored;
  for (const std::string& name : not_kept_) fs::remove(path_ + "/" + name, ignored);
}

std::uint64_t ExportFolder::byteCount() const noexcept {
  std::uint64_t sum = 0;
  for (const auto& size : sizes_) sum += size.second;
  for (const auto& text : texts_) sum += text.second->size();
  return sum;
}

std::string ExportFolder::prepare(const std::string& name) {
  const std::size_t slash = name.find_last_of('/');
  const std::string parent = slash == std::string::npos ? "" : name.substr(0, slash);
  if (parent != made_) {
    makeFolder(parent);
    made_ = parent;
  }
  return path_ + "/" + name;
}

}  // namespace exporting
}  // namespace v1
}  // namespace gslam
