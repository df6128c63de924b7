#include "evo_matrices.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>
#include <string>

namespace gslam {
inline namespace v1 {
namespace evaluation {

EvoMatrices::EvoMatrices(const PosePairs& pairs, const std::vector<KittiMatrix>& reference,
                         const std::vector<KittiMatrix>& estimate, AlignmentMethod method,
                         const SIM3d& S_world_map) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    reference_.push_back(poseOf(reference.at(pairs.reference_places[i])));
    estimate_.push_back(poseOf(estimate.at(pairs.estimate_places[i])));
  }
  Pose alignment = {S_world_map.rotation().matrix(), S_world_map.translation()};
  if (method == AlignmentMethod::origin) alignment = reference_[0] * estimate_[0].inverse();
  for (Pose& pose : estimate_) {
    pose.t *= S_world_map.scale();
    pose = alignment * pose;
  }
}

EvoMatrices::Pose EvoMatrices::poseOf(const KittiMatrix& matrix) {
  return {matrix.block<3, 3>(0, 0), matrix.col(3)};
}

// The full error has |R - I|^2 beside the square of the translation.
void EvoMatrices::use(double translation, std::size_t i, PoseErrors& errors) {
  const double turn = std::sin(0.5 * errors.rotation[i]);
  errors.translation[i] = translation;
  errors.full[i] = std::sqrt(translation * translation + 8 * turn * turn);
}

void EvoMatrices::useInAbsolute(PoseErrors& errors) const {
  for (std::size_t i = 0; i < reference_.size(); ++i) {
    use((reference_[i].t - estimate_[i].t).norm(), i, errors);
  }
}

void EvoMatrices::useInRelative(const std::vector<PairRange>& ranges, PoseErrors& errors) const {
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const PairRange& range = ranges[i];
    const Pose truth = reference_[range.first].inverse() * reference_[range.last];
    const Pose found = estimate_[range.first].inverse() * estimate_[range.last];
    use((truth.inverse() * found).t.norm(), i, errors);
  }
}

}  // namespace evaluation

std::vector<KittiMatrix> readKittiMatrices(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw FileError(path, "cannot be opened", errno);
  std::vector<KittiMatrix> matrices;
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line.resize(std::min(line.size(), line.find('#')));
    for (char& c : line) c = c == ',' ? ' ' : c;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::istringstream numbers(line);
    numbers.imbue(std::locale::classic());
    KittiMatrix matrix;
    for (double& value : matrix.values) numbers >> value;
    if (!numbers || !(numbers >> std::ws).eof()) {
      throw ParseError(path, number, 0, "expected the 12 numbers of a matrix");
    }
    matrices.push_back(matrix);
  }
  return matrices;
}

}  // namespace v1
}  // namespace gslam
