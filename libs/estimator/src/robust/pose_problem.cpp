#include "robust/pose_problem.h"

#include <gslam/estimator/solvers/gp3p.h>
#include <gslam/estimator/solvers/p3p.h>
#include <gslam/geometry/detail/symmetric_eigen.h>
#include <gslam/geometry/nearest_rotation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "robust/examination.h"
#include "robust/random_bits.h"
#include "robust/refiner.h"
#include "robust/support.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLargestDistanceSigma = 0.3;  // of that of the points, see kLargestRotationSigma
// Squares of how far points may be from a line, or a place, as parts of their extent: rounding.
constexpr double kOnLine = 1e-14;
constexpr double kFlat = 0.05;          // the same of a plane, whose second pose is to be tried
constexpr double kSameRotation = 0.02;  // radians

SE3d poseOf(const ModelNumbers& m) {
  return SE3d(SO3d::fromQuaternion(m[0], m[1], m[2], m[3]), {m[4], m[5], m[6]});
}

ModelNumbers modelOf(const SE3d& pose) {
  ModelNumbers model{};
  std::copy(pose.data(), pose.data() + 7, model.begin());
  return model;
}

// R and t in three rows.
void matrixOf(const ModelNumbers& model, double* matrix) {
  const Mat<double, 3, 4> m = poseOf(model).matrix3x4();
  std::copy(m.values, m.values + 12, matrix);
}

std::size_t take(const SE3d* poses, std::size_t count, ModelNumbers* models) {
  for (std::size_t k = 0; k < count; ++k) models[k] = modelOf(poses[k]);
  return count;
}

// Of the square distances from their mean, from the largest axis to the smallest.
SymmetricEigen<double, 3> axesOf(const std::vector<Vec3d>& points,
                                 const std::vector<std::uint32_t>& indices) {
  Vec3d mean{};
  for (const std::uint32_t i : indices) mean += points[i];
  mean /= static_cast<double>(std::max<std::size_t>(indices.size(), 1));
  Mat3d sum{};
  for (const std::uint32_t i : indices) sum += outer(points[i] - mean, points[i] - mean);
  return SymmetricEigen<double, 3>(sum);
}

}  // namespace

PoseProblem::PoseProblem(std::vector<PoseObservation> observations, Span<const Vec3d> points,
                         std::vector<PoseCamera> cameras, const RandomOrder& order)
    : observations_(std::move(observations)), cameras_(std::move(cameras)) {
  for (const Vec3d& p : points) centre_ += p / static_cast<double>(points.size());
  points_.reserve(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    points_.push_back(points[order[i]] - centre_);
    // In place, as a copy would be large: what stood at `from` has moved where it was swapped to.
    std::size_t from = order[i];
    while (from < i) from = order[from];
    std::swap(observations_[i], observations_[from]);
  }
  for (const PoseCamera& camera : cameras_) {
    const bool is_round = camera.camera->modelName() == "equirectangular";
    periods_.push_back(is_round ? static_cast<double>(camera.camera->width()) : 0);
  }
  is_central_ = true;
  for (const PoseObservation& o : observations_) {
    is_central_ = is_central_ && o.origin == observations_[0].origin;
  }
  is_plane_ = cameras_.size() == 1 && cameras_[0].camera->modelName() == "pinhole" && is_central_ &&
              cameras_[0].T_rig_camera.isApprox(SE3d(), 0);
  if (is_plane_) {
    setUpPlane();
  } else {
    setUpFrames();
  }
  for (std::size_t k = 0; k < (is_plane_ ? kPlaneColumns : kFrameColumns); ++k) {
    column_starts_.push_back(columns_.data() + k * points_.size());
  }
  setUpChance();
}

