// What KITTI odometry and KITTI raw have in common: four cameras, and files with a number.
#ifndef GSLAM_DATASETS_SRC_FORMATS_KITTI_FILES_H
#define GSLAM_DATASETS_SRC_FORMATS_KITTI_FILES_H

#include <gslam/svar/svar.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "../reading/file_tree.h"
#include "../reading/remarks.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// Names of cameras 0 to 3.
const char* kittiCameraName(std::size_t camera);

/// Cameras that parameters `cameras` (grey, colour, all, auto) and `stereo` ask for.
/// @param folders  of the images of cameras 0 to 3
/// @throws FileError when there is none of that kind, ArgumentError for another word
std::vector<std::size_t> chooseKittiCameras(const FileTree& tree,
                                            const std::vector<std::string>& folders,
                                            const Svar& parameters, Remarks& remarks);

/// A file with a number in its name.
struct NumberedFile {
  std::size_t number;
  std::string name;  ///< in the tree
};

/// Those of a folder, by number. Names without one, or with that of another, are skipped.
/// @param is_wanted  whether a name counts
std::vector<NumberedFile> numberedFiles(const FileTree& tree, const std::string& folder,
                                        const std::function<bool(const std::string&)>& is_wanted,
                                        Remarks& remarks);

/// The file of that number; null where there is none.
const NumberedFile* findNumber(const std::vector<NumberedFile>& files, std::size_t number);

/// Which line of a list is that of file i, from 0 on: the i-th where there are as many, else the
/// one that the file's number says.
inline std::size_t lineOf(const std::vector<NumberedFile>& files, std::size_t i,
                          std::size_t line_count) {
  return line_count == files.size() ? i : files[i].number;
}

/// Says where there are not as many.
void sayCounts(const std::vector<NumberedFile>& files, const std::string& list, std::size_t count,
               const std::string& what, Remarks& remarks);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_FORMATS_KITTI_FILES_H
