#include "bundle/general_equations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bundle/general_kernels.h"
#include "factors/bundle_terms.h"
#include "factors/loss.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr double kNoCost = std::numeric_limits<double>::quiet_NaN();

double sumOf(const std::vector<double>& terms) {
  double sum = 0;
  for (const double term : terms) sum += term;
  return sum;
}

}  // namespace

std::size_t invertPointMatrix(const Mat3d& v, Mat3d& inverse) {
  // L D L^T, with 1 / D set to 0 where a pivot is rounding; then L^-T D^-1 L^-1.
  constexpr double kRounding = 1e-14;
  double d[3], lower[3] = {0, 0, 0};  // 1 / D; L10 L20 L21
  const auto reciprocal = [](double pivot, double diagonal) {
    return pivot > kRounding * diagonal && std::isfinite(1 / pivot) ? 1 / pivot : 0.0;
  };
  d[0] = reciprocal(v(0, 0), v(0, 0));
  lower[0] = v(1, 0) * d[0];
  lower[1] = v(2, 0) * d[0];
  d[1] = reciprocal(v(1, 1) - lower[0] * v(1, 0), v(1, 1));
  const double c21 = v(2, 1) - lower[1] * v(1, 0);
  lower[2] = c21 * d[1];
  d[2] = reciprocal(v(2, 2) - lower[1] * v(2, 0) - lower[2] * c21, v(2, 2));
  const double m20 = lower[0] * lower[2] - lower[1];  // L^-1: -L10, m20, -L21
  const Mat3d back = {1, 0, 0, -lower[0], 1, 0, m20, -lower[2], 1};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = std::max(i, j); k < 3; ++k) sum += back(k, i) * d[k] * back(k, j);
      inverse(i, j) = sum;
    }
  }
  return static_cast<std::size_t>((d[0] != 0) + (d[1] != 0) + (d[2] != 0));
}

GeneralEquations::GeneralEquations(const BundleProblem& problem, const GeneralStructure& structure,
                                   const RobustLoss& loss, unsigned threads)
    : problem_(problem),
      structure_(structure),
      loss_(loss),
      parallel_{1, threads, nullptr},
      rows_(problem.right_u.empty() ? 2 : 3),
      hessian_(structure.pattern.offset.back()),
      gradient_(structure.blocks.tangentSize()),
      diagonal_(gradient_.size()),
      coupling_(structure.couplings),
      point_hessian_(structure.groups.count()),
      point_inverse_(structure.groups.count()),
      point_gradient_(structure.groups.count()),
      reduced_(hessian_.size()),
      right_(gradient_.size()),
      parts_(structure.chunks() * hessian_.size()),
      vector_parts_(structure.chunks() * gradient_.size()),
      row_parts_((structure.row_chunk.size() - 1) * gradient_.size()),
      costs_(structure.chunks()) {}

double GeneralEquations::bounded(double diagonal) {
  return std::min(std::max(diagonal, 1e-6), 1e32);
}

template <class Body>
void GeneralEquations::forEachChunk(const Body& body) const {
  parallelFor(0, structure_.chunks(), body, parallel_);
}

// Adds the parts of all chunks, in their order.
void GeneralEquations::sumParts(const std::vector<double>& parts, double* sum,
                                std::size_t size) const {
  if (size == 0) return;
  const std::size_t chunks = parts.size() / size;
  ParallelOptions parallel = parallel_;
  parallel.grain = 4096;
  parallelChunks(
      0, size,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t k = 0; k < chunks; ++k) {
          const double* const from = parts.data() + k * size;
          for (std::size_t i = first; i < last; ++i) sum[i] += from[i];
        }
      },
      parallel);
}