void PoseProblem::setUpPlane() {
  const std::vector<double> parameters = cameras_[0].camera->parameters();
  length_ = (std::abs(parameters[0]) + std::abs(parameters[1])) / 2;
  focal_[0] = parameters[0] / length_;
  focal_[1] = parameters[1] / length_;
  columns_.resize(kPlaneColumns * points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    PoseObservation& o = observations_[i];
    const double u = o.pixel[0] - parameters[2], v = o.pixel[1] - parameters[3];
    // Of the plane z = 1, so that refinement minimises what the mask is made from.
    o.bearing = {0, 0, 1};
    o.frame = {{parameters[0], 0, -u, 0, parameters[1], -v}};
    for (std::size_t k = 0; k < 3; ++k) {
      columns_[k * points_.size() + i] = static_cast<float>(points_[i][k]);
    }
    columns_[3 * points_.size() + i] = static_cast<float>(u / length_);
    columns_[4 * points_.size() + i] = static_cast<float>(v / length_);
  }
}

void PoseProblem::setUpFrames() {
  columns_.resize(kFrameColumns * points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const PoseObservation& o = observations_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      columns_[k * points_.size() + i] = static_cast<float>(points_[i][k]);
      columns_[(3 + k) * points_.size() + i] = static_cast<float>(o.frame(0, k));
      columns_[(6 + k) * points_.size() + i] = static_cast<float>(o.frame(1, k));
      columns_[(9 + k) * points_.size() + i] = static_cast<float>(o.bearing[k]);
      columns_[(12 + k) * points_.size() + i] = static_cast<float>(o.origin[k]);
    }
  }
}

// A disc as large as the threshold as a part of what was observed.
void PoseProblem::setUpChance() {
  if (cameras_.empty()) {
    const Cone cone(points_.size(), [&](std::size_t i) { return observations_[i].bearing; });
    chance_per_square_ = kPi / cone.solid_angle;
    return;
  }
  std::vector<Box> boxes(cameras_.size());
  std::vector<std::size_t> counts(cameras_.size());
  for (const PoseObservation& o : observations_) {
    boxes[o.camera].add(o.pixel[0], o.pixel[1]);
    ++counts[o.camera];
  }
  // A camera with a few pixels says little of its image: together they count.
  double area = 0, weight = 0;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    if (counts[c] == 0) continue;
    const double image = static_cast<double>(cameras_[c].camera->width()) *
                         static_cast<double>(cameras_[c].camera->height());
    const double box = counts[c] < 10 ? image : boxes[c].area();
    area += static_cast<double>(counts[c]) * box;
    weight += static_cast<double>(counts[c]);
  }
  chance_per_square_ = kPi * weight / area;
}

double PoseProblem::chance(double threshold) const {
  const double chance = chance_per_square_ * threshold * threshold;
  return chance < 1 ? chance : 1;  // NaN, too
}

std::size_t PoseProblem::solve(const std::uint32_t* sample, ModelNumbers* models) const {
  const Vec3d& origin = observations_[sample[0]].origin;
  if (is_central_ ||
      (observations_[sample[1]].origin == origin && observations_[sample[2]].origin == origin)) {
    return solveCentral(sample, models);
  }
  return solveRig(sample, models);
}

std::size_t PoseProblem::solveCentral(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec3d bearings[3], points[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const PoseObservation& o = observations_[sample[k]];
    if (is_plane_) {
      const Vec3d ray = {-o.frame(0, 2) / o.frame(0, 0), -o.frame(1, 2) / o.frame(1, 1), 1};
      bearings[k] = ray / std::sqrt(ray.squaredNorm());
    } else {
      bearings[k] = o.bearing;
    }
    points[k] = points_[sample[k]];
  }
  std::array<SE3d, 4> poses;
  const std::size_t count =
      p3p(Span<const Vec3d>(bearings, 3), Span<const Vec3d>(points, 3), poses);
  const Vec3d& origin = observations_[sample[0]].origin;
  for (SE3d& pose : poses) pose.setTranslation(pose.translation() + origin);
  return take(poses.data(), count, models);
}

