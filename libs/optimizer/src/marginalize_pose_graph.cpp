#include <gslam/base/error.h>
#include <gslam/optimizer/check.h>
#include <gslam/optimizer/marginalize.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "check_input.h"
#include "factors/bundle_terms.h"
#include "factors/loss.h"
#include "findings.h"
#include "marginalize_elimination.h"

namespace gslam {
inline namespace v1 {
namespace {

using PosePair = std::pair<std::uint32_t, std::uint32_t>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Edges between poses that see the same points.
class EdgesOfBundle {
 public:
  EdgesOfBundle(const BundleProblem& problem, const RobustLoss& loss)
      : problem_(problem),
        loss_(loss),
        blocks_(detail::bundleBlocks(problem)),
        values_(detail::bundleValues(problem, blocks_)) {
    sortObservations();
  }

  // Pairs of poses, and the points that both see.
  std::map<PosePair, std::vector<std::uint32_t>> sharedPoints() const {
    std::map<PosePair, std::vector<std::uint32_t>> shared;
    for (std::uint32_t point = 0; point < seen_.size(); ++point) {
      const std::vector<Sight>& seen = seen_[point];
      for (std::size_t a = 0; a < seen.size(); ++a) {
        if (a > 0 && seen[a].pose == seen[a - 1].pose) continue;
        for (std::size_t b = a + 1; b < seen.size(); ++b) {
          if (seen[b].pose == seen[b - 1].pose) continue;
          shared[{seen[a].pose, seen[b].pose}].push_back(point);
        }
      }
    }
    return shared;
  }

  // Of the tangent of T_from_to on the right, that is of `to` when `from` stays, without points.
  Mat<double, 6, 6> information(const PosePair& pair, const std::vector<std::uint32_t>& points) {
    Matrix6 full = Matrix6::Zero(), taken = Matrix6::Zero();
    for (const std::uint32_t point : points) addPoint(pair, point, full, taken);
    Eigen::MatrixXd left = full - taken;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(6);
    detail::clearRounding(full.diagonal(), left, gradient);
    Mat<double, 6, 6> information;
    for (std::size_t i = 0; i < 36; ++i) {
      const auto r = static_cast<Eigen::Index>(i / 6), c = static_cast<Eigen::Index>(i % 6);
      information.values[i] = 0.5 * (left(r, c) + left(c, r));
    }
    return information;
  }

 private:
  struct Sight {
    std::uint32_t pose;
    std::uint32_t observation;
  };
  // Whitened by the root of the loss' weight.
  struct Derivatives {
    Eigen::Matrix<double, 3, 6> by_pose;
    Eigen::Matrix3d by_point;
  };

  void sortObservations() {
    seen_.resize(problem_.points.size());
    derivatives_.resize(problem_.observation_point.size());
    for (std::uint32_t i = 0; i < derivatives_.size(); ++i) {
      if (!derive(i)) continue;
      seen_[problem_.observation_point[i]].push_back({problem_.observation_pose[i], i});
    }
    for (std::vector<Sight>& seen : seen_) {
      std::sort(seen.begin(), seen.end(), [](const Sight& a, const Sight& b) {
        return a.pose != b.pose ? a.pose < b.pose : a.observation < b.observation;
      });
    }
  }

  bool derive(std::uint32_t i) {
    const std::uint32_t camera = detail::cameraOf(problem_, i);
    Vec3d residual{};
    detail::ReprojectionJacobians j;
    if (!detail::reprojectionResidual(values_.T_world_body[problem_.observation_pose[i]],
                                      values_.T_body_camera[camera], values_.cameras[camera],
                                      values_.points[problem_.observation_point[i]],
                                      detail::observationAt(problem_, i), residual, &j, false)) {
      return false;
    }
    const detail::PixelRoot root = detail::pixelRoot(problem_, i);
    detail::whiten(root, residual.values, 1);
    detail::whiten(root, j.by_pose.values, 6);
    detail::whiten(root, j.by_point.values, 3);
    const double weight = std::sqrt(detail::lossAt(loss_, residual.squaredNorm()).first);
    Derivatives& d = derivatives_[i];
    d.by_pose =
        weight * Eigen::Map<const Eigen::Matrix<double, 3, 6, Eigen::RowMajor>>(j.by_pose.values);
    d.by_point =
        weight * Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(j.by_point.values);
    return true;
  }

  void addPoint(const PosePair& pair, std::uint32_t point, Matrix6& full, Matrix6& taken) const {
    Eigen::Matrix3d v = Eigen::Matrix3d::Zero();
    Eigen::Matrix<double, 6, 3> w = Eigen::Matrix<double, 6, 3>::Zero();
    for (const Sight& sight : seen_[point]) {
      if (sight.pose != pair.first && sight.pose != pair.second) continue;
      const Derivatives& d = derivatives_[sight.observation];
      v += d.by_point.transpose() * d.by_point;
      if (sight.pose != pair.second) continue;
      w += d.by_pose.transpose() * d.by_point;
      full += d.by_pose.transpose() * d.by_pose;
    }
    taken += w * detail::semidefiniteInverse(v, v.diagonal()) * w.transpose();
  }

  const BundleProblem& problem_;
  const RobustLoss loss_;
  const detail::BundleBlocks blocks_;
  const detail::BundleValues values_;
  std::vector<std::vector<Sight>> seen_;  // of each point, by pose
  std::vector<Derivatives> derivatives_;  // of each observation
};

}  // namespace

PoseGraph<SE3d> poseGraphOf(const BundleProblem& problem, std::size_t min_shared,
                            const RobustLoss& loss) {
  detail::checkLoss(loss, "loss");
  detail::throwFirstError(checkBundle(problem));
  if (min_shared < 3) {
    throw ArgumentError("min_shared", "is " + std::to_string(min_shared) + ", expected 3 or more");
  }
  PoseGraph<SE3d> graph;
  graph.T_world_body.assign(problem.T_world_body.begin(), problem.T_world_body.end());
  graph.pose_fixed.assign(problem.pose_fixed.begin(), problem.pose_fixed.end());
  EdgesOfBundle edges(problem, loss);
  for (const auto& shared : edges.sharedPoints()) {
    if (shared.second.size() < min_shared) continue;
    const PosePair& pair = shared.first;
    const Mat<double, 6, 6> information = edges.information(pair, shared.second);
    if (information == Mat<double, 6, 6>{}) continue;  // outliers only
    graph.from.push_back(pair.first);
    graph.to.push_back(pair.second);
    graph.T_from_to.push_back(problem.T_world_body[pair.first].inverse() *
                              problem.T_world_body[pair.second]);
    graph.information.push_back(information);
  }
  return graph;
}

}  // namespace v1
}  // namespace gslam
