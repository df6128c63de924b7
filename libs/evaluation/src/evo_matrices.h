// evo calculates with the matrices of KITTI's files as they stand, though their seven digits are no
// rotations by 1e-7, and takes the transpose for the inverse. Its translations are had to all
// digits only in the same way.
#ifndef GSLAM_EVALUATION_SRC_EVO_MATRICES_H
#define GSLAM_EVALUATION_SRC_EVO_MATRICES_H

#include <gslam/evaluation/align.h>
#include <gslam/evaluation/ape.h>
#include <gslam/evaluation/kitti.h>
#include <gslam/evaluation/pairs.h>
#include <gslam/evaluation/rpe.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/sim3.h>

#include <vector>

namespace gslam {
inline namespace v1 {
namespace evaluation {

class EvoMatrices {
 public:
  // The matrices of the pairs, those of the estimate aligned as evo does.
  EvoMatrices(const PosePairs& pairs, const std::vector<KittiMatrix>& reference,
              const std::vector<KittiMatrix>& estimate, AlignmentMethod method,
              const SIM3d& S_world_map);

  // Overwrites what depends on translations.
  void useInAbsolute(PoseErrors& errors) const;
  void useInRelative(const std::vector<PairRange>& ranges, PoseErrors& errors) const;

 private:
  struct Pose {
    Mat3d r;
    Vec3d t;

    Pose operator*(const Pose& other) const { return {r * other.r, r * other.t + t}; }
    Pose inverse() const { return {r.transpose(), -(r.transpose() * t)}; }
  };

  static Pose poseOf(const KittiMatrix& matrix);
  static void use(double translation, std::size_t i, PoseErrors& errors);

  std::vector<Pose> reference_, estimate_;
};

}  // namespace evaluation
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_EVO_MATRICES_H
