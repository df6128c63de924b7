// How the formats are told apart, by the names of their files.
#ifndef GSLAM_DATASETS_SRC_READING_LOOKS_LIKE_H
#define GSLAM_DATASETS_SRC_READING_LOOKS_LIKE_H

#include <functional>
#include <string>
#include <vector>

#include "file_tree.h"
#include "remarks.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// Where the files of a format are. What tells it from the others and its reader go by the same.
struct Layout {
  using Predicate = bool (*)(const FileTree& tree, const std::string& folder);

  const char* format;
  int depth;            ///< most folders between the one that the user names and a sequence
  Predicate is_sure;    ///< what tells it from other formats
  Predicate is_enough;  ///< what its reader needs where the user names the format
};

/// @throws ArgumentError when a format has none, as `cvmono`, which takes any images
const Layout& layoutOf(const std::string& format);

/// The folder of the only sequence of a format: one that is sure, or else one that is enough.
/// @param expected  what a sequence has, for errors
/// @throws FileError when there is none, or several, which it lists
std::string onlyFolder(const FileTree& tree, const std::string& format,
                       const std::string& expected);

/// Folders that are sequences, at most `depth` below the root, by depth and name. Nothing inside of
/// one is looked at, nor is more than the first thousand folders.
std::vector<std::string> findSequences(const FileTree& tree, int depth,
                                       const std::function<bool(const std::string&)>& is_it);
/// Such folders for errors: "a, b, c".
std::string namesOfSequences(const FileTree& tree, const std::vector<std::string>& folders);

/// The frames' colour of 7-Scenes: "frame-000012.color.png".
bool isSevenScenesColour(const std::string& name);
/// Archives of sequences of 7-Scenes, as a scene is downloaded: "seq-01.zip".
std::vector<std::string> packedSevenScenes(const FileTree& tree, const std::string& folder);

/// Whether ICL-NUIM is there as POV-Ray wrote it.
bool isIclOriginal(const FileTree& tree, const std::string& folder);

/// The folder that Strecha's .camera files are in, in or below that of a sequence; this itself
/// where there are none.
std::string strechaCameraFolder(const FileTree& tree, const std::string& folder);

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