double GeneralEquations::linearize(const BundleValues& values) {
  forEachChunk([&](std::size_t k) {
    double* const hessian = parts_.data() + k * hessian_.size();
    double* const gradient = vector_parts_.data() + k * gradient_.size();
    std::fill_n(hessian, hessian_.size(), 0.0);
    std::fill_n(gradient, gradient_.size(), 0.0);
    costs_[k] = 0;
    for (std::size_t g = structure_.chunk[k]; g < structure_.chunk[k + 1]; ++g) {
      costs_[k] += linearizeGroup(values, g, hessian, gradient);
    }
  });
  std::fill(hessian_.begin(), hessian_.end(), 0.0);
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  sumParts(parts_, hessian_.data(), hessian_.size());
  sumParts(vector_parts_, gradient_.data(), gradient_.size());
  addPriors(values);
  const BundleBlocks& blocks = structure_.blocks;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    const std::size_t size = blocks.size(b);
    const double* const block = &hessian_[structure_.pattern.offset[structure_.pattern.first[b]]];
    for (std::size_t i = 0; i < size; ++i) {
      diagonal_[blocks.offset[b] + i] = bounded(block[i * size + i]);
    }
  }
  return sumOf(costs_) + priorCost(values);
}

double GeneralEquations::linearizeGroup(const BundleValues& values, std::size_t group,
                                        double* hessian, double* gradient) {
  const GeneralGroups& g = structure_.groups;
  const GeneralPattern& pattern = structure_.pattern;
  const bool has_point = g.point[group] != kNoBlock;
  const std::size_t entry = g.first_entry[group], entries = g.entries(group);
  if (has_point) {
    for (std::size_t e = entry; e < entry + entries; ++e) {
      std::fill_n(&coupling_[g.entry_offset[e]], 3 * structure_.blocks.size(g.entry_block[e]), 0.0);
    }
    point_hessian_[group] = Mat3d{};
    point_gradient_[group] = Vec3d{};
  }
  double cost = 0;
  ObservationTerm term;
  for (std::size_t i = g.first_observation[group]; i < g.first_observation[group + 1]; ++i) {
    if (!observationTerm(problem_, structure_.blocks, values, g.observation[i], true, term)) {
      return kNoCost;
    }
    const LossValue loss = lossAt(loss_, term.squared);
    cost += 0.5 * loss.rho;
    if (loss.first == 0) continue;
    for (std::size_t k = 0; k < term.count; ++k) {
      const ObservationTerm::Part& a = term.parts[k];
      const std::size_t slot = g.slot[4 * i + k];
      addProduct(a.rows, a.size, term.residual, 1, rows_, loss.first,
                 gradient + structure_.blocks.offset[a.block]);
      if (has_point) {
        addProduct(term.by_point.values, 3, a.rows, a.size, rows_, loss.first,
                   &coupling_[g.entry_offset[entry + slot]]);
      }
      const std::uint32_t* const pairs =
          &g.pair[g.first_pair[group] + pairRow(slot, entries)] - slot;
      for (std::size_t l = 0; l < term.count; ++l) {
        const std::size_t other = g.slot[4 * i + l];
        if (other < slot) continue;
        addProduct(a.rows, a.size, term.parts[l].rows, term.parts[l].size, rows_, loss.first,
                   hessian + pattern.offset[pairs[other]]);
      }
    }
    if (!has_point) continue;
    addProduct(term.by_point.values, 3, term.by_point.values, 3, rows_, loss.first,
               point_hessian_[group].values);
    addProduct(term.by_point.values, 3, term.residual, 1, rows_, loss.first,
               point_gradient_[group].values);
  }
  return cost;
}

void GeneralEquations::holdFarthest(const BundleValues& values) {
  if (structure_.blocks.anchor.empty()) return;
  const GeneralGroups& g = structure_.groups;
  forEachChunk([&](std::size_t k) {
    for (std::size_t group = structure_.chunk[k]; group < structure_.chunk[k + 1]; ++group) {
      const std::uint32_t point = g.point[group];
      if (point == kNoBlock) continue;
      if (!isHeldFar(structure_.blocks, values, point, point_gradient_[group][2])) continue;
      point_gradient_[group][2] = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        point_hessian_[group](i, 2) = point_hessian_[group](2, i) = 0;
      }
      for (std::size_t e = g.first_entry[group]; e < g.first_entry[group + 1]; ++e) {
        const std::size_t size = structure_.blocks.size(g.entry_block[e]);
        std::fill_n(&coupling_[g.entry_offset[e] + 2 * size], size, 0.0);
      }
    }
  });
}

