#ifndef GSLAM_OPTIMIZER_SRC_INITIALIZE_POSES_CHORDAL_H
#define GSLAM_OPTIMIZER_SRC_INITIALIZE_POSES_CHORDAL_H

#include <gslam/geometry/nearest_rotation.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "initialize_poses_roots.h"
#include "sparse/block_cholesky.h"

// The start of a pose graph by linear least squares: rotations, scales, translations.

namespace gslam {
inline namespace v1 {
namespace detail {

inline bool projectRotation(const Mat2d& m, SO2d& rotation) {
  const double cosine = m(0, 0) + m(1, 1), sine = m(1, 0) - m(0, 1);
  if (!(std::isfinite(cosine) && std::isfinite(sine) && std::hypot(cosine, sine) > 1e-12)) {
    return false;
  }
  rotation = SO2d::fromComplex(cosine, sine);
  return true;
}

inline bool projectRotation(const Mat3d& m, SO3d& rotation) {
  for (const double value : m.values) {
    if (!std::isfinite(value)) return false;
  }
  rotation = nearestRotation(m).rotation;
  return true;
}

inline double scaleOf(const SE2d&) {
  return 1;
}
inline double scaleOf(const SE3d&) {
  return 1;
}
inline double scaleOf(const SIM3d& pose) {
  return pose.scale();
}

inline SE2d poseOf(const SO2d& rotation, const Vec2d& translation, const SE2d*, double) {
  return {rotation, translation};
}
inline SE3d poseOf(const SO3d& rotation, const Vec3d& translation, const SE3d*, double) {
  return {rotation, translation};
}
inline SIM3d poseOf(const SO3d& rotation, const Vec3d& translation, const SIM3d*, double scale) {
  return {rotation, translation, scale};
}

template <class Group>
class ChordalStart {
 public:
  // `tree`: the roots, which stay where they are.
  ChordalStart(const PoseGraphProblem<Group>& problem, const PoseTree<Group>& tree)
      : problem_(problem), tree_(tree), variable_(tree.poses.size(), kNoBlock) {
    BlockIndex count = 0;
    for (std::size_t i = 0; i < variable_.size(); ++i) {
      if (tree.is_known[i] == 0) variable_[i] = count++;
    }
    variables_ = count;
    for (std::size_t e = 0; e < problem.from.size(); ++e) {
      addTerm(variable_[problem.from[e]], variable_[problem.to[e]], problem.from[e], problem.to[e],
              problem.T_from_to[e],
              problem.information.empty() ? nullptr : &problem.information[e]);
    }
    for (std::size_t k = 0; k < problem.prior_pose.size(); ++k) {
      const std::size_t to = problem.prior_pose[k];
      if (!StartWeight<Group>::of(problem.prior_information[k]).isComplete()) continue;
      addTerm(kNoBlock, variable_[to], kNoPose, to, problem.prior_T_world_body[k],
              &problem.prior_information[k]);
    }
    for (const Term& term : terms_) {
      if (term.isPair()) pairs_.emplace_back(term.to, term.from);
    }
  }

  // Whether all equations could be solved; if so the poses hold the solution.
  bool solve(std::vector<Group>& poses) {
    const Elimination plan = planElimination(variables_, pairs_);
    return solveRotations(plan) && solveScales(plan) && solveTranslations(plan) && finish(poses);
  }

 private:
  static constexpr std::size_t d = Group::Point::size();
  static constexpr std::size_t kNoPose = ~std::size_t(0);
  using Point = typename Group::Point;
  using Square = Mat<double, d, d>;
  using Rotation = typename std::decay<decltype(Group().rotation())>::type;

  struct Term {
    BlockIndex from, to;             // variables
    std::size_t from_pose, to_pose;  // kNoPose: the world
    const Group* measured;
    StartWeight<Group> weight;
    bool isPair() const { return from != kNoBlock && to != kNoBlock; }
  };

  void addTerm(BlockIndex from, BlockIndex to, std::size_t from_pose, std::size_t to_pose,
               const Group& measured, const typename Group::Jacobian* information) {
    if (from == kNoBlock && to == kNoBlock) return;
    Term term{from, to, from_pose, to_pose, &measured, {}};
    if (information != nullptr) term.weight = StartWeight<Group>::of(*information);
    terms_.push_back(term);
  }

  Group knownPose(std::size_t pose) const { return pose == kNoPose ? Group() : tree_.poses[pose]; }

  // Rows x of rotation matrices: x_to = M^T x_from for each of the d rows.
  bool solveRotations(const Elimination& plan) {
    std::vector<Square> diagonal(variables_, Square{}), beside;
    std::vector<std::vector<double>> rows(d, std::vector<double>(variables_ * d, 0.0));
    beside.reserve(pairs_.size());
    for (const Term& term : terms_) {
      const Square m = term.weight.kappa * term.measured->rotation().matrix();
      for (std::size_t k = 0; k < d; ++k) {
        if (term.from != kNoBlock) diagonal[term.from](k, k) += term.weight.kappa;
        if (term.to != kNoBlock) diagonal[term.to](k, k) += term.weight.kappa;
      }
      if (term.isPair()) {
        beside.push_back(-m.transpose());
      } else if (term.to != kNoBlock) {
        addKnownRotation(term.to, m.transpose(), knownPose(term.from_pose), rows);
      } else {
        addKnownRotation(term.from, m, knownPose(term.to_pose), rows);
      }
    }
    BlockCholesky cholesky(plan, d, pairs_);
    if (!decompose(cholesky, diagonal, beside)) return false;
    for (std::vector<double>& row : rows) cholesky.solve(row.data());
    rotations_.resize(variables_);
    for (std::size_t v = 0; v < variables_; ++v) {
      Square relaxed;
      for (std::size_t r = 0; r < d; ++r) {
        for (std::size_t c = 0; c < d; ++c) relaxed(r, c) = rows[r][v * d + c];
      }
      if (!projectRotation(relaxed, rotations_[v])) return false;
    }
    return true;
  }

  static void addKnownRotation(BlockIndex variable, const Square& m, const Group& known,
                               std::vector<std::vector<double>>& rows) {
    const Square rotation = known.rotation().matrix();
    for (std::size_t r = 0; r < d; ++r) {
      const Point sum = m * rotation.row(r);
      for (std::size_t c = 0; c < d; ++c) rows[r][variable * d + c] += sum[c];
    }
  }

  // Differences of numbers: x_to - x_from = difference(term).
  template <std::size_t K, class Weight, class Known, class Difference>
  bool solveDifferences(const Elimination& plan, const Weight& weight_of, const Known& known,
                        const Difference& difference, std::vector<Vec<double, K>>& result) {
    std::vector<Mat<double, 1, 1>> diagonal(variables_, Mat<double, 1, 1>{}), beside;
    std::vector<std::vector<double>> sides(K, std::vector<double>(variables_, 0.0));
    for (const Term& term : terms_) {
      const double weight = weight_of(term);
      const Vec<double, K> step = difference(term);
      if (term.isPair()) beside.push_back({{-weight}});
      const auto add = [&](BlockIndex at, BlockIndex other, std::size_t other_pose, double sign) {
        if (at == kNoBlock) return;
        diagonal[at].values[0] += weight;
        Vec<double, K> side = sign * step;
        if (other == kNoBlock) side += known(other_pose);
        for (std::size_t k = 0; k < K; ++k) sides[k][at] += weight * side[k];
      };
      add(term.to, term.from, term.from_pose, 1);
      add(term.from, term.to, term.to_pose, -1);
    }
    BlockCholesky cholesky(plan, 1, pairs_);
    if (!decompose(cholesky, diagonal, beside)) return false;
    result.resize(variables_);
    for (std::size_t k = 0; k < K; ++k) {
      cholesky.solve(sides[k].data());
      for (std::size_t v = 0; v < variables_; ++v) result[v][k] = sides[k][v];
    }
    return true;
  }

  bool solveScales(const Elimination& plan) {
    scales_.assign(variables_, 1.0);
    if (Group::kFreedom != 7) return true;
    std::vector<Vec<double, 1>> logarithms;
    const auto weight = [](const Term& term) { return term.weight.scale; };
    const auto known = [&](std::size_t pose) {
      return Vec<double, 1>{{std::log(scaleOf(knownPose(pose)))}};
    };
    const auto difference = [](const Term& term) {
      return Vec<double, 1>{{std::log(scaleOf(*term.measured))}};
    };
    if (!solveDifferences<1>(plan, weight, known, difference, logarithms)) return false;
    for (std::size_t v = 0; v < variables_; ++v) {
      scales_[v] = std::exp(logarithms[v][0]);
      if (!(scales_[v] > 0 && std::isfinite(scales_[v]))) return false;
    }
    return true;
  }

  // t_to - t_from = s_from R_from t. It is measured in the unit of `to`.
  bool solveTranslations(const Elimination& plan) {
    const auto scaleFrom = [&](const Term& term) {
      return term.from != kNoBlock ? scales_[term.from] : scaleOf(knownPose(term.from_pose));
    };
    const auto weight = [&](const Term& term) {
      const double unit = scaleFrom(term) * scaleOf(*term.measured);
      return term.weight.tau / (unit * unit);
    };
    const auto known = [&](std::size_t pose) { return Point(knownPose(pose).translation()); };
    const auto difference = [&](const Term& term) {
      const Rotation rotation =
          term.from != kNoBlock ? rotations_[term.from] : knownPose(term.from_pose).rotation();
      return Point(scaleFrom(term) * (rotation * Point(term.measured->translation())));
    };
    return solveDifferences<d>(plan, weight, known, difference, translations_);
  }

  bool finish(std::vector<Group>& poses) const {
    for (const Point& t : translations_) {
      for (const double value : t.values) {
        if (!std::isfinite(value)) return false;
      }
    }
    for (std::size_t i = 0; i < variable_.size(); ++i) {
      const BlockIndex v = variable_[i];
      if (v == kNoBlock) continue;
      poses[i] =
          poseOf(rotations_[v], translations_[v], static_cast<const Group*>(nullptr), scales_[v]);
    }
    return true;
  }

  template <class Block>
  static bool decompose(BlockCholesky& cholesky, const std::vector<Block>& diagonal,
                        const std::vector<Block>& beside) {
    constexpr double singular = 1e-14;  // of a diagonal element
    return cholesky.factorize(diagonal.empty() ? nullptr : diagonal.data()->data(),
                              beside.empty() ? nullptr : beside.data()->data(), 1) &&
           cholesky.leastPivot() > singular;
  }

  const PoseGraphProblem<Group>& problem_;
  const PoseTree<Group>& tree_;
  std::vector<BlockIndex> variable_;  // of each pose
  std::size_t variables_ = 0;
  std::vector<Term> terms_;
  std::vector<BlockPair> pairs_;
  std::vector<Rotation> rotations_;
  std::vector<double> scales_;
  std::vector<Point> translations_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_INITIALIZE_POSES_CHORDAL_H
