// The files of a zip archive, which is not unpacked.
#ifndef GSLAM_DATASETS_SRC_READING_ZIP_TREE_H
#define GSLAM_DATASETS_SRC_READING_ZIP_TREE_H

#include <memory>
#include <string>

#include "file_tree.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// @throws FileError when it is no zip archive
std::shared_ptr<const FileTree> openZip(const std::string& path);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_ZIP_TREE_H
