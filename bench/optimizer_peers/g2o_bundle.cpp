// Bundles with g2o. 9 variables a camera: a vertex and an edge of our own, analytic derivatives; 6:
// g2o's own types.
#include <g2o/core/base_binary_edge.h>
#include <g2o/core/base_vertex.h>
#include <g2o/core/block_solver.h>
#include <g2o/solvers/cholmod/linear_solver_cholmod.h>
#include <g2o/solvers/eigen/linear_solver_eigen.h>
#include <g2o/solvers/pcg/linear_solver_pcg.h>
#include <g2o/types/sba/types_six_dof_expmap.h>

#include <array>
#include <cstddef>
#include <iosfwd>
#include <memory>
#include <vector>

#include "g2o_search.h"
#include "measure.h"

namespace {

// What a camera of BAL is: where, and f, k1, k2.
struct View {
  gslam::SE3d T_camera_world;
  std::array<double, 3> lens{};
};

// Steps: of the pose on the left, and of the lens.
class ViewVertex : public g2o::BaseVertex<9, View> {
 public:
  bool read(std::istream&) override { return false; }
  bool write(std::ostream&) const override { return false; }
  void setToOriginImpl() override { _estimate = View(); }
  void oplusImpl(const double* step) override {
    const gslam::SE3d moved =
        gslam::SE3d::exp({step[0], step[1], step[2], step[3], step[4], step[5]});
    _estimate.T_camera_world = moved * _estimate.T_camera_world;
    for (std::size_t i = 0; i < 3; ++i) _estimate.lens[i] += step[6 + i];
  }
};

class Observation : public g2o::BaseBinaryEdge<2, g2o::Vector2, g2o::VertexPointXYZ, ViewVertex> {
 public:
  bool read(std::istream&) override { return false; }
  bool write(std::ostream&) const override { return false; }

  void computeError() override {
    const View& view = vertexXn<1>()->estimate();
    const gslam::Vec3d p = inCamera();
    const double x = p[0] / p[2], y = p[1] / p[2], r2 = x * x + y * y;
    const double scale = view.lens[0] * (1 + r2 * (view.lens[1] + r2 * view.lens[2]));
    _error = g2o::Vector2(scale * x, scale * y) - _measurement;
  }

  void linearizeOplus() override {
    const View& view = vertexXn<1>()->estimate();
    const gslam::Vec3d p = inCamera();
    const double x = p[0] / p[2], y = p[1] / p[2], r2 = x * x + y * y;
    const double f = view.lens[0], k1 = view.lens[1], k2 = view.lens[2];
    const double d = 1 + r2 * (k1 + r2 * k2), slope = 2 * (k1 + 2 * k2 * r2);
    const double xx = f * (d + slope * x * x) / p[2], xy = f * slope * x * y / p[2];
    const double yy = f * (d + slope * y * y) / p[2];
    Eigen::Matrix<double, 2, 3> by_p;
    by_p << xx, xy, -(xx * x + xy * y), xy, yy, -(xy * x + yy * y);
    Eigen::Matrix3d minus_hat;
    minus_hat << 0, p[2], -p[1], -p[2], 0, p[0], p[1], -p[0], 0;
    const gslam::Mat3d rotation = view.T_camera_world.rotation().matrix();
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    _jacobianOplusXi = by_p * Eigen::Map<const RowMajor>(rotation.values);
    _jacobianOplusXj.leftCols<3>() = by_p;
    _jacobianOplusXj.middleCols<3>(3) = by_p * minus_hat;
    _jacobianOplusXj.rightCols<3>() << d * x, f * r2 * x, f * r2 * r2 * x, d * y, f * r2 * y,
        f * r2 * r2 * y;
  }

 private:
  gslam::Vec3d inCamera() const {
    const g2o::Vector3& point = vertexXn<0>()->estimate();
    return vertexXn<1>()->estimate().T_camera_world * gslam::Vec3d{point[0], point[1], point[2]};
  }
};

// How the two kinds of bundles differ.
struct FreeLenses {
  using Vertex = ViewVertex;
  using Edge = Observation;
  static constexpr int kFreedom = 9;

  static View estimate(const gslam::SE3d& T_camera_world, const Lens& lens) {
    return {T_camera_world, lens.numbers};
  }
  static void measure(Edge& edge, const gslam::Vec2d& pixel, const Lens& lens) {
    edge.setMeasurement({pixel[0] - lens.centre[0], pixel[1] - lens.centre[1]});
  }
  static void writeBack(BundleArrays& arrays, std::size_t pose, const View& view) {
    setView(arrays, pose, view.T_camera_world, view.lens);
  }
};

struct KnownLens {
  using Vertex = g2o::VertexSE3Expmap;
  using Edge = g2o::EdgeSE3ProjectXYZ;
  static constexpr int kFreedom = 6;

