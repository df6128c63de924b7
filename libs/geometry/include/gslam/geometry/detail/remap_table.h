// Where each pixel of one camera's image is in the image of another one.
#ifndef GSLAM_GEOMETRY_DETAIL_REMAP_TABLE_H
#define GSLAM_GEOMETRY_DETAIL_REMAP_TABLE_H

#include <gslam/base/error.h>
#include <gslam/base/parallel.h>
#include <gslam/geometry/camera.h>
#include <gslam/geometry/detail/remap.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

struct RemapTable {
  RemapTable(const Camera& source, const Camera& target, const Mat<double, 3, 3>& R_source_target,
             const ParallelOptions& options) {
    checkSize(source);
    if (!target.isValid()) throw ArgumentError("target", "is no camera");
    if (target.height() > std::numeric_limits<std::int32_t>::max() / 8 / target.width()) {
      throw ArgumentError("target", "has " + std::to_string(target.width()) + " x " +
                                        std::to_string(target.height()) +
                                        " pixels, expected less than 2^28");
    }
    width = static_cast<std::size_t>(target.width());
    const std::size_t height = static_cast<std::size_t>(target.height());
    xy.resize(2 * width * height);
    fraction.resize(width * height);
    is_seen.resize(width * height);
    blocks.resize(blockCount() * height);
    ParallelOptions rows = options;
    if (rows.grain <= 1) rows.grain = 8;
    parallelChunks(
        0, height,
        [&](std::size_t first, std::size_t last) {
          fillRows(source, target, R_source_target, first, last);
        },
        rows);
  }

  RemapRow row(std::size_t v) const noexcept {
    return {xy.data() + 2 * width * v, fraction.data() + width * v, is_seen.data() + width * v,
            blocks.data() + blockCount() * v, static_cast<int>(width)};
  }

  std::size_t width = 0;  // of the target
  std::vector<std::int16_t> xy;
  std::vector<std::uint16_t> fraction;
  std::vector<std::uint8_t> is_seen;
  std::vector<RemapBlock> blocks;  // of 8 pixels each, whole ones only

 private:
  std::size_t blockCount() const noexcept { return width / kRemapBlock; }

  static void checkSize(const Camera& source) {
    if (!source.isValid()) throw ArgumentError("source", "is no camera");
    for (const int size : {source.width(), source.height()}) {
      if (size >= 2 && size <= 32767) continue;
      throw ArgumentError("source", "is " + std::to_string(source.width()) + " x " +
                                        std::to_string(source.height()) +
                                        " pixels, expected 2 to 32767 each way");
    }
  }

  void fillRows(const Camera& source, const Camera& target, const Mat<double, 3, 3>& rotation,
                std::size_t first, std::size_t last) {
    std::vector<Vec<double, 2>> pixels(width);
    std::vector<Vec<double, 3>> bearings(width);
    std::vector<std::uint8_t> has_bearing(width), has_pixel(width);
    for (std::size_t v = first; v < last; ++v) {
      for (std::size_t u = 0; u < width; ++u) {
        pixels[u] = {{static_cast<double>(u), static_cast<double>(v)}};
      }
      (void)target.unprojectMany(pixels, bearings, has_bearing);
      for (std::size_t u = 0; u < width; ++u) {
        bearings[u] = has_bearing[u] != 0 ? rotation * bearings[u] : Vec<double, 3>{};
      }
      (void)source.projectMany(bearings, pixels, has_pixel);
      for (std::size_t u = 0; u < width; ++u) {
        const std::size_t i = v * width + u;
        is_seen[i] = has_pixel[u] != 0 && setPixel(source, pixels[u], i) ? 1 : 0;
      }
      for (std::size_t b = 0; b < blockCount(); ++b) {
        blocks[v * blockCount() + b] = kindOf(source, v * width + b * kRemapBlock);
      }
    }
  }

  // Whether pixel i of the target, at `position` in the source, has four neighbours there.
  bool setPixel(const Camera& source, const Vec<double, 2>& position, std::size_t i) noexcept {
    int whole[2], part[2];
    const int size[2] = {source.width(), source.height()};
    for (std::size_t k = 0; k < 2; ++k) {
      const double steps = std::floor(position[k] * kRemapOne + 0.5);
      if (!(steps >= 0 && steps <= (size[k] - 1) * kRemapOne)) return false;
      const int n = static_cast<int>(steps);
      whole[k] = n / kRemapOne == size[k] - 1 ? size[k] - 2 : n / kRemapOne;
      part[k] = n - whole[k] * kRemapOne;
    }
    xy[2 * i] = static_cast<std::int16_t>(whole[0]);
    xy[2 * i + 1] = static_cast<std::int16_t>(whole[1]);
    fraction[i] = static_cast<std::uint16_t>(part[0] + 256 * part[1]);
    return true;
  }

  // Of the 8 pixels from i on. Kernels read 4 or 8 bytes of rows y and y + 1; only in the last row
  // of the image can these be beyond its end.
  RemapBlock kindOf(const Camera& source, std::size_t i) const noexcept {
    int seen = 0, easy = 0;
    for (std::size_t k = i; k < i + kRemapBlock; ++k) {
      if (is_seen[k] == 0) continue;
      ++seen;
      if (xy[2 * k + 1] < source.height() - 2 || xy[2 * k] <= source.width() - 4) ++easy;
    }
    if (seen == 0) return RemapBlock::unseen;
    return easy == kRemapBlock ? RemapBlock::easy : RemapBlock::mixed;
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_REMAP_TABLE_H
