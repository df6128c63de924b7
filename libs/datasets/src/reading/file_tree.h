// The files of a dataset, in a folder or a zip archive.
#ifndef GSLAM_DATASETS_SRC_READING_FILE_TREE_H
#define GSLAM_DATASETS_SRC_READING_FILE_TREE_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {

/// Files below a root. Paths are relative to it, with '/' between names: "cam0/data.csv"; "" is the
/// root itself. They are tidy, as joined() makes them. Names that begin with a dot, which systems
/// leave behind, are not there. Threads may share one.
///
/// Each folder is listed once, at the first question about it: tens of thousands of has() cost one
/// look into the folder.
class FileTree {
 public:
  /// @param path  a folder, or a file that ends in ".zip"
  /// @throws FileError when it cannot be opened, or is neither
  static std::shared_ptr<const FileTree> open(const std::string& path);
  virtual ~FileTree() = default;

  /// Names of the files in a folder, sorted by bytes; none where there is no such folder.
  /// @throws FileError when a folder cannot be listed
  virtual const std::vector<std::string>& files(const std::string& folder) const = 0;
  /// Names of the folders in a folder, sorted by bytes; none where there is no such folder.
  virtual const std::vector<std::string>& folders(const std::string& folder) const = 0;
  /// Whether there is a file, or a folder.
  bool has(const std::string& file) const;
  bool hasFolder(const std::string& folder) const;

  /// The bytes of a file, at most so many of its beginning.
  /// @throws FileError that names it when it cannot be read, is no file, or has more than 1 GiB
  virtual std::vector<std::uint8_t> read(
      const std::string& file,
      std::size_t most = std::numeric_limits<std::size_t>::max()) const = 0;
  /// The same as text, for FieldReader, parseYaml() and others.
  std::string text(const std::string& file) const;

  /// What errors call a file: "/data/seq.zip/cam0/data.csv".
  std::string nameOf(const std::string& file) const;
  /// The root as the user wrote it, without '/' at its end.
  const std::string& root() const noexcept { return root_; }
  /// Name of the root for DatasetInfo::name: the last part of the full path, without ".zip".
  std::string baseName() const;

 protected:
  explicit FileTree(std::string root);

 private:
  std::string root_;
};

/// The same files, seen from a folder below the root (for archives and folders that have the
/// sequence inside of another folder). "" gives the tree itself.
std::shared_ptr<const FileTree> below(std::shared_ptr<const FileTree> tree,
                                      const std::string& folder);

/// Most bytes of a file.
constexpr std::uint64_t kMostFileBytes = std::uint64_t(1) << 30;

/// a + "/" + b, tidied: without "." and "..", as far as names stand before these, and with one '/'
/// between names and none at the end.
std::string joined(const std::string& a, const std::string& b);

/// @{
/// Parts of a path: "cam0/data.csv" is in "cam0", and called "data.csv".
std::string folderOf(const std::string& path);
std::string nameIn(const std::string& path);
/// @}

/// Whether a name ends so, and has something before that.
bool endsWith(const std::string& name, const std::string& ending);

/// Whether a name has the ending of an image that OpenCV reads (png, jpg, jpeg, pgm, ppm, pbm, bmp,
/// tif, tiff, exr, webp, jp2), in any case.
bool isImageName(const std::string& name);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_FILE_TREE_H
