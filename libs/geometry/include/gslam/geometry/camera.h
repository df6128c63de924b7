#ifndef GSLAM_GEOMETRY_CAMERA_H
#define GSLAM_GEOMETRY_CAMERA_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/geometry/detail/camera_build.h>
#include <gslam/geometry/detail/camera_models.h>
#include <gslam/geometry/detail/camera_visitors.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

/// @file
/// A camera of any model, with the size of its image.

namespace gslam {
inline namespace v1 {

/// How much a camera sees inside its image: full angles in radians, up to 2 pi.
struct FieldOfView {
  double horizontal;  ///< from the left border to the right one, through the principal point
  double vertical;    ///< from the upper border to the lower one, through the principal point
  double diagonal;    ///< from the upper left corner to the lower right one, by way of the axis
};

/// A camera of any model and the size of its image: a value, to be copied and handed on.
///
/// Points are given in camera coordinates: x right, y down, z forward, metres. Pixels (u, v) have
/// the centre of the first one at (0, 0). Functions that return false left their results as they
/// were. A camera made by Camera() sees nothing.
///
///     const Camera camera =
///         Camera::fromParameters("kannala_brandt", 512, 512, {191, 191, 255, 257, 0, 0, 0, 0});
///     Vec2d pixel;
///     if (camera.project({0.1, 0.2, 1}, pixel)) ...
///
/// Layout: a few integers and 48 double, trivially copyable, without pointers or virtual functions:
/// it may cross the border to a plugin that somebody else built. It allocates nothing but the
/// results that are strings and vectors. Immutable, so it may be shared by threads.
class Camera {
 public:
  /// No camera: it sees nothing, its image has no pixels.
  Camera() noexcept : width_(0), height_(0), model_(-1), reserved_(0) {}

  /// A camera of a model known when compiling, such as DoubleSphereCamera<double>.
  /// @param width, height  of the image, pixels
  /// @param model          one of `gslam/geometry/camera/`, in double
  /// @throws ArgumentError when a size is not positive
  template <class Model>
  Camera(int width, int height, const Model& model) : Camera() {
    setSize(width, height);
    storage_.set(model);
    model_ = detail::CameraModelIndex<Model, detail::CameraModels>::value;
  }

  /// A camera of a model known when running.
  /// @param model   one of modelNames(), or equidistant or fisheye for kannala_brandt, atan for fov
  /// @param width, height  of the image, pixels
  /// @param values  of all parameters in the order of parameterNames(); their number chooses
  ///                between the radtan models. None for equirectangular means the whole sphere.
  /// @throws ArgumentError when the model is not known, a size is not positive, the number of
  /// values
  ///   is wrong, or the model refuses one
  static Camera fromParameters(const std::string& model, int width, int height,
                               const std::vector<double>& values) {
    if (model == "equirectangular" && values.empty()) {
      return Camera(width, height, equirectangularForImage<double>(width, height));
    }
    Camera camera;
    camera.setSize(width, height);
    const detail::CameraModelFacts& facts = detail::cameraModelOf(model, values.size());
    facts.make(values.data(), camera.storage_, camera.model_);
    return camera;
  }

  /// The same with named values, in any order: of radtan, the model whose names these are is taken.
  /// @throws ArgumentError as fromParameters(), and when a name is missing or not known
  static Camera fromNamedParameters(const std::string& model, int width, int height,
                                    const std::map<std::string, double>& values) {
    return fromParameters(model, width, height, detail::orderedCameraValues(model, values));
  }

  /// Names of all models.
  static std::vector<std::string> modelNames() { return detail::cameraModelNames(); }

  /// Whether this is a camera, not what Camera() made.
  bool isValid() const noexcept { return model_ >= 0; }
  /// Name of the model; empty for no camera.
  std::string modelName() const { return isValid() ? facts().name : ""; }
  /// Columns of the image.
  int width() const noexcept { return width_; }
  /// Rows of the image.
  int height() const noexcept { return height_; }

  /// Number of parameters.
  std::size_t parameterCount() const { return isValid() ? facts().parameter_count : 0; }
  /// Names of the parameters, such as fx fy cx cy.
  std::vector<std::string> parameterNames() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < parameterCount(); ++i) names.push_back(facts().parameter_name(i));
    return names;
  }
  /// Values of the parameters, in the order of parameterNames().
  std::vector<double> parameters() const { return visit(detail::ListParameters()); }
  /// Value of a parameter by its name.
  /// @throws ArgumentError when the model has none of this name
  double parameter(const std::string& name) const {
    return parameters()[detail::cameraParameterIndex(parameterNames(), modelName(), name)];
  }

