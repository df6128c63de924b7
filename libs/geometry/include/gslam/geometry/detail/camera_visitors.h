// What a Camera asks of the model it holds.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_VISITORS_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_VISITORS_H

#include <gslam/base/span.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/vec.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

struct ListParameters {
  using Result = std::vector<double>;
  template <class Model>
  Result operator()(const Model& model) const {
    const typename Model::Parameters values = model.parameters();
    return Result(values.data(), values.data() + values.size());
  }
  static Result none() { return Result(); }
};

struct PrincipalPoint {
  using Result = Vec<double, 2>;
  template <class Model>
  Result operator()(const Model& model) const {
    Result pixel{};
    (void)model.project({0, 0, 1}, pixel);
    return pixel;
  }
  static Result none() { return Result{}; }
};

struct ProjectOne {
  using Result = bool;
  const Vec<double, 3>& point;
  Vec<double, 2>& pixel;
  Mat<double, 2, 3>* by_point;
  double* by_parameters;

  template <class Model>
  bool operator()(const Model& model) const {
    if (by_parameters == nullptr) return model.project(point, pixel, by_point);
    typename Model::ParameterJacobian jacobian;
    if (!model.project(point, pixel, by_point, &jacobian)) return false;
    std::copy(jacobian.values, jacobian.values + 2 * Model::parameterCount(), by_parameters);
    return true;
  }
  static bool none() { return false; }
};

struct UnprojectOne {
  using Result = bool;
  const Vec<double, 2>& pixel;
  Vec<double, 3>& bearing;
  Mat<double, 3, 2>* by_pixel;
  double* by_parameters;

  template <class Model>
  bool operator()(const Model& model) const {
    if (by_parameters == nullptr) return model.unproject(pixel, bearing, by_pixel);
    typename Model::BearingParameterJacobian jacobian;
    if (!model.unproject(pixel, bearing, by_pixel, &jacobian)) return false;
    std::copy(jacobian.values, jacobian.values + 3 * Model::parameterCount(), by_parameters);
    return true;
  }
  static bool none() { return false; }
};

struct ProjectMany {
  using Result = std::size_t;
  Span<const Vec<double, 3>> points;
  Span<Vec<double, 2>> pixels;
  Span<std::uint8_t> is_valid;

  template <class Model>
  Result operator()(const Model& camera) const {
    const Model model = camera;  // a copy of its own, which writing the results cannot change
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_seen = model.project(points[i], pixels[i]);
      is_valid[i] = is_seen ? 1 : 0;
      count += is_seen ? 1 : 0;
    }
    return count;
  }
  Result none() const {
    std::fill(is_valid.begin(), is_valid.end(), std::uint8_t(0));
    return 0;
  }
};

struct UnprojectMany {
  using Result = std::size_t;
  Span<const Vec<double, 2>> pixels;
  Span<Vec<double, 3>> bearings;
  Span<std::uint8_t> is_valid;

  template <class Model>
  Result operator()(const Model& camera) const {
    const Model model = camera;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const bool is_seen = model.unproject(pixels[i], bearings[i]);
      is_valid[i] = is_seen ? 1 : 0;
      count += is_seen ? 1 : 0;
    }
    return count;
  }
  Result none() const {
    std::fill(is_valid.begin(), is_valid.end(), std::uint8_t(0));
    return 0;
  }
};

template <class Camera>
struct Resize {
  using Result = Camera;
  const Camera& camera;  // with the new size
  double factor_x, factor_y;

  template <class Model>
  Result operator()(const Model& model) const {
    Camera result = camera;
    // Made anew, so that what is no camera any more is refused.
    result.storage_.set(Model(model.resized(factor_x, factor_y).parameters()));
    return result;
  }
  Result none() const { return camera; }
};

template <class Camera>
struct Crop {
  using Result = Camera;
  const Camera& camera;  // with the new size
  double x, y;

  template <class Model>
  Result operator()(const Model& model) const {
    Camera result = camera;
    result.storage_.set(model.cropped(x, y));
    return result;
  }
  Result none() const { return camera; }
};

inline double angleBetween(const Vec<double, 3>& a, const Vec<double, 3>& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_VISITORS_H