std::size_t PoseProblem::solveRig(const std::uint32_t* sample, ModelNumbers* models) const {
  Vec3d origins[3], bearings[3], points[3];
  for (std::size_t k = 0; k < 3; ++k) {
    origins[k] = observations_[sample[k]].origin;
    bearings[k] = observations_[sample[k]].bearing;
    points[k] = points_[sample[k]];
  }
  std::array<SE3d, 8> poses;
  const std::size_t count = gp3p(Span<const Vec3d>(origins, 3), Span<const Vec3d>(bearings, 3),
                                 Span<const Vec3d>(points, 3), poses);
  return take(poses.data(), count, models);
}

void PoseProblem::squaredResiduals(const ModelNumbers& model, std::size_t first, std::size_t count,
                                   float* squared) const {
  double matrix[12];
  matrixOf(model, matrix);
  float numbers[12];
  for (std::size_t k = 0; k < 12; ++k) {
    const double scale = k < 8 ? focal_[k / 4] : 1;
    numbers[k] = static_cast<float>(is_plane_ ? scale * matrix[k] : matrix[k]);
  }
  const SquaredFunction function = is_plane_ ? reprojectPlaneFunction() : reprojectFramesFunction();
  function(numbers, static_cast<float>(length_ * length_), column_starts_.data(), first, count,
           squared);
}

double PoseProblem::exactSquared(const SE3d& T_rig_world, std::size_t i, std::size_t j) const {
  const PoseObservation& o = observations_[j];
  const Vec3d in_rig = T_rig_world * points_[i];
  if (cameras_.empty()) {
    const Vec3d ray = in_rig - o.origin;
    const double angle = std::atan2(o.bearing.cross(ray).norm(), o.bearing.dot(ray));
    return angle * angle;
  }
  const PoseCamera& camera = cameras_[o.camera];
  Vec2d pixel;
  if (!camera.camera->project(camera.T_camera_rig * in_rig, pixel)) {
    return std::numeric_limits<double>::infinity();
  }
  Vec2d error = pixel - o.pixel;
  const double period = periods_[o.camera];
  if (period > 0) error[0] = std::remainder(error[0], period);
  return error.squaredNorm();
}

void PoseProblem::exactSquaredResiduals(const ModelNumbers& model, double* squared) const {
  const SE3d pose = poseOf(model);
  for (std::size_t i = 0; i < size(); ++i) squared[i] = exactSquared(pose, i);
}

void PoseProblem::squaredResidualsOfPairs(const ModelNumbers& model, std::size_t shift,
                                          std::size_t count, double* squared) const {
  const SE3d pose = poseOf(model);
  for (std::size_t i = 0; i < count; ++i) squared[i] = exactSquared(pose, i, (i + shift) % size());
}

// Points as large as they look from where the model has the camera.
std::size_t PoseProblem::placeOf(const ModelNumbers& model, std::size_t i, double* place) const {
  const PoseObservation& o = observations_[i];
  const double distance = (poseOf(model) * points_[i] - o.origin).norm();
  const double unit = cameras_.empty() ? 1 : o.frame.row(0).norm();
  const Vec3d seen =
      cameras_.empty() ? o.bearing : Vec3d{o.pixel[0], o.pixel[1], 1e12 * double(o.camera)};
  const Vec3d point = points_[i] * (distance > 0 ? unit / distance : unit);
  std::copy(seen.values, seen.values + 3, place);
  std::copy(point.values, point.values + 3, place + 3);
  return 6;
}

