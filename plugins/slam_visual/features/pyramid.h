#ifndef GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_PYRAMID_H
#define GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_PYRAMID_H

#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "scene/levels.h"

namespace visual {

/// An image in smaller and smaller copies, side by side on a few sheets: so that OpenCV, which
/// takes memory whenever it is called, need not be called for each of them. Keeps its memory from
/// one image to the next.
class Pyramid {
 public:
  /// Pixels around a level on its sheet that mirror those inside of it.
  static constexpr int kPad = 4;

  /// @param levels  how many, and of what size
  /// @param sheets  at most, with about as many pixels each
  explicit Pyramid(const Levels& levels, int sheets = 1);

  /// @param grey  8 bits, 1 channel, at least 1 x 1; it is copied
  void build(const cv::Mat& grey);

  int count() const noexcept { return levels_.count(); }
  const Levels& levels() const noexcept { return levels_; }
  /// 8 bits, 1 channel, at least 1 x 1.
  const cv::Mat& level(int i) const noexcept { return places_[std::size_t(i)].image; }
  /// @{
  /// Pixels of the image that one of the level has: of its width and of its height. Sizes are
  /// whole, so that they are near to Levels::factor(), not equal.
  double ratioU(int i) const noexcept { return double(level(0).cols) / level(i).cols; }
  double ratioV(int i) const noexcept { return double(level(0).rows) / level(i).rows; }
  /// @}

  std::size_t sheetCount() const noexcept { return sheets_.size(); }
  /// What is between the levels is zero.
  const cv::Mat& sheet(std::size_t i) const noexcept { return sheets_[i].image; }
  /// @{
  /// Levels on a sheet: from the first one up to the last but one.
  int firstOn(std::size_t sheet) const noexcept { return sheets_[sheet].first; }
  int endOf(std::size_t sheet) const noexcept { return sheets_[sheet].end; }
  /// @}
  /// Where a level is on its sheet.
  const cv::Rect& place(int i) const noexcept { return places_[std::size_t(i)].on_sheet; }

 private:
  struct Place {
    cv::Rect on_sheet;
    cv::Mat image;   // on its sheet
    cv::Mat padded;  // with what is around it
  };
  struct Sheet {
    int first, end;
    cv::Mat image;
  };
  void layOut(const cv::Size& size);
  void layOut(Sheet& sheet);

  Levels levels_;
  std::array<Place, Levels::kMost> places_;
  std::vector<Sheet> sheets_;
};

/// @{
/// From a coordinate of a level to that of the image and back: centres of pixels are whole numbers,
/// borders of pixels stay borders.
inline double toImage(double at, double ratio) noexcept {
  return (at + 0.5) * ratio - 0.5;
}
inline double toLevel(double at, double ratio) noexcept {
  return (at + 0.5) / ratio - 0.5;
}
/// @}

}  // namespace visual

#endif  // GSLAM_PLUGINS_SLAM_VISUAL_FEATURES_PYRAMID_H