  /// Whether a pixel is in the image: -0.5 <= u < width - 0.5, and v likewise.
  bool isInImage(const Vec2d& pixel) const noexcept {
    return pixel[0] >= -0.5 && pixel[0] < width_ - 0.5 && pixel[1] >= -0.5 &&
           pixel[1] < height_ - 0.5;
  }

  /// Where a point is seen.
  /// @param point          camera coordinates, metres
  /// @param pixel          result
  /// @param by_point       result unless null: d pixel / d point
  /// @param by_parameters  result unless null: d pixel / d parameters, 2 rows of parameterCount()
  ///                       columns, row by row
  /// @return whether the model sees the point, inside the image or beside it
  bool project(const Vec3d& point, Vec2d& pixel, Mat<double, 2, 3>* by_point = nullptr,
               double* by_parameters = nullptr) const {
    return visit(detail::ProjectOne{point, pixel, by_point, by_parameters});
  }

  /// The direction that a pixel looks in.
  /// @param pixel          (u, v), inside the image or beside it
  /// @param bearing        result: camera coordinates, length 1
  /// @param by_pixel       result unless null: d bearing / d pixel
  /// @param by_parameters  result unless null: d bearing / d parameters, 3 rows of parameterCount()
  ///                       columns, row by row
  /// @return whether project() gives the pixel back (for models that iterate: it did converge)
  bool unproject(const Vec2d& pixel, Vec3d& bearing, Mat<double, 3, 2>* by_pixel = nullptr,
                 double* by_parameters = nullptr) const {
    return visit(detail::UnprojectOne{pixel, bearing, by_pixel, by_parameters});
  }

  /// project() of many points, with the model chosen once.
  /// @param points    camera coordinates, metres
  /// @param pixels    results, as many
  /// @param is_valid  results, as many: 1 where the point is seen, 0 where the pixel was not set
  /// @return number of points that are seen
  /// @throws ArgumentError when the numbers differ
  std::size_t projectMany(Span<const Vec3d> points, Span<Vec2d> pixels,
                          Span<std::uint8_t> is_valid) const {
    detail::checkCameraBatch("pixels", pixels.size(), points.size());
    detail::checkCameraBatch("is_valid", is_valid.size(), points.size());
    return visit(detail::ProjectMany{points, pixels, is_valid});
  }

  /// unproject() of many pixels, with the model chosen once.
  /// @param pixels    (u, v)
  /// @param bearings  results, as many
  /// @param is_valid  results, as many: 1 where there is a bearing, 0 where it was not set
  /// @return number of bearings
  /// @throws ArgumentError when the numbers differ
  std::size_t unprojectMany(Span<const Vec2d> pixels, Span<Vec3d> bearings,
                            Span<std::uint8_t> is_valid) const {
    detail::checkCameraBatch("bearings", bearings.size(), pixels.size());
    detail::checkCameraBatch("is_valid", is_valid.size(), pixels.size());
    return visit(detail::UnprojectMany{pixels, bearings, is_valid});
  }

  /// What the camera sees inside its image. Where a border lies beyond what the model can do, the
  /// last direction before it counts.
  FieldOfView fieldOfView() const {
    const Vec2d centre = visit(detail::PrincipalPoint());
    const double left = -0.5, right = width_ - 0.5, top = -0.5, bottom = height_ - 0.5;
    FieldOfView view;
    view.horizontal = angleBetween({left, centre[1]}, {right, centre[1]}, centre);
    view.vertical = angleBetween({centre[0], top}, {centre[0], bottom}, centre);
    view.diagonal = angleBetween({left, top}, {right, bottom}, centre);
    return view;
  }

  /// The camera of the same image, resized. Borders of pixels stay borders:
  /// u' + 0.5 = (u + 0.5) width / width().
  /// @throws ArgumentError when a size is not positive, or this is no camera
  Camera resized(int width, int height) const {
    checkIsCamera();
    Camera result = *this;
    result.setSize(width, height);
    return visit(detail::Resize<Camera>{result, double(width) / width_, double(height) / height_});
  }