void PoseProblem::accumulate(const ModelNumbers& model, const double* weights, std::size_t count,
                             NormalEquations& sums) const {
  double matrix[12];
  matrixOf(model, matrix);
  PoseSums all;
  PoseBlock block;
  const ReprojectBlockFunction add = reprojectBlockFunction();
  std::size_t filled = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(weights[i] > 0)) continue;
    const PoseObservation& o = observations_[i];
    for (std::size_t k = 0; k < 3; ++k) {
      block.columns[k][filled] = points_[i][k];
      block.columns[3 + k][filled] = o.frame(0, k);
      block.columns[6 + k][filled] = o.frame(1, k);
      block.columns[9 + k][filled] = o.bearing[k];
      block.columns[12 + k][filled] = o.origin[k];
    }
    block.weights[filled] = weights[i];
    if (++filled < kBlock) continue;
    add(matrix, block, all);
    filled = 0;
  }
  if (filled > 0) {
    for (std::size_t j = filled; j < kBlock; ++j) {
      for (auto& column : block.columns) column[j] = column[0];
      block.weights[j] = 0;
    }
    add(matrix, block, all);
  }
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = r; c < 6; ++c) sums.hessian[r * kMaxDof + c] += all.hessian[r * 6 + c];
    sums.gradient[r] += all.gradient[r];
  }
  sums.cost += all.cost;
}

ModelNumbers PoseProblem::retract(const ModelNumbers& model, const double* delta) const {
  SE3d::Tangent tangent;
  for (std::size_t k = 0; k < 6; ++k) {
    tangent[k] = -delta[k];
    if (!(std::abs(delta[k]) < 1e12) || (k >= 3 && !(std::abs(delta[k]) < 1e3))) return model;
  }
  return modelOf((SE3d::exp(tangent) * poseOf(model)).normalized());
}

SE3d PoseProblem::worldPoseOf(const ModelNumbers& model) const {
  const SE3d inverse = poseOf(model).inverse();
  return SE3d(inverse.rotation(), inverse.translation() + centre_);
}

Degeneracy PoseProblem::degeneracyOfAllPoints() const {
  std::vector<std::uint32_t> all(size());
  for (std::size_t i = 0; i < size(); ++i) all[i] = static_cast<std::uint32_t>(i);
  const Vec3d spread = axesOf(points_, all).values / static_cast<double>(size());
  const double rounding = 1e-28 * centre_.squaredNorm();
  if (!(spread[0] > rounding)) return Degeneracy::Coincident;
  return spread[1] > kOnLine * spread[0] + rounding ? Degeneracy::None : Degeneracy::Collinear;
}

// Points that are seen on the line of two of them within the threshold, from whichever side, leave
// the turn about that line open. Others must be more than chance.
void PoseProblem::examineLine(const ModelNumbers& model, const std::vector<std::uint32_t>& inliers,
                              double threshold, Examination& result) const {
  const SE3d pose = poseOf(model);
  const auto count = static_cast<std::uint32_t>(inliers.size());
  // How far from its place a point may be without leaving the threshold.
  std::vector<double> reach(size());
  for (std::size_t i = 0; i < size(); ++i) {
    const PoseObservation& o = observations_[i];
    const double depth = std::abs(o.bearing.dot(pose * points_[i] - o.origin));
    const double per_metre =
        std::max(o.frame.row(0).squaredNorm(), o.frame.row(1).squaredNorm()) / (depth * depth);
    reach[i] = threshold * threshold / per_metre;
  }
  RandomBits bits(count, 0x6c696e65);
  std::size_t most = 0, most_of_all = 0;
  for (int round = 0; round < 20; ++round) {
    const Vec3d& a = points_[inliers[bits.below(count)]];
    const Vec3d line = points_[inliers[bits.below(count)]] - a;
    const double square = line.squaredNorm();
    const auto isOnLine = [&](std::size_t i) {
      const Vec3d d = points_[i] - a;
      const double along = square > 0 ? d.dot(line) / square : 0;
      return (d - along * line).squaredNorm() <= reach[i];
    };
    const auto on_line =
        static_cast<std::size_t>(std::count_if(inliers.begin(), inliers.end(), isOnLine));
    if (on_line <= most) continue;
    most = on_line;
    most_of_all = 0;
    for (std::size_t i = 0; i < size(); ++i) most_of_all += isOnLine(i);
  }
  const std::size_t rest = size() - most_of_all, off_line = inliers.size() - most;
  if (isBeyondChance(rest, off_line, 1, chance(threshold))) return;
  result.is_determined = false;
  result.degeneracy = Degeneracy::Collinear;
  result.reason = "the inliers' points lie on one line, about which the camera may be anywhere";
}