  static g2o::SE3Quat estimate(const gslam::SE3d& T_camera_world, const Lens&) {
    return quatOf(T_camera_world);
  }
  static void measure(Edge& edge, const gslam::Vec2d& pixel, const Lens& lens) {
    edge.setMeasurement({pixel[0], pixel[1]});
    edge.fx = edge.fy = lens.numbers[0];
    edge.cx = lens.centre[0];
    edge.cy = lens.centre[1];
  }
  static void writeBack(BundleArrays& arrays, std::size_t pose, const g2o::SE3Quat& view) {
    setView(arrays, pose, poseOf(view), {});
  }
};

template <class Kind, template <class> class Linear>
class G2oBundle {
 public:
  using Blocks = g2o::BlockSolver<g2o::BlockSolverTraits<Kind::kFreedom, 3>>;

  G2oBundle(BundleArrays& arrays, std::unique_ptr<Linear<typename Blocks::PoseMatrixType>> linear)
      : arrays_(arrays), search_(std::move(linear)) {
    for (const gslam::Camera& camera : arrays.cameras) lenses_.push_back(lensOf(camera));
    addVertices();
    addEdges();
  }

  Course solve(std::size_t iterations) {
    const Course course = search_.run(iterations);
    for (std::size_t i = 0; i < views_.size(); ++i) {
      Kind::writeBack(arrays_, i, views_[i]->estimate());
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const g2o::Vector3& point = points_[i]->estimate();
      arrays_.points[i] = {point[0], point[1], point[2]};
    }
    return course;
  }

 private:
  void addVertices() {
    for (std::size_t i = 0; i < arrays_.T_world_body.size(); ++i) {
      auto* const view = new typename Kind::Vertex;
      const Lens& lens = lenses_[hasFreeLenses(arrays_) ? i : 0];
      view->setEstimate(Kind::estimate(arrays_.T_world_body[i].inverse(), lens));
      view->setId(next_id_++);
      view->setFixed(!arrays_.pose_fixed.empty() && arrays_.pose_fixed[i] != 0);
      search_.graph.addVertex(view);
      views_.push_back(view);
    }
    for (const gslam::Vec3d& place : arrays_.points) {
      auto* const point = new g2o::VertexPointXYZ;
      point->setEstimate({place[0], place[1], place[2]});
      point->setId(next_id_++);
      point->setMarginalized(true);
      search_.graph.addVertex(point);
      points_.push_back(point);
    }
  }

  void addEdges() {
    for (std::size_t i = 0; i < arrays_.pixels.size(); ++i) {
      auto* const edge = new typename Kind::Edge;
      edge->setVertex(0, points_[arrays_.observation_point[i]]);
      edge->setVertex(1, views_[arrays_.observation_pose[i]]);
      edge->setInformation(g2o::Matrix2::Identity());
      Kind::measure(*edge, arrays_.pixels[i], lenses_[arrays_.observation_camera[i]]);
      search_.graph.addEdge(edge);
    }
  }

  BundleArrays& arrays_;
  G2oSearch<Blocks, Linear> search_;
  std::vector<Lens> lenses_;
  int next_id_ = 0;
  std::vector<typename Kind::Vertex*> views_;
  std::vector<g2o::VertexPointXYZ*> points_;
};

// The order of elimination is found by blocks, where factors are sparse.
template <class Matrix>
void orderByBlocks(g2o::LinearSolverCCS<Matrix>& linear) {
  linear.setBlockOrdering(true);
}
template <class Matrix>
void orderByBlocks(g2o::LinearSolver<Matrix>&) {}

template <class Kind, template <class> class Linear>
Course solveAs(BundleArrays& arrays, std::size_t iterations) {
  using Bundle = G2oBundle<Kind, Linear>;
  auto linear = std::make_unique<Linear<typename Bundle::Blocks::PoseMatrixType>>();
  orderByBlocks(*linear);
  return Bundle(arrays, std::move(linear)).solve(iterations);
}

template <template <class> class Linear>
Course solveBundle(BundleArrays& arrays, std::size_t iterations) {
  return hasFreeLenses(arrays) ? solveAs<FreeLenses, Linear>(arrays, iterations)
                               : solveAs<KnownLens, Linear>(arrays, iterations);
}

const bool kRows[] = {addBundleRows("g2o", solveBundle<g2o::LinearSolverCholmod>),
                      addBundleRows("g2o_eigen", solveBundle<g2o::LinearSolverEigen>),
                      addBundleRows("g2o_pcg", solveBundle<g2o::LinearSolverPCG>)};

}  // namespace
