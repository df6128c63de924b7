#include <gslam/base/error.h>
#include <gslam/optimizer/check.h>
#include <gslam/optimizer/marginalize.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "check_input.h"
#include "factors/bundle_terms.h"
#include "factors/loss.h"
#include "findings.h"
#include "marginalize_elimination.h"

namespace gslam {
inline namespace v1 {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Rows = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>>;

Rows rowsOf(const double* values, std::size_t columns) {
  return Rows(values, 3, static_cast<Eigen::Index>(columns));
}

// The equations of a bundle, from which points and blocks are taken out one by one.
class Marginalization {
 public:
  Marginalization(const BundleProblem& problem, const RobustLoss& loss)
      : problem_(problem),
        loss_(loss),
        blocks_(detail::bundleBlocks(problem)),
        values_(detail::bundleValues(problem, blocks_)) {
    for (std::size_t b = 0; b < blocks_.count(); ++b) system_.addBlock(blocks_.size(b));
    listObservations();
  }

  WindowPrior keep(Span<const std::uint32_t> poses) {
    addPriors();
    // Their full diagonal tells rounding from information when the blocks are taken out.
    std::vector<PointEquations> points(problem_.points.size());
    for (std::size_t p = 0; p < points.size(); ++p) addPoint(p, points[p]);
    system_.keepDiagonal();
    for (PointEquations& point : points) {
      if (point.hessian.size() != 0) {
        holdFarthest(std::size_t(&point - points.data()), point);
        const Eigen::VectorXd diagonal = point.hessian.diagonal();
        system_.eliminate(detail::semidefiniteInverse(point.hessian, diagonal), point.gradient,
                          point.couplings);
      }
      point = PointEquations();
    }
    eliminateAllBut(poses);
    return priorOf(poses);
  }

 private:
  struct PointEquations {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;
    std::vector<detail::BlockSystem::Coupling> couplings;
  };

  void listObservations() {
    observations_.resize(problem_.points.size());
    for (std::uint32_t i = 0; i < problem_.observation_point.size(); ++i) {
      observations_[problem_.observation_point[i]].push_back(i);
    }
  }

  void addPoint(std::size_t point, PointEquations& equations) {
    const bool is_free = blocks_.point_free[point] != 0;
    detail::ObservationTerm term;
    for (const std::uint32_t i : observations_[point]) {
      if (!detail::observationTerm(problem_, blocks_, values_, i, true, term)) continue;
      const double weight = detail::lossAt(loss_, term.squared).first;
      const Eigen::Vector3d residual = weight * Eigen::Map<const Eigen::Vector3d>(term.residual);
      for (std::size_t k = 0; k < term.count; ++k) {
        const Rows a = rowsOf(term.parts[k].rows, term.parts[k].size);
        system_.addGradient(term.parts[k].block, a.transpose() * residual);
        for (std::size_t l = 0; l < term.count; ++l) {
          const Rows b = rowsOf(term.parts[l].rows, term.parts[l].size);
          system_.add(term.parts[k].block, term.parts[l].block,
                      Eigen::MatrixXd(weight * (a.transpose() * b)));
        }
      }
      if (is_free) addToPoint(term, weight, residual, equations);
    }
  }

  static void addToPoint(const detail::ObservationTerm& term, double weight,
                         const Eigen::Vector3d& residual, PointEquations& equations) {
    if (equations.hessian.size() == 0) {
      equations.hessian = Eigen::MatrixXd::Zero(3, 3);
      equations.gradient = Eigen::VectorXd::Zero(3);
    }
    const Rows p = rowsOf(term.by_point.values, 3);
    equations.hessian += weight * (p.transpose() * p);
    equations.gradient += p.transpose() * residual;
    for (std::size_t k = 0; k < term.count; ++k) {
      const Rows a = rowsOf(term.parts[k].rows, term.parts[k].size);
      const Eigen::MatrixXd coupling = weight * (a.transpose() * p);
      const auto place =
          std::find_if(equations.couplings.begin(), equations.couplings.end(),
                       [&](const auto& c) { return c.first == term.parts[k].block; });
      if (place != equations.couplings.end()) {
        place->second += coupling;
      } else {
        equations.couplings.emplace_back(term.parts[k].block, coupling);
      }
    }
  }

  // One that is as far as it can be is no variable beyond that: see isHeldFar().
  void holdFarthest(std::size_t point, PointEquations& equations) const {
    if (!detail::isHeldFar(blocks_, values_, point, equations.gradient(2))) return;
    equations.gradient(2) = 0;
    equations.hessian.row(2).setZero();
    equations.hessian.col(2).setZero();
    for (auto& coupling : equations.couplings) coupling.second.col(2).setZero();
  }

  void addPriors() {
    detail::forEachPrior(problem_, values_, true, [this](const detail::PriorTerm& term) {
      const auto n = static_cast<Eigen::Index>(term.gradient.size());
      const Eigen::Map<const RowMajor> hessian(term.hessian.data(), n, n);
      const Eigen::Map<const Eigen::VectorXd> gradient(term.gradient.data(), n);
      for (std::size_t a = 0; a < term.poses.size(); ++a) {
        const std::uint32_t row = blocks_.pose[term.poses[a]];
        if (row == detail::kNoBlock) continue;
        const auto top = static_cast<Eigen::Index>(6 * a);
        system_.addGradient(row, gradient.segment<6>(top));
        for (std::size_t b = 0; b < term.poses.size(); ++b) {
          const std::uint32_t column = blocks_.pose[term.poses[b]];
          if (column == detail::kNoBlock) continue;
          system_.add(row, column, hessian.block<6, 6>(top, static_cast<Eigen::Index>(6 * b)));
        }
      }
    });
  }

  // Those first that are coupled to the fewest others.
  void eliminateAllBut(Span<const std::uint32_t> poses) {
    std::vector<std::uint8_t> is_kept(system_.count());
    for (const std::uint32_t pose : poses) {
      if (blocks_.pose[pose] != detail::kNoBlock) is_kept[blocks_.pose[pose]] = 1;
    }
    std::vector<std::uint32_t> left;
    for (std::uint32_t b = 0; b < system_.count(); ++b) {
      if (is_kept[b] == 0) left.push_back(b);
    }
    while (!left.empty()) {
      const auto next =
          std::min_element(left.begin(), left.end(), [this](std::uint32_t a, std::uint32_t b) {
            return system_.neighbours(a) < system_.neighbours(b);
          });
      system_.eliminate(*next);
      left.erase(next);
    }
  }

  WindowPrior priorOf(Span<const std::uint32_t> poses) const {
    WindowPrior prior;
    for (const std::uint32_t pose : poses) {
      if (blocks_.pose[pose] == detail::kNoBlock) continue;
      prior.poses.push_back(pose);
      prior.T_linear.push_back(values_.T_world_body[pose]);
    }
    const auto n = static_cast<Eigen::Index>(6 * prior.poses.size());
    Eigen::MatrixXd hessian(n, n);
    Eigen::VectorXd gradient(n), diagonal(n);
    for (Eigen::Index a = 0; a < n; a += 6) {
      const std::uint32_t row = blocks_.pose[prior.poses[static_cast<std::size_t>(a / 6)]];
      gradient.segment<6>(a) = system_.gradient(row);
      diagonal.segment<6>(a) = system_.diagonal(row);
      for (Eigen::Index b = 0; b < n; b += 6) {
        const std::uint32_t column = blocks_.pose[prior.poses[static_cast<std::size_t>(b / 6)]];
        hessian.block<6, 6>(a, b) = system_.block(row, column);
      }
    }
    detail::clearRounding(diagonal, hessian, gradient);
    const Eigen::MatrixXd symmetric = 0.5 * (hessian + hessian.transpose());
    prior.information.assign(symmetric.data(), symmetric.data() + symmetric.size());
    prior.gradient.assign(gradient.data(), gradient.data() + gradient.size());
    return prior;
  }

  const BundleProblem& problem_;
  const RobustLoss loss_;
  const detail::BundleBlocks blocks_;
  const detail::BundleValues values_;
  detail::BlockSystem system_;
  std::vector<std::vector<std::uint32_t>> observations_;  // of each point
};

void checkKeptPoses(const BundleProblem& problem, Span<const std::uint32_t> keep) {
  std::vector<std::uint8_t> is_named(problem.T_world_body.size());
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const std::string name = "keep[" + std::to_string(i) + "]";
    if (keep[i] >= is_named.size()) {
      throw ArgumentError(name, "is " + std::to_string(keep[i]) + ", expected below " +
                                    std::to_string(is_named.size()));
    }
    if (is_named[keep[i]] != 0) {
      throw ArgumentError(name, "is " + std::to_string(keep[i]) + " for the second time");
    }
    is_named[keep[i]] = 1;
  }
}

}  // namespace

WindowPrior marginalize(const BundleProblem& problem, Span<const std::uint32_t> keep,
                        const RobustLoss& loss) {
  detail::checkLoss(loss, "loss");
  detail::throwFirstError(checkBundle(problem));
  checkKeptPoses(problem, keep);
  return Marginalization(problem, loss).keep(keep);
}

}  // namespace v1
}  // namespace gslam