// Seen from far away a plane looks the same when what is in front of its middle goes behind it: the
// pose with the depths mirrored, which a turn gives, too (Schweighofer, Pinz, "Robust pose
// estimation from a planar target", PAMI 28(12), 2006).
void PoseProblem::examinePlane(const ModelNumbers& model, const std::vector<std::uint32_t>& inliers,
                               double threshold, Examination& result) const {
  if (!is_central_ || inliers.size() < 4) return;
  const SE3d pose = poseOf(model);
  std::vector<Vec3d> seen(size());
  Vec3d middle{};
  for (const std::uint32_t i : inliers) {
    seen[i] = pose * points_[i] - observations_[i].origin;
    middle += seen[i] / static_cast<double>(inliers.size());
  }
  const SymmetricEigen<double, 3> axes = axesOf(seen, inliers);
  if (axes.values[2] > kFlat * axes.values[1] || !(middle.squaredNorm() > 0)) return;
  const Vec3d normal = axes.vectors.col(2), sight = middle / middle.norm();
  const Mat3d turn = (Mat3d::identity() - outer(sight, sight) * 2) *
                     (Mat3d::identity() - outer(normal, normal) * 2);
  const Vec3d centre = middle + observations_[inliers[0]].origin;
  const Vec<double, 4> q = quaternionOfMatrix(turn);
  const SE3d mirror(SO3d::fromQuaternion(q[0], q[1], q[2], q[3]), centre - turn * centre);
  Refiner refiner(*this, false);
  const ModelNumbers other = refiner.converge(modelOf((mirror * pose).normalized()), threshold);
  if ((poseOf(other).rotation().inverse() * pose.rotation()).angle() < kSameRotation) return;
  const double cost = truncatedCost(*this, model, threshold);
  const double other_cost = truncatedCost(*this, other, threshold);
  std::vector<double> squared(size());
  exactSquaredResiduals(other_cost < cost ? other : model, squared.data());
  double sum = 0, count = 0;
  for (const double s : squared) {
    if (s <= threshold * threshold) sum += s, ++count;
  }
  const double variance = std::max(sum / std::max(2 * count, 1.0), 1e-6 * threshold * threshold);
  if (other_cost < cost) result.has_replacement = true, result.replacement = other;
  if (std::abs(other_cost - cost) > kAsGood * variance) return;
  result.has_alternative = true;
  result.alternative = other_cost < cost ? model : other;
  result.degeneracy = Degeneracy::Planar;
  result.reason =
      "the inliers' points lie on one plane, which two poses explain equally well: the second one "
      "is the alternative";
}

Examination PoseProblem::examine(const ModelNumbers& model, const std::uint8_t* inliers,
                                 double threshold) const {
  Examination result;
  std::vector<std::uint32_t> indices;
  std::vector<double> weights(inliers, inliers + size());
  const SE3d pose = poseOf(model);
  double distance = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (inliers[i] == 0) continue;
    indices.push_back(static_cast<std::uint32_t>(i));
    distance += (pose * points_[i] - observations_[i].origin).norm();
  }
  distance /= static_cast<double>(std::max<std::size_t>(indices.size(), 1));
  if (indices.size() >= 2) examineLine(model, indices, threshold, result);
  if (!result.is_determined) return result;
  examinePlane(model, indices, threshold, result);
  const ModelNumbers& better = result.has_replacement ? result.replacement : model;
  std::array<double, kMaxDof * kMaxDof> covariance{};
  const double largest = kLargestDistanceSigma * distance;
  if (!covarianceOf(*this, weights, better, covariance) ||
      largestVariance(covariance, 0, 3) > largest * largest ||
      largestVariance(covariance, 3, 3) > kLargestRotationSigma * kLargestRotationSigma) {
    result.is_determined = false;
    result.reason = "the inliers hardly determine the pose";
  }
  return result;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam
