// The equations of a bundle by brute force: residuals by plain formulas, derivatives by
// differences, sums and eliminations in long double. Plain loops, which compile fast.
#ifndef GSLAM_OPTIMIZER_TESTS_BUNDLE_BRUTE_FORCE_H
#define GSLAM_OPTIMIZER_TESTS_BUNDLE_BRUTE_FORCE_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bundle_scene.h"
#include "factors/loss.h"

namespace bundle_scene {

/// Linear equations H x = b, positive definite, with any number of right sides: rows of H, each
/// with its right sides behind.
class LongSystem {
 public:
  explicit LongSystem(int size, int right_sides = 1)
      : size_(size), width_(size + right_sides), values_(std::size_t(size_ * width_)) {}

  int size() const { return size_; }
  long double& operator()(int row, int column) { return values_[place(row, column)]; }
  double operator()(int row, int column) const { return double(values_[place(row, column)]); }
  /// Takes `count` variables from `first` on out of all rows but their own. The other rows and
  /// columns hold their Schur complement then.
  void eliminate(int first, int count) {
    for (int k = first; k < first + count; ++k) {
      for (int row = 0; row < size_; ++row) {
        const long double factor = values_[place(row, k)] / values_[place(k, k)];
        if (row == k || factor == 0) continue;
        for (int c = 0; c < width_; ++c) {
          values_[place(row, c)] -= factor * values_[place(k, c)];
        }
      }
    }
  }
  /// Of the variables from `first` on, six a time.
  void eliminateAllBut(const std::vector<int>& kept) {
    std::vector<bool> is_kept(std::size_t(size_), false);
    for (const int first : kept) {
      for (int i = 0; i < 6; ++i) is_kept[std::size_t(first + i)] = true;
    }
    for (int k = 0; k < size_; ++k) {
      if (!is_kept[std::size_t(k)]) eliminate(k, 1);
    }
  }
  /// After eliminate() of all.
  double solution(int row, int right_side = 0) const {
    return double(values_[place(row, size_ + right_side)] / values_[place(row, row)]);
  }

 private:
  std::size_t place(int row, int column) const { return std::size_t(row * width_ + column); }

  int size_, width_;
  std::vector<long double> values_;
};

/// Lower root L of a positive definite (n x n) matrix L L^T, row by row.
inline std::vector<double> lowerRoot(const double* matrix, std::size_t n) {
  std::vector<double> l(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = matrix[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= l[i * n + k] * l[j * n + k];
      l[i * n + j] = i == j ? std::sqrt(sum) : sum / l[j * n + j];
    }
  }
  return l;
}

/// L^T e for the information L L^T.
inline void addWhitened(const double* information, std::size_t n, const double* e,
                        std::vector<double>& r) {
  const std::vector<double> l = lowerRoot(information, n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t k = i; k < n; ++k) sum += l[k * n + i] * e[k];
    r.push_back(sum);
  }
}

/// The variables of a bundle in a row: free poses, extrinsics, intrinsics (of cameras), points.
class Variables {
 public:
  explicit Variables(const BundleProblem& p) : p_(p) {
    for (std::size_t i = 0; i < p.T_world_body.size(); ++i) {
      pose.push_back(p.pose_fixed.empty() || p.pose_fixed[i] == 0 ? take(6) : -1);
    }
    for (std::size_t c = 0; c < p.cameras.size(); ++c) {
      extrinsic.push_back(!p.T_body_camera_free.empty() && p.T_body_camera_free[c] != 0 ? take(6)
                                                                                        : -1);
    }
    for (std::size_t c = 0; c < p.cameras.size(); ++c) {
      parameters.emplace_back();
      if (!p.camera_freedom.empty()) {
        for (unsigned k = 0; k < p.cameras[c].parameterCount(); ++k) {
          if (k == 1 && p.camera_freedom[c].keeps_aspect) continue;
          if ((p.camera_freedom[c].parameters >> k & 1u) != 0) parameters[c].push_back(k);
        }
      }
      intrinsic.push_back(parameters[c].empty() ? -1 : take(int(parameters[c].size())));
    }
    camera_size = size;
    for (std::size_t i = 0; i < p.points.size(); ++i) {
      point.push_back(p.point_fixed.empty() || p.point_fixed[i] == 0 ? take(3) : -1);
    }
  }

