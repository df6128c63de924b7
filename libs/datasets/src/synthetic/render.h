// Pictures of a scene without the errors of a sensor.
#ifndef GSLAM_DATASETS_SRC_SYNTHETIC_RENDER_H
#define GSLAM_DATASETS_SRC_SYNTHETIC_RENDER_H

#include <gslam/geometry/se3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "rays.h"
#include "scene.h"
#include "view.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace synthetic {

/// What one camera sees at one time: planes of width x height numbers, row by row.
struct Picture {
  int width = 0, height = 0;
  bool is_colour = false;
  std::array<std::vector<float>, 3> brightness;  ///< 0 to 255: grey, or red, green, blue
  std::vector<float> distance;                   ///< along the ray, metres; infinite: the sky
  std::vector<float> move_u, move_v;             ///< pixels a second; empty unless asked for
};

/// How a camera moves, in its own coordinates.
struct CameraMotion {
  Vec3f velocity{};  ///< m/s
  Vec3f turning{};   ///< rad/s
};

struct RenderOptions {
  bool colour = false;
  bool motion = false;   ///< whether move_u and move_v are wanted
  unsigned threads = 0;  ///< as ParallelOptions::threads
};

/// Renders for one camera; keeps its memory from picture to picture. One thread may use it.
class Renderer {
 public:
  explicit Renderer(std::shared_ptr<const Rays> rays);

  const Rays& rays() const { return *rays_; }
  /// @param seconds  where what moves by itself is
  const Picture& render(const Scene& scene, const SE3d& T_world_camera, double seconds,
                        const CameraMotion& motion, const RenderOptions& options);

 private:
  static constexpr int kBlock = 4;  // tiles along the edge of a block

  void traceBlock(const View& view, std::size_t block);
  void shadePixels(const View& view, int column, int row);
  bool shadeUniform(const View& view, const RayTile& tile, int first_u, int first_v,
                    const std::vector<std::int32_t>& candidates);
  void store(std::size_t at, const Colour& colour);
  Colour shadePixel(const View& view, const RayTile& tile, int i, int u, int v,
                    const std::vector<std::int32_t>& candidates) const;
  bool isEdge(int u, int v) const;
  Colour shadeEdge(const View& view, const RayTile& tile, int i,
                   const std::vector<std::int32_t>& candidates) const;
  void setMotion(const RayTile& tile, const CameraMotion& motion, int column, int row);

  std::shared_ptr<const Rays> rays_;
  int block_columns_, block_rows_;
  std::vector<TileBounds> block_bounds_;
  std::vector<std::vector<std::int32_t>> candidates_;  // of each tile
  std::vector<std::int32_t> primitive_;                // of each pixel
  Picture picture_;
};

}  // namespace synthetic
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_SRC_SYNTHETIC_RENDER_H
