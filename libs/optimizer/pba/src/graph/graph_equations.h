#ifndef GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_EQUATIONS_H
#define GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_EQUATIONS_H

#include <gslam/base/parallel.h>
#include <gslam/optimizer/pose_graph_problem.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "factors/loss.h"
#include "factors/pose_edge.h"
#include "graph/chordal_curvature.h"
#include "graph/graph_layout.h"

// Cost, gradient and normal equations of a pose graph. Threads share edges, and then blocks, in
// chunks that do not depend on their number.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

template <class Group>
class GraphEquations {
 public:
  static constexpr std::size_t n = Group::kFreedom;
  using Block = typename Group::Jacobian;
  using Tangent = typename Group::Tangent;

  GraphEquations(const PoseGraphProblem<Group>& problem, const GraphLayout& layout,
                 const OptimizerOptions& options)
      : problem_(problem), layout_(layout), loss_(options.loss) {
    parallel_.grain = 64;
    parallel_.threads = options.threads;
    weights_.resize(layout.terms.size());
    const Block one = Block::identity();
    parallelFor(
        0, weights_.size(),
        [&](std::size_t i) {
          weights_[i] = edgeWeight<Group>(problem_.residual, information(i, one));
        },
        parallel_);
    blocks_.resize(layout.terms.size());
    diagonal.resize(layout.pose.size());
    gradient.resize(layout.pose.size());
    beside.resize(layout.pairs.size());
    if (problem.residual != PoseGraphResidual::Chordal) return;
    curvatures_.resize(layout.terms.size());
    curvature.resize(layout.pose.size());
  }

  std::vector<Block> diagonal;    // of each variable
  std::vector<Block> beside;      // of each pair
  std::vector<Tangent> gradient;  // of each variable
  // What the diagonal lacks to that of the second derivatives; empty where nobody knows.
  std::vector<Block> curvature;

  double cost(const std::vector<Group>& poses) const {
    return sumOverTerms([&](std::size_t i) {
      EdgeValue<Group> value{};
      evaluate(i, poses, false, value);
      return lossOf(i, squaredNorm(value)).rho;
    });
  }

  // Fills what is public. The cost.
  double linearize(const std::vector<Group>& poses) {
    const double result = sumOverTerms([&](std::size_t i) { return linearizeTerm(i, poses); });
    parallelFor(
        0, diagonal.size(), [&](std::size_t v) { sumVariable(v); }, parallel_);
    parallelFor(
        0, beside.size(), [&](std::size_t p) { sumPair(p); }, parallel_);
    return result;
  }

