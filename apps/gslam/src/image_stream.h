// The images that a user names: files, folders, datasets.
#ifndef GSLAM_APPS_IMAGE_STREAM_H
#define GSLAM_APPS_IMAGE_STREAM_H

#include <gslam/core/plugins.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "options.h"

namespace app {

/// An image that may not have been read yet.
struct SourceImage {
  std::string name;  ///< the file; of a dataset its name, a colon and the number of the frame
  cv::Mat pixels;    ///< grey, 8 bit; empty: they are in the file
};

/// The pixels of an image, grey, 8 bit. Threads may call it for different images.
/// @throws FileError, which names it, when it cannot be read
cv::Mat greyPixels(const SourceImage& image);

/// Images of one argument, or of several files.
class ImageSequence {
 public:
  virtual ~ImageSequence() = default;
  /// The next one; false behind the last.
  virtual bool next(SourceImage& image) = 0;
  /// How many there are; 0: that is not known.
  virtual std::uint64_t count() const = 0;
  /// Whether it is a device, which has no end.
  virtual bool isLive() const { return false; }
};

/// All images that the arguments of a command name, one after the other. An argument is an image, a
/// folder of images, in the order in which people number files, or a dataset, of which the first
/// camera is taken.
class ImageStream {
 public:
  /// Declares --every, --format and --dataset-param.
  static void declare(Options& options);

  /// @param options  where they were declared
  /// @param words    the arguments
  /// @throws ConfigError when there are none, FileError for one that is nothing of this
  ImageStream(const Options& options, const std::vector<std::string>& words);

  /// The next image; false behind the last one.
  /// @throws Error when a dataset cannot be read
  bool next(SourceImage& image);
  /// How many there are; 0: that is not known.
  std::uint64_t count() const;
  /// Whether a device is among them.
  bool isLive() const;

 private:
  void add(const std::string& word, std::vector<std::string>& files);
  bool addFolder(const std::string& word, std::vector<std::string>& files);
  void addDataset(const std::string& word, std::vector<std::string>& files);
  void endFiles(std::vector<std::string>& files);

  const Options& options_;
  std::size_t every_;
  gslam::Plugins plugins_;  // outlives their datasets
  std::vector<std::unique_ptr<ImageSequence>> sequences_;
  std::size_t at_ = 0;  // of them
};

}  // namespace app

#endif  // GSLAM_APPS_IMAGE_STREAM_H