double GeneralEquations::cost(const BundleValues& values) {
  const GeneralGroups& g = structure_.groups;
  forEachChunk([&](std::size_t k) {
    costs_[k] = 0;
    ObservationTerm term;
    for (std::size_t group = structure_.chunk[k]; group < structure_.chunk[k + 1]; ++group) {
      double cost = 0;
      for (std::size_t i = g.first_observation[group]; i < g.first_observation[group + 1]; ++i) {
        const bool is_seen =
            observationTerm(problem_, structure_.blocks, values, g.observation[i], false, term);
        cost += is_seen ? 0.5 * lossAt(loss_, term.squared).rho : kNoCost;
      }
      costs_[k] += cost;
    }
  });
  return sumOf(costs_) + priorCost(values);
}

std::size_t GeneralEquations::inliers(const BundleValues& values) const {
  const GeneralGroups& g = structure_.groups;
  std::size_t count = 0;
  ObservationTerm term;
  for (const std::uint32_t i : g.observation) {
    count += observationTerm(problem_, structure_.blocks, values, i, false, term) &&
                     lossAt(loss_, term.squared).first >= 0.5
                 ? 1
                 : 0;
  }
  return count;
}

double GeneralEquations::priorCost(const BundleValues& values) const {
  double cost = 0;
  forEachPrior(problem_, values, false, [&cost](const PriorTerm& term) { cost += term.cost; });
  return cost;
}

void GeneralEquations::addPriors(const BundleValues& values) {
  const BundleBlocks& blocks = structure_.blocks;
  const GeneralPattern& pattern = structure_.pattern;
  forEachPrior(problem_, values, true, [&](const PriorTerm& term) {
    const std::size_t n = term.poses.size();
    for (std::size_t a = 0; a < n; ++a) {
      const std::uint32_t row = blocks.pose[term.poses[a]];
      if (row == kNoBlock) continue;
      for (std::size_t i = 0; i < 6; ++i) {
        gradient_[blocks.offset[row] + i] += term.gradient[6 * a + i];
      }
      for (std::size_t b = 0; b < n; ++b) {
        const std::uint32_t column = blocks.pose[term.poses[b]];
        if (column == kNoBlock || column < row) continue;
        double* const to = &hessian_[pattern.offset[pattern.find(row, column)]];
        for (std::size_t i = 0; i < 36; ++i) {
          to[i] += term.hessian[(6 * a + i / 6) * 6 * n + 6 * b + i % 6];
        }
      }
    }
  });
}

void GeneralEquations::eliminate(double damping, bool only_diagonal) {
  damping_ = damping;
  forEachChunk([&](std::size_t k) {
    double* const reduced = parts_.data() + k * hessian_.size();
    double* const right = vector_parts_.data() + k * gradient_.size();
    std::fill_n(reduced, hessian_.size(), 0.0);
    std::fill_n(right, gradient_.size(), 0.0);
    eliminateChunk(k, only_diagonal, reduced, right);
  });
  reduced_ = hessian_;
  sumParts(parts_, reduced_.data(), reduced_.size());
  for (std::size_t i = 0; i < right_.size(); ++i) right_[i] = -gradient_[i];
  sumParts(vector_parts_, right_.data(), right_.size());
  const BundleBlocks& blocks = structure_.blocks;
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    const std::size_t size = blocks.size(b);
    double* const block = &reduced_[structure_.pattern.offset[structure_.pattern.first[b]]];
    for (std::size_t i = 0; i < size; ++i) {
      block[i * size + i] += damping * diagonal_[blocks.offset[b] + i];
    }
  }
}

void GeneralEquations::eliminateChunk(std::size_t chunk, bool only_diagonal, double* reduced,
                                      double* right) {
  const GeneralGroups& g = structure_.groups;
  const BundleBlocks& blocks = structure_.blocks;
  std::vector<double> scaled;
  for (std::size_t group = structure_.chunk[chunk]; group < structure_.chunk[chunk + 1]; ++group) {
    if (g.point[group] == kNoBlock) continue;
    Mat3d v = point_hessian_[group];
    for (std::size_t i = 0; i < 3; ++i) v(i, i) += damping_ * bounded(v(i, i));
    invertPointMatrix(v, point_inverse_[group]);
    const std::size_t entry = g.first_entry[group], entries = g.entries(group);
    const std::uint32_t* pair = g.pair.data() + g.first_pair[group];
    for (std::size_t a = 0; a < entries; ++a) {
      const std::uint32_t row = g.entry_block[entry + a];
      const std::size_t size = blocks.size(row);
      const double* const coupling = &coupling_[g.entry_offset[entry + a]];
      scaled.resize(3 * size);  // - V^-1 W
      multiplyPoint(point_inverse_[group], coupling, size, scaled.data());
      subtractFromRight(scaled.data(), point_gradient_[group], size, right + blocks.offset[row]);
      const std::size_t last = only_diagonal ? a + 1 : entries;
      for (std::size_t b = a; b < last; ++b) {
        const std::uint32_t column = g.entry_block[entry + b];
        addProduct(scaled.data(), size, &coupling_[g.entry_offset[entry + b]], blocks.size(column),
                   3, 1.0, reduced + structure_.pattern.offset[pair[b - a]]);
      }
      pair += entries - a;
    }
  }
}

void GeneralEquations::multiply(const double* x, double* y) {
  const GeneralGroups& g = structure_.groups;
  const BundleBlocks& blocks = structure_.blocks;
  forEachChunk([&](std::size_t k) {
    double* const sum = vector_parts_.data() + k * gradient_.size();
    std::fill_n(sum, gradient_.size(), 0.0);
    for (std::size_t group = structure_.chunk[k]; group < structure_.chunk[k + 1]; ++group) {
      if (g.point[group] == kNoBlock) continue;
      Vec3d seen{};
      for (std::size_t e = g.first_entry[group]; e < g.first_entry[group + 1]; ++e) {
        addRows(coupling(e), blocks.size(g.entry_block[e]), x + blocks.offset[g.entry_block[e]],
                seen);
      }
      seen = -(point_inverse_[group] * seen);
      for (std::size_t e = g.first_entry[group]; e < g.first_entry[group + 1]; ++e) {
        const std::size_t size = blocks.size(g.entry_block[e]);
        addProduct(coupling(e), size, seen.values, 1, 3, 1.0,
                   sum + blocks.offset[g.entry_block[e]]);
      }
    }
  });
  multiplyPattern(hessian_, x, y);
  for (std::size_t i = 0; i < gradient_.size(); ++i) y[i] += damping_ * diagonal_[i] * x[i];
  sumParts(vector_parts_, y, gradient_.size());
}

void GeneralEquations::multiplyPattern(const std::vector<double>& values, const double* x,
                                       double* y) {
  const std::vector<std::size_t>& border = structure_.row_chunk;
  const std::size_t size = gradient_.size();
  parallelFor(
      0, border.size() - 1,
      [&](std::size_t k) {
        double* const part = row_parts_.data() + k * size;
        std::fill_n(part, size, 0.0);
        addPatternProduct(structure_.blocks, structure_.pattern, values.data(), border[k],
                          border[k + 1], x, part);
      },
      parallel_);
  std::fill_n(y, size, 0.0);
  sumParts(row_parts_, y, size);
}

void GeneralEquations::substitute(const double* step, double* point_step) const {
  const GeneralGroups& g = structure_.groups;
  const BundleBlocks& blocks = structure_.blocks;
  forEachChunk([&](std::size_t k) {
    for (std::size_t group = structure_.chunk[k]; group < structure_.chunk[k + 1]; ++group) {
      if (g.point[group] == kNoBlock) continue;
      Vec3d sum = point_gradient_[group];
      for (std::size_t e = g.first_entry[group]; e < g.first_entry[group + 1]; ++e) {
        addRows(coupling(e), blocks.size(g.entry_block[e]), step + blocks.offset[g.entry_block[e]],
                sum);
      }
      const Vec3d y = -(point_inverse_[group] * sum);
      std::copy(y.values, y.values + 3, point_step + 3 * std::size_t(g.point[group]));
    }
  });
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