  // Edges whose weight is at least a half.
  std::size_t inliers(const std::vector<Group>& poses) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < problem_.from.size(); ++i) {
      EdgeValue<Group> value{};
      evaluate(i, poses, false, value);
      if (lossOf(i, squaredNorm(value)).first >= 0.5) ++count;
    }
    return count;
  }

  static std::size_t rows(PoseGraphResidual kind) {
    constexpr std::size_t d = Group::Point::size();
    return kind == PoseGraphResidual::Chordal ? d * d + d : n;
  }

 private:
  struct TermBlocks {
    Block from, to, beside;  // beside: rows of the pair's first variable, columns of its second
    Tangent gradient_from, gradient_to;
  };
  struct TermCurvature {
    Block from, to;
  };

  const Block& information(std::size_t i, const Block& one) const {
    const std::size_t edges = problem_.from.size();
    if (i >= edges) return problem_.prior_information[i - edges];
    return problem_.information.empty() ? one : problem_.information[i];
  }

  template <class Term>
  double sumOverTerms(const Term& term) const {
    return 0.5 * parallelReduce(
                     std::size_t(0), layout_.terms.size(), 0.0,
                     [&](std::size_t first, std::size_t last) {
                       double sum = 0;
                       for (std::size_t i = first; i < last; ++i) sum += term(i);
                       return sum;
                     },
                     [](double a, double b) { return a + b; }, parallel_);
  }

  // The ends of a term, one after the other.
  template <class Use>
  void useTerm(std::size_t i, const std::vector<Group>& poses, const Use& use) const {
    const std::size_t edges = problem_.from.size();
    if (i < edges) {
      use(poses[problem_.from[i]], poses[problem_.to[i]], problem_.T_from_to[i]);
    } else {
      use(Group(), poses[problem_.prior_pose[i - edges]], problem_.prior_T_world_body[i - edges]);
    }
  }

  void evaluate(std::size_t i, const std::vector<Group>& poses, bool with_jacobians,
                EdgeValue<Group>& value) const {
    useTerm(i, poses, [&](const Group& from, const Group& to, const Group& measured) {
      edgeValue(problem_.residual, from, to, measured, weights_[i], with_jacobians, value);
    });
  }

  static double squaredNorm(const EdgeValue<Group>& value) {
    double s = 0;
    for (std::size_t r = 0; r < value.rows; ++r) s += value.residual[r] * value.residual[r];
    return s;
  }

  LossValue lossOf(std::size_t i, double s) const {
    const bool is_edge = i < problem_.from.size();
    const bool is_robust = is_edge && (problem_.is_robust.empty() || problem_.is_robust[i] != 0);
    return is_robust ? lossAt(loss_, s) : LossValue{s, 1, 0};
  }

  // a^T b, times a weight, of two matrices with n columns.
  static void multiply(std::size_t rows, const double* a, const double* b, double weight,
                       double* result) {
    double sums[n * n] = {};
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) sums[i * n + j] += a[r * n + i] * b[r * n + j];
      }
    }
    for (std::size_t i = 0; i < n * n; ++i) result[i] = weight * sums[i];
  }

  static void multiplyResidual(const EdgeValue<Group>& value, const double* a, double weight,
                               Tangent& result) {
    result = Tangent{};
    for (std::size_t r = 0; r < value.rows; ++r) {
      for (std::size_t i = 0; i < n; ++i) result[i] += a[r * n + i] * value.residual[r];
    }
    result *= weight;
  }

  double linearizeTerm(std::size_t i, const std::vector<Group>& poses) {
    EdgeValue<Group> value{};
    evaluate(i, poses, true, value);
    const LossValue loss = lossOf(i, squaredNorm(value));
    const GraphTerm& term = layout_.terms[i];
    TermBlocks& blocks = blocks_[i];
    const double w = loss.first;
    if (term.from != kNoBlock) {
      multiply(value.rows, value.by_from, value.by_from, w, blocks.from.values);
      multiplyResidual(value, value.by_from, w, blocks.gradient_from);
    }
    if (term.to != kNoBlock) {
      multiply(value.rows, value.by_to, value.by_to, w, blocks.to.values);
      multiplyResidual(value, value.by_to, w, blocks.gradient_to);
    }
    if (term.from != kNoBlock && term.to != kNoBlock) {
      const bool is_to_first = term.from < term.to;
      multiply(value.rows, is_to_first ? value.by_to : value.by_from,
               is_to_first ? value.by_from : value.by_to, w, blocks.beside.values);
    }
    if (!curvatures_.empty()) {
      TermCurvature& bent = curvatures_[i];
      useTerm(i, poses, [&](const Group& from, const Group& to, const Group& measured) {
        chordalCurvature(from, to, measured, weights_[i], bent.from, bent.to);
      });
      bent.from *= w;
      bent.to *= w;
    }
    return loss.rho;
  }

  void sumVariable(std::size_t v) {
    Block sum{};
    Tangent gradient_sum{};
    const TermLists& lists = layout_.variable_terms;
    for (std::size_t k = lists.begin[v]; k < lists.begin[v + 1]; ++k) {
      const TermBlocks& blocks = blocks_[lists.term[k] / 2];
      const bool is_to = lists.term[k] % 2 != 0;
      sum += is_to ? blocks.to : blocks.from;
      gradient_sum += is_to ? blocks.gradient_to : blocks.gradient_from;
    }
    diagonal[v] = sum;
    gradient[v] = gradient_sum;
    if (curvatures_.empty()) return;
    curvature[v] = Block{};
    for (std::size_t k = lists.begin[v]; k < lists.begin[v + 1]; ++k) {
      const TermCurvature& bent = curvatures_[lists.term[k] / 2];
      curvature[v] += lists.term[k] % 2 != 0 ? bent.to : bent.from;
    }
  }

  void sumPair(std::size_t p) {
    const TermLists& lists = layout_.pair_terms;
    Block sum{};
    for (std::size_t k = lists.begin[p]; k < lists.begin[p + 1]; ++k) {
      sum += blocks_[lists.term[k] / 2].beside;
    }
    beside[p] = sum;
  }

  const PoseGraphProblem<Group>& problem_;
  const GraphLayout& layout_;
  RobustLoss loss_;
  ParallelOptions parallel_;
  std::vector<EdgeWeight<Group>> weights_;  // of each term
  std::vector<TermBlocks> blocks_;          // of each term
  std::vector<TermCurvature> curvatures_;   // of each term, or empty
};

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_GRAPH_GRAPH_EQUATIONS_H