  /// The camera of the same image, resized by a factor; its size is rounded.
  /// @throws ArgumentError when the factor is not positive and finite, the image would have no
  ///   pixels or too many, or this is no camera
  Camera scaled(double factor) const {
    checkIsCamera();
    Camera result = *this;
    result.setSize(detail::scaledCameraSize(width_, factor),
                   detail::scaledCameraSize(height_, factor));
    return visit(detail::Resize<Camera>{result, factor, factor});
  }

  /// The camera of a part of the image, or of a larger image around it.
  /// @param x, y           pixel of this image that becomes the first one
  /// @param width, height  of the part
  /// @throws ArgumentError when a size is not positive, or this is no camera
  Camera cropped(int x, int y, int width, int height) const {
    checkIsCamera();
    Camera result = *this;
    result.setSize(width, height);
    return visit(detail::Crop<Camera>{result, double(x), double(y)});
  }

  /// Calls `visitor(model)` with the model in its own type; `visitor.none()` for no camera. With it
  /// a loop chooses the model once.
  /// @tparam Visitor  has a type Result, a template of a const operator() for all models, and
  /// none()
  template <class Visitor>
  typename Visitor::Result visit(const Visitor& visitor) const {
    return detail::CameraDispatch<Visitor>::call(model_, storage_, visitor);
  }

  /// Whether model, size and all parameters are equal.
  friend bool operator==(const Camera& a, const Camera& b) {
    return a.model_ == b.model_ && a.width_ == b.width_ && a.height_ == b.height_ &&
           a.parameters() == b.parameters();
  }
  /// The opposite of ==.
  friend bool operator!=(const Camera& a, const Camera& b) { return !(a == b); }

  /// For people: `pinhole 640 x 480 fx 500 fy 500 cx 319.5 cy 239.5`.
  friend std::ostream& operator<<(std::ostream& out, const Camera& camera) {
    if (!camera.isValid()) return out << "no camera";
    out << camera.modelName() << ' ' << camera.width_ << " x " << camera.height_;
    const std::vector<double> values = camera.parameters();
    for (std::size_t i = 0; i < values.size(); ++i) {
      out << ' ' << camera.facts().parameter_name(i) << ' ' << values[i];
    }
    return out;
  }

 private:
  friend struct detail::Resize<Camera>;
  friend struct detail::Crop<Camera>;

  const detail::CameraModelFacts& facts() const { return detail::cameraModelFacts()[model_]; }

  void setSize(int width, int height) {
    detail::checkParameter(width > 0, "width", double(width), "1 pixel or more");
    detail::checkParameter(height > 0, "height", double(height), "1 pixel or more");
    width_ = width;
    height_ = height;
  }

  void checkIsCamera() const {
    if (!isValid()) throw ArgumentError("camera", "is none, expected one with a model");
  }

  // The angle on the way from a to b: by way of the axis where the principal point lies between
  // them, so that it may be more than half a turn.
  double angleBetween(const Vec2d& a, const Vec2d& b, const Vec2d& centre) const {
    const Vec3d to_a = lastSeen(centre, a), to_b = lastSeen(centre, b), axis = {0, 0, 1};
    if ((a - centre).dot(b - centre) > 0) return detail::angleBetween(to_a, to_b);
    return detail::angleBetween(axis, to_a) + detail::angleBetween(axis, to_b);
  }

  // The bearing of the farthest pixel on the straight way to `border` that the model sees.
  Vec3d lastSeen(const Vec2d& centre, const Vec2d& border) const {
    Vec3d bearing = {0, 0, 1};
    if (unproject(border, bearing)) return bearing;
    double seen = 0, unseen = 1;
    for (int i = 0; i < 60; ++i) {
      const double middle = (seen + unseen) / 2;
      const bool is_seen = unproject(centre + middle * (border - centre), bearing);
      (is_seen ? seen : unseen) = middle;
    }
    return bearing;
  }

  std::int32_t width_;
  std::int32_t height_;
  std::int32_t model_;  // place in detail::CameraModels; -1: none
  std::int32_t reserved_;
  detail::CameraStorage storage_;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_CAMERA_H
