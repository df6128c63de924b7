// How the formats are told apart, by the names of their files.
#ifndef GSLAM_DATASETS_SRC_READING_LOOKS_LIKE_H
#define GSLAM_DATASETS_SRC_READING_LOOKS_LIKE_H

#include <functional>
#include <string>

#include "file_tree.h"
#include "remarks.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// Where in a tree a sequence of some format is. Users name the folder of the sequence, one around
/// it, or the archive of it.
struct Place {
  bool is_found = false;
  std::string folder;  ///< below the root of the tree
};

/// The first folder, at most `depth` folders below the root, that `is_it` says yes to: the root
/// first, then by depth and name. Looks into at most 200 folders.
Place findFolder(const FileTree& tree, int depth,
                 const std::function<bool(const FileTree&, const std::string& folder)>& is_it);

/// The folder whose images are to be read where nothing but images is there: the root, or the first
/// folder in it that has any. Others are said.
Place findImageFolder(const FileTree& tree, Remarks& remarks);

/// Whether FileTree::open() takes a path: it is a folder, or ends in ".zip".
bool isFolderOrArchive(const std::string& path);

/// DatasetFactory::recognizes for a format: whether datasetFormatOf() names it.
std::function<bool(const std::string& path)> recognizesAs(const std::string& format);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_LOOKS_LIKE_H