  /// The residuals after a step: observations first, 3 each, then those of priors, whitened.
  std::vector<double> residuals(const std::vector<double>& d) const {
    std::vector<SE3d> poses(p_.T_world_body.begin(), p_.T_world_body.end());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (pose[i] >= 0) poses[i] *= SE3d::exp(six(d, pose[i]));
    }
    std::vector<SE3d> extrinsics(p_.T_body_camera.begin(), p_.T_body_camera.end());
    extrinsics.resize(p_.cameras.size());
    std::vector<Camera> cameras(p_.cameras.begin(), p_.cameras.end());
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      if (extrinsic[c] >= 0) extrinsics[c] *= SE3d::exp(six(d, extrinsic[c]));
      if (intrinsic[c] >= 0) cameras[c] = stepped(c, d);
    }
    std::vector<double> r;
    for (std::size_t i = 0; i < p_.pixels.size(); ++i) {
      const std::uint32_t c = p_.observation_camera.empty() ? 0 : p_.observation_camera[i];
      const Vec3d world = worldPoint(p_.observation_point[i], d, poses);
      const Vec3d x = extrinsics[c].inverse() * (poses[p_.observation_pose[i]].inverse() * world);
      addObservation(i, cameras[c], c, x, r);
    }
    addPriors(poses, r);
    return r;
  }

  /// Derivatives of all residuals by variable k, by differences.
  std::vector<double> column(int k) const {
    const double h = isIntrinsic(k) ? 1e-4 : 3e-4;
    std::vector<double> d(std::size_t(size), 0);
    const auto at = [&](double x) {
      d[std::size_t(k)] = x;
      return residuals(d);
    };
    const std::vector<double> a = at(h), b = at(-h), c = at(2 * h), e = at(-2 * h);
    std::vector<double> j(a.size());
    for (std::size_t i = 0; i < j.size(); ++i) {
      j[i] = (8 * (a[i] - b[i]) - (c[i] - e[i])) / (12 * h);
    }
    return j;
  }

  /// J^T w J x = J^T w r with the weights w of the loss, and `more` right sides of zeros.
  LongSystem equations(const gslam::RobustLoss& loss, int more = 0) const {
    const std::vector<double> r = residuals(std::vector<double>(std::size_t(size), 0));
    std::vector<double> weights(r.size(), 1);
    for (std::size_t i = 0; i < 3 * p_.pixels.size(); ++i) {
      const double* const e = &r[i - i % 3];
      weights[i] = gslam::detail::lossAt(loss, e[0] * e[0] + e[1] * e[1] + e[2] * e[2]).first;
    }
    std::vector<std::vector<double>> columns;
    for (int k = 0; k < size; ++k) columns.push_back(column(k));
    columns.push_back(r);
    LongSystem system(size, 1 + more);
    for (int a = 0; a < size; ++a) {
      for (std::size_t i = 0; i < r.size(); ++i) {
        const long double weighted = weights[i] * (long double)(columns[std::size_t(a)][i]);
        if (weighted == 0) continue;
        for (int b = 0; b <= size; ++b) system(a, b) += weighted * columns[std::size_t(b)][i];
      }
    }
    return system;
  }

  std::vector<int> pose, extrinsic, intrinsic, point;  // where each begins; -1: fixed
  std::vector<std::vector<unsigned>> parameters;       // free ones of each camera
  int size = 0;
  int camera_size = 0;  // all but points

 private:
  int take(int count) {
    size += count;
    return size - count;
  }
  bool isIntrinsic(int k) const {
    for (std::size_t c = 0; c < intrinsic.size(); ++c) {
      if (intrinsic[c] >= 0 && k >= intrinsic[c] && k < intrinsic[c] + int(parameters[c].size())) {
        return true;
      }
    }
    return false;
  }
  static SE3d::Tangent six(const std::vector<double>& d, int first) {
    SE3d::Tangent t;
    for (int i = 0; i < 6; ++i) t[std::size_t(i)] = d[std::size_t(first + i)];
    return t;
  }
  Camera stepped(std::size_t c, const std::vector<double>& d) const {
    const Camera& camera = p_.cameras[c];
    std::vector<double> values = camera.parameters();
    const double aspect = values[1] / values[0];
    for (std::size_t k = 0; k < parameters[c].size(); ++k) {
      values[parameters[c][k]] += d[std::size_t(intrinsic[c]) + k];
    }
    if (p_.camera_freedom[c].keeps_aspect) values[1] = aspect * values[0];
    return Camera::fromParameters(camera.modelName(), camera.width(), camera.height(), values);
  }
  // Anchored points move with their anchors; the variables themselves are x, y, z of the world
  // (another basis of the same space, which does not change what is left when points are gone).
  Vec3d worldPoint(std::uint32_t i, const std::vector<double>& d,
                   const std::vector<SE3d>& poses) const {
    Vec3d x = p_.points[i];
    if (point[i] < 0) return x;
    for (std::size_t k = 0; k < 3; ++k) x[k] += d[std::size_t(point[i]) + k];
    if (p_.point_anchor.empty() || p_.point_anchor[i] == BundleProblem::kNoAnchor) return x;
    const std::uint32_t a = p_.point_anchor[i];
    return poses[a] * (p_.T_world_body[a].inverse() * x);
  }
  void addObservation(std::size_t i, const Camera& camera, std::uint32_t c, const Vec3d& x,
                      std::vector<double>& r) const {
    Vec2d left{}, right{};
    (void)camera.project(x, left);
    const Vec3d w = p_.information.empty() ? Vec3d{1, 0, 1} : p_.information[i];
    const double information[] = {w[0], w[1], w[1], w[2]};
    addWhitened(information, 2, (left - p_.pixels[i]).values, r);
    const bool has_right = !p_.right_u.empty() && std::isfinite(p_.right_u[i]);
    if (has_right) (void)camera.project({x[0] - p_.baseline[c], x[1], x[2]}, right);
    r.push_back(has_right ? std::sqrt(w[0]) * (right[0] - p_.right_u[i]) : 0.0);
  }
  // Of a window prior, as the residual L^T d + L^-1 b with H = L L^T.
  static void addWindow(const gslam::WindowPrior& prior, const std::vector<SE3d>& poses,
                        std::vector<double>& r) {
    const std::size_t n = prior.gradient.size(), first = r.size();
    std::vector<double> d, e = prior.gradient;
    for (std::size_t k = 0; k < prior.poses.size(); ++k) {
      const SE3d::Tangent t = (prior.T_linear[k].inverse() * poses[prior.poses[k]]).log();
      d.insert(d.end(), t.values, t.values + 6);
    }
    addWhitened(prior.information.data(), n, d.data(), r);
    const std::vector<double> l = lowerRoot(prior.information.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < i; ++k) e[i] -= l[i * n + k] * e[k];
      e[i] /= l[i * n + i];
      r[first + i] += e[i];
    }
  }
  void addPriors(const std::vector<SE3d>& poses, std::vector<double>& r) const {
    for (const auto& q : p_.position_priors) {
      addWhitened(q.information.values, 3, (poses[q.pose].translation() - q.position).values, r);
    }
    for (const auto& q : p_.pose_priors) {
      const SE3d::Tangent e = (q.T_world_body.inverse() * poses[q.pose]).log();
      addWhitened(q.information.values, 6, e.values, r);
    }
    for (const auto& q : p_.relative_priors) {
      const SE3d between = poses[q.from].inverse() * poses[q.to];
      const SE3d::Tangent e = (q.T_from_to.inverse() * between).log();
      addWhitened(q.information.values, 6, e.values, r);
    }
    for (const auto& q : p_.window_priors) addWindow(q, poses, r);
  }

  const BundleProblem p_;
};

}  // namespace bundle_scene

#endif  // GSLAM_OPTIMIZER_TESTS_BUNDLE_BRUTE_FORCE_H
