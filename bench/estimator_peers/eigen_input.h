// Instances and scenes as libraries want them that are written with Eigen.
#ifndef GSLAM_BENCH_ESTIMATOR_PEERS_EIGEN_INPUT_H
#define GSLAM_BENCH_ESTIMATOR_PEERS_EIGEN_INPUT_H

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "instances.h"
#include "measure.h"

using Matrices = std::vector<Eigen::Matrix3d>;

inline Eigen::Vector3d toEigen(const gslam::Vec3d& v) {
  return {v[0], v[1], v[2]};
}
inline Eigen::Vector2d toEigen(const gslam::Vec2d& v) {
  return {v[0], v[1]};
}

inline Eigen::Matrix3d toEigen(const gslam::Mat3d& m) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(m.values);
}

template <class Vector>
auto allToEigen(const std::vector<Vector>& vectors) {
  std::vector<decltype(toEigen(Vector()))> result;
  for (const Vector& v : vectors) result.push_back(toEigen(v));
  return result;
}

template <class Derived>
Numbers numbersOfRows(const Eigen::MatrixBase<Derived>& m) {
  Numbers numbers;
  for (Eigen::Index r = 0; r < m.rows(); ++r) {
    for (Eigen::Index c = 0; c < m.cols(); ++c) numbers.push_back(m(r, c));
  }
  return numbers;
}

/// Of a 3 x 4 matrix [R t].
template <class Derived>
Numbers numbersOfPose(const Eigen::MatrixBase<Derived>& m) {
  Numbers numbers = numbersOfRows(m.template leftCols<3>());
  for (Eigen::Index r = 0; r < 3; ++r) numbers.push_back(m(r, 3));
  return numbers;
}

template <class List>
Models modelsOfRows(const List& matrices) {
  Models models;
  for (const auto& matrix : matrices) models.push_back(numbersOfRows(matrix));
  return models;
}

struct EigenInput {
  std::vector<Eigen::Vector3d> first, second, points, origins;
  Eigen::Matrix3d rotation;

  explicit EigenInput(const Instance& instance)
      : first(allToEigen(instance.first)),
        second(allToEigen(instance.second)),
        points(allToEigen(instance.points)),
        origins(allToEigen(instance.origins)),
        rotation(toEigen(instance.pose.rotation().matrix())) {}
};

#endif  // GSLAM_BENCH_ESTIMATOR_PEERS_EIGEN_INPUT_H
