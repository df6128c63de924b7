// A new folder of files, counted, with errors that name the file.
#ifndef GSLAM_DATASETS_SRC_EXPORT_EXPORT_FOLDER_H
#define GSLAM_DATASETS_SRC_EXPORT_EXPORT_FOLDER_H

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace exporting {

using Bytes = std::vector<unsigned char>;

/// Writes a whole file, in place of what was there; on failure there is none.
/// @throws FileError
void writeWholeFile(const std::string& path, const void* data, std::size_t size);

/// A text file that grows line by line.
class TextFile {
 public:
  explicit TextFile(const std::string& path);
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();

  /// Adds the text and an end of line.
  void line(const std::string& text);
  void flush();
  /// Keeps what was written until now, come what may.
  void keep() noexcept { kept_ = size_; }
  /// Cuts it back to what is kept, and ends it; without anything it goes.
  void abandon() noexcept;
  std::uint64_t size() const noexcept { return size_; }

 private:
  std::string path_;
  std::FILE* file_;
  std::uint64_t size_ = 0;  // written, on disk or not
  std::uint64_t kept_ = 0;
};

class ExportFolder {
 public:
  /// @throws FileError when it cannot be made, or is not empty
  explicit ExportFolder(const std::string& path);

  /// @{
  /// `name` is below the folder; the folders it is in are made.
  void write(const std::string& name, const std::string& text);
  void write(const std::string& name, const Bytes& bytes);
  /// Lives as long as this.
  TextFile& openText(const std::string& name);
  /// Another name for a folder of this; false where the file system has no such things.
  bool link(const std::string& target, const std::string& name);
  void makeFolder(const std::string& name);
  void remove(const std::string& name);
  /// @}

  /// Brings all text to disk, and keeps all that was written until now.
  void keep();
  /// Takes back what was written after keep(), as far as it was not there before.
  void abandon() noexcept;

  std::size_t fileCount() const noexcept { return sizes_.size() + texts_.size(); }
  std::uint64_t byteCount() const noexcept;

 private:
  std::string prepare(const std::string& name);
  void writeBytes(const std::string& name, const void* data, std::size_t size);

  std::string path_;
  std::string made_;                            // the last folder that was made
  std::map<std::string, std::uint64_t> sizes_;  // of files written at once
  std::map<std::string, std::unique_ptr<TextFile>> texts_;
  std::vector<std::string> not_kept_;  // of sizes_
};

}  // namespace exporting
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_EXPORT_EXPORT_FOLDER_H
