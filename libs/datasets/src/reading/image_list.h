// Lists of images in text files, and frames made of those of several cameras.
#ifndef GSLAM_DATASETS_SRC_READING_IMAGE_LIST_H
#define GSLAM_DATASETS_SRC_READING_IMAGE_LIST_H

#include <gslam/core/stamp.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "decode.h"
#include "file_tree.h"
#include "remarks.h"
#include "sequence.h"

namespace gslam {
inline namespace v1 {
namespace reading {

/// An image that a list names.
struct ListedImage {
  std::int64_t stamp = 0;     ///< nanoseconds
  std::string file;           ///< in the tree
  std::size_t line = 0;       ///< of the list, from 1; 0: it is in no list
  std::int64_t exposure = 0;  ///< nanoseconds; 0: unknown
};

/// Reads lines of a stamp and a file name, which blanks or a comma separate, as TUM's rgb.txt and
/// EuRoC's data.csv have them. # begins a comment. More columns are not looked at.
/// @param tree, list  the file
/// @param unit        of the stamps
/// @param folder      what the names are relative to
/// @return in the order of the file
/// @throws FileError, ParseError with the line
std::vector<ListedImage> readImageList(const FileTree& tree, const std::string& list,
                                       StampUnit unit, const std::string& folder);

/// Takes out what does not exist, then what has the stamp of another before it, and sorts by stamp.
/// What was skipped or out of order is said.
/// @param list  name of the list, for remarks
void tidy(std::vector<ListedImage>& images, const FileTree& tree, const std::string& list,
          Remarks& remarks);

/// What the first image is like, which is read; of size 0 where there is none.
ImageShape shapeOfFirst(const FileTree& tree, const std::vector<ListedImage>& images);

/// Makes frames of the images of several cameras: each image of the first camera with the image
/// nearest in time of each other one, which no other frame has (associate()). A frame that lacks
/// one is skipped, and so is an image that no frame has; both are counted.
/// @param sequence   `info.sensors.cameras` is set: one camera a list; gets stamps and exposures
/// @param lists      tidy, one a camera
/// @param tolerance  most nanoseconds between the images of a frame; 0: the same stamp
/// @return names, for loadImageFiles()
/// @throws Error when no frame is complete
std::vector<std::string> makeFrames(Sequence& sequence,
                                    const std::vector<std::vector<ListedImage>>& lists,
                                    std::int64_t tolerance);

}  // namespace reading
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_READING_IMAGE_LIST_H
