#ifndef GSLAM_OPTIMIZER_SRC_FACTORS_BUNDLE_TERMS_H
#define GSLAM_OPTIMIZER_SRC_FACTORS_BUNDLE_TERMS_H

#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/vec.h>
#include <gslam/optimizer/bundle_problem.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "factors/bundle_blocks.h"
#include "factors/reprojection.h"

// The residuals of a bundle, with derivatives by the blocks of BundleBlocks.

namespace gslam {
inline namespace v1 {
namespace detail {

inline std::uint32_t cameraOf(const BundleProblem& problem, std::size_t observation) {
  return problem.observation_camera.empty() ? 0 : problem.observation_camera[observation];
}

inline ReprojectionObservation observationAt(const BundleProblem& problem, std::size_t i) {
  ReprojectionObservation observation;
  observation.pixel = problem.pixels[i];
  if (problem.right_u.empty() || !std::isfinite(problem.right_u[i])) return observation;
  observation.has_right = true;
  observation.right_u = problem.right_u[i];
  observation.baseline = problem.baseline[cameraOf(problem, i)];
  return observation;
}

// Upper root W of the information of a pixel, W^T W = information. That of u in the right image is
// xx.
struct PixelRoot {
  double xx = 1, xy = 0, yy = 1;

  PixelRoot() = default;
  explicit PixelRoot(const Vec3d& information) {
    xx = std::sqrt(std::max(0.0, information[0]));
    xy = xx > 0 ? information[1] / xx : 0;
    yy = std::sqrt(std::max(0.0, information[2] - xy * xy));
  }
  void apply(double& u, double& v) const {
    u = xx * u + xy * v;
    v *= yy;
  }
};

inline PixelRoot pixelRoot(const BundleProblem& problem, std::size_t observation) {
  return problem.information.empty() ? PixelRoot() : PixelRoot(problem.information[observation]);
}

// The blocks behind an observation besides its point, in the order of ObservationTerm::parts.
struct ObservationBlocks {
  std::uint32_t block[4];
  std::size_t count = 0;
};

inline ObservationBlocks observationBlocks(const BundleProblem& problem, const BundleBlocks& blocks,
                                           std::size_t i) {
  ObservationBlocks result;
  const auto add = [&result](std::uint32_t block) {
    if (block != kNoBlock) result.block[result.count++] = block;
  };
  const std::uint32_t pose = problem.observation_pose[i], camera = cameraOf(problem, i);
  const std::uint32_t anchor = blocks.anchorOf(problem.observation_point[i]);
  if (anchor != pose) {  // else the pose moves the point along, and nothing changes
    add(blocks.pose[pose]);
    if (anchor != kNoBlock) add(blocks.pose[anchor]);
  }
  add(blocks.extrinsic[camera]);
  add(blocks.intrinsic[camera]);
  return result;
}

// An observation: whitened residual and derivatives, 3 rows each.
struct ObservationTerm {
  double residual[3];
  double squared = 0;  // norm of the residual: the s of the loss
  struct Part {
    std::uint32_t block;
    std::uint32_t size;  // columns
    double rows[3 * 32];
  };
  std::size_t count = 0;  // of parts
  Part parts[4];          // in the order of observationBlocks()
  Mat3d by_point;         // by the variables of the point
};

// Multiplies three rows of `size` columns by the root.
inline void whiten(const PixelRoot& root, double* rows, std::size_t size) {
  for (std::size_t c = 0; c < size; ++c) {
    root.apply(rows[c], rows[size + c]);
    rows[2 * size + c] *= root.xx;
  }
}

inline void setIntrinsicPart(const ReprojectionJacobians& j, const FreeIntrinsics& freedom,
                             std::size_t parameter_count, ObservationTerm::Part& part) {
  part.size = static_cast<std::uint32_t>(freedom.parameters.size());
  for (std::size_t r = 0; r < 3; ++r) {
    const double* const from = j.by_camera + r * parameter_count;
    for (std::size_t c = 0; c < part.size; ++c) {
      part.rows[r * part.size + c] = from[freedom.parameters[c]];
    }
    if (freedom.aspect != 0) part.rows[r * part.size] += freedom.aspect * from[1];
  }
}

inline void setPosePart(const Mat<double, 3, 6>& j, ObservationTerm::Part& part) {
  part.size = 6;
  std::copy(j.values, j.values + 18, part.rows);
}

// The parts and by_point of observation i, from the derivatives, before whitening.
inline void setObservationParts(const BundleProblem& problem, const BundleBlocks& blocks,
                                const BundleValues& values, std::size_t i,
                                const ReprojectionJacobians& j, ObservationTerm& term) {
  const std::uint32_t pose = problem.observation_pose[i], camera = cameraOf(problem, i);
  const std::uint32_t point = problem.observation_point[i], anchor = blocks.anchorOf(point);
  const auto add = [&term](std::uint32_t block) -> ObservationTerm::Part& {
    term.parts[term.count].block = block;
    return term.parts[term.count++];
  };
  term.by_point = j.by_point;
  if (anchor != pose && blocks.pose[pose] != kNoBlock) {
    setPosePart(j.by_pose, add(blocks.pose[pose]));
  }
  if (anchor != kNoBlock) {
    const SE3d& T_world_anchor = values.T_world_body[anchor];
    if (anchor != pose && blocks.pose[anchor] != kNoBlock) {
      setPosePart(j.by_point * T_world_anchor.actionJacobian(inAnchor(values.anchored[point])),
                  add(blocks.pose[anchor]));
    }
    term.by_point = j.by_point *
                    (T_world_anchor.rotation().matrix() * anchoredJacobian(values.anchored[point]));
  }
  if (blocks.extrinsic[camera] != kNoBlock) {
    setPosePart(j.by_extrinsic, add(blocks.extrinsic[camera]));
  }
  if (blocks.intrinsic[camera] != kNoBlock) {
    setIntrinsicPart(j, blocks.freedom[camera], values.cameras[camera].parameterCount(),
                     add(blocks.intrinsic[camera]));
  }
}

// Observation i. False where the camera does not see the point. Without derivatives only residual
// and squared are set.
inline bool observationTerm(const BundleProblem& problem, const BundleBlocks& blocks,
                            const BundleValues& values, std::size_t i, bool with_derivatives,
                            ObservationTerm& term) {
  const std::uint32_t camera = cameraOf(problem, i);
  Vec3d residual{};
  ReprojectionJacobians j;
  if (!reprojectionResidual(values.T_world_body[problem.observation_pose[i]],
                            values.T_body_camera[camera], values.cameras[camera],
                            values.points[problem.observation_point[i]], observationAt(problem, i),
                            residual, with_derivatives ? &j : nullptr,
                            blocks.intrinsic[camera] != kNoBlock)) {
    return false;
  }
  const PixelRoot root = pixelRoot(problem, i);
  std::copy(residual.values, residual.values + 3, term.residual);
  whiten(root, term.residual, 1);
  term.squared = term.residual[0] * term.residual[0] + term.residual[1] * term.residual[1] +
                 term.residual[2] * term.residual[2];
  if (!with_derivatives) return true;
  term.count = 0;
  setObservationParts(problem, blocks, values, i, j, term);
  for (std::size_t k = 0; k < term.count; ++k) whiten(root, term.parts[k].rows, term.parts[k].size);
  whiten(root, term.by_point.values, 3);
  return true;
}

// What is known of one or several poses: cost, and its first and second derivative (of Gauss and
// Newton) by the stacked tangents of the poses.
struct PriorTerm {
  std::vector<std::uint32_t> poses;
  double cost = 0;
  std::vector<double> gradient;  // 6 for each pose
  std::vector<double> hessian;   // square, row by row
};

// cost = 1/2 r^T information r; one of `jacobians` for each pose of the term.
template <std::size_t R>
inline void setPriorTerm(const Vec<double, R>& r, const Mat<double, R, R>& information,
                         const Mat<double, R, 6>* jacobians, bool with_derivatives,
                         PriorTerm& term) {
  const Vec<double, R> weighted = information * r;
  term.cost = 0.5 * r.dot(weighted);
  if (!with_derivatives) return;
  const std::size_t n = term.poses.size(), size = 6 * n;
  term.gradient.resize(size);
  term.hessian.resize(size * size);
  for (std::size_t a = 0; a < n; ++a) {
    const Mat<double, 6, R> back = jacobians[a].transpose();
    const Vec<double, 6> gradient = back * weighted;
    std::copy(gradient.values, gradient.values + 6, &term.gradient[6 * a]);
    for (std::size_t b = 0; b < n; ++b) {
      const Mat<double, 6, 6> block = back * (information * jacobians[b]);
      for (std::size_t i = 0; i < 36; ++i) {
        term.hessian[(6 * a + i / 6) * size + 6 * b + i % 6] = block.values[i];
      }
    }
  }
}

inline void setPositionTerm(const PositionPrior& prior, const BundleValues& values,
                            bool with_derivatives, PriorTerm& term) {
  const SE3d& pose = values.T_world_body[prior.pose];
  term.poses.assign(1, prior.pose);
  Mat<double, 3, 6> j{};
  j.setBlock(0, 0, pose.rotation().matrix());
  setPriorTerm<3>(pose.translation() - prior.position, prior.information, &j, with_derivatives,
                  term);
}

inline void setPoseTerm(const AbsolutePosePrior& prior, const BundleValues& values,
                        bool with_derivatives, PriorTerm& term) {
  term.poses.assign(1, prior.pose);
  const SE3d::Tangent r = (prior.T_world_body.inverse() * values.T_world_body[prior.pose]).log();
  const Mat<double, 6, 6> j = SE3d::rightJacobianInverse(r);
  setPriorTerm<6>(r, prior.information, &j, with_derivatives, term);
}

inline void setRelativeTerm(const RelativePosePrior& prior, const BundleValues& values,
                            bool with_derivatives, PriorTerm& term) {
  term.poses = {prior.from, prior.to};
  const SE3d between = values.T_world_body[prior.from].inverse() * values.T_world_body[prior.to];
  const SE3d::Tangent r = (prior.T_from_to.inverse() * between).log();
  const Mat<double, 6, 6> by_to = SE3d::rightJacobianInverse(r);
  // exp(-d) T = T exp(-Ad(T^-1) d)
  const Mat<double, 6, 6> jacobians[] = {-(by_to * between.inverse().adjoint()), by_to};
  setPriorTerm<6>(r, prior.information, jacobians, with_derivatives, term);
}

// Multiplies 6 numbers, `stride` apart, by the transpose of a matrix.
inline void turnSix(const Mat<double, 6, 6>& j, double* values, std::size_t stride) {
  Vec<double, 6> old;
  for (std::size_t i = 0; i < 6; ++i) old[i] = values[i * stride];
  const Vec<double, 6> turned = j.transpose() * old;
  for (std::size_t i = 0; i < 6; ++i) values[i * stride] = turned[i];
}

inline void setWindowTerm(const WindowPrior& prior, const BundleValues& values,
                          bool with_derivatives, PriorTerm& term) {
  term.poses = prior.poses;
  const std::size_t n = prior.poses.size(), size = 6 * n;
  std::vector<double> d(size);
  for (std::size_t k = 0; k < n; ++k) {
    const SE3d::Tangent t =
        (prior.T_linear[k].inverse() * values.T_world_body[prior.poses[k]]).log();
    std::copy(t.values, t.values + 6, &d[6 * k]);
  }
  term.gradient.assign(prior.gradient.begin(), prior.gradient.end());
  term.cost = 0;
  for (std::size_t r = 0; r < size; ++r) {
    double sum = 0;
    for (std::size_t c = 0; c < size; ++c) sum += prior.information[r * size + c] * d[c];
    term.cost += d[r] * (0.5 * sum + prior.gradient[r]);
    term.gradient[r] += sum;
  }
  if (!with_derivatives) return;
  term.hessian = prior.information;
  for (std::size_t k = 0; k < n; ++k) {  // J^T (H d + b), J^T H J
    SE3d::Tangent t;
    std::copy_n(&d[6 * k], 6, t.values);
    const Mat<double, 6, 6> j = SE3d::rightJacobianInverse(t);
    turnSix(j, &term.gradient[6 * k], 1);
    for (std::size_t i = 0; i < size; ++i) turnSix(j, &term.hessian[6 * k * size + i], size);
    for (std::size_t i = 0; i < size; ++i) turnSix(j, &term.hessian[i * size + 6 * k], 1);
  }
}

// Calls visit(const PriorTerm&) for all that is known of poses.
template <class Visit>
inline void forEachPrior(const BundleProblem& problem, const BundleValues& values,
                         bool with_derivatives, const Visit& visit) {
  PriorTerm term;
  for (const PositionPrior& prior : problem.position_priors) {
    setPositionTerm(prior, values, with_derivatives, term);
    visit(term);
  }
  for (const AbsolutePosePrior& prior : problem.pose_priors) {
    setPoseTerm(prior, values, with_derivatives, term);
    visit(term);
  }
  for (const RelativePosePrior& prior : problem.relative_priors) {
    setRelativeTerm(prior, values, with_derivatives, term);
    visit(term);
  }
  for (const WindowPrior& prior : problem.window_priors) {
    setWindowTerm(prior, values, with_derivatives, term);
    visit(term);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FACTORS_BUNDLE_TERMS_H
