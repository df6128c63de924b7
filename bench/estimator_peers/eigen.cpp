// Eigen's umeyama().
#include <Eigen/Geometry>

#include "eigen_input.h"
#include "measure.h"

namespace {

struct Umeyama {
  struct Input {
    Eigen::Matrix3d first, second;  // a point a column
  };
  using Output = Eigen::Matrix4d;
  static Input prepare(const Instance& instance) {
    Input in;
    for (int i = 0; i < 3; ++i) {
      in.first.col(i) = toEigen(instance.first[static_cast<std::size_t>(i)]);
      in.second.col(i) = toEigen(instance.second[static_cast<std::size_t>(i)]);
    }
    return in;
  }
  static void solve(const Input& in, Output& out) { out = Eigen::umeyama(in.first, in.second); }
  static Models models(const Output& out) {
    const double scale = out.block<3, 1>(0, 0).norm();
    Numbers numbers = numbersOfRows(out.block<3, 3>(0, 0) / scale);
    for (int i = 0; i < 3; ++i) numbers.push_back(out(i, 3));
    numbers.push_back(scale);
    return {numbers};
  }
};
const bool kSimilarity =
    addSolver<Umeyama>("similarity_3", "eigen", similarityInstances, poseDistance);

}  // namespace
