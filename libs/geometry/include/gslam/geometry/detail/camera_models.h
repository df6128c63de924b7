// The list of camera models that a Camera can hold, and the call of the right one.
#ifndef GSLAM_GEOMETRY_DETAIL_CAMERA_MODELS_H
#define GSLAM_GEOMETRY_DETAIL_CAMERA_MODELS_H

#include <gslam/geometry/camera/double_sphere.h>
#include <gslam/geometry/camera/equirectangular.h>
#include <gslam/geometry/camera/eucm.h>
#include <gslam/geometry/camera/fov.h>
#include <gslam/geometry/camera/kannala_brandt.h>
#include <gslam/geometry/camera/mei.h>
#include <gslam/geometry/camera/ocam.h>
#include <gslam/geometry/camera/orthographic.h>
#include <gslam/geometry/camera/pinhole.h>
#include <gslam/geometry/camera/radtan.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

namespace gslam {
inline namespace v1 {
namespace detail {

template <class... Models>
struct CameraModelList {
  static constexpr std::size_t size() noexcept { return sizeof...(Models); }
};

// The place in this list is the number that stands in a Camera: new models are added at the end,
// or plugins built before understand another model.
using CameraModels =
    CameraModelList<PinholeCamera<double>, RadtanCamera<double, 4>, RadtanCamera<double, 5>,
                    RadtanCamera<double, 8>, RadtanCamera<double, 12>, RadtanCamera<double, 14>,
                    KannalaBrandtCamera<double>, FovCamera<double>, OcamCamera<double>,
                    DoubleSphereCamera<double>, EucmCamera<double>, UcmCamera<double>,
                    MeiCamera<double>, EquirectangularCamera<double>, OrthographicCamera<double>>;

// Index of a model in a list.
template <class Model, class List>
struct CameraModelIndex;
template <class Model, class... Rest>
struct CameraModelIndex<Model, CameraModelList<Model, Rest...>>
    : std::integral_constant<std::int32_t, 0> {};
template <class Model, class First, class... Rest>
struct CameraModelIndex<Model, CameraModelList<First, Rest...>>
    : std::integral_constant<std::int32_t,
                             1 + CameraModelIndex<Model, CameraModelList<Rest...>>::value> {};

// Room for any of the models: 48 numbers, of which the largest takes 31.
class CameraStorage {
 public:
  CameraStorage() noexcept : numbers_{} {}

  template <class Model>
  void set(const Model& model) noexcept {
    static_assert(sizeof(Model) <= sizeof(numbers_), "a Camera has no room for this model");
    static_assert(std::is_trivially_copyable<Model>::value, "a Camera is copied byte by byte");
    static_assert(std::is_trivially_destructible<Model>::value, "a Camera destroys no model");
    ::new (static_cast<void*>(numbers_)) Model(model);
  }

  template <class Model>
  const Model& get() const noexcept {
    return *static_cast<const Model*>(static_cast<const void*>(numbers_));
  }

 private:
  double numbers_[48];
};

// Calls visitor(model) with the model of this index; visitor.none() where there is none.
template <class Visitor, class List = CameraModels>
struct CameraDispatch;

template <class Visitor>
struct CameraDispatch<Visitor, CameraModelList<>> {
  static typename Visitor::Result call(std::int32_t, const CameraStorage&, const Visitor& visitor) {
    return visitor.none();
  }
};

template <class Visitor, class First, class... Rest>
struct CameraDispatch<Visitor, CameraModelList<First, Rest...>> {
  static typename Visitor::Result call(std::int32_t index, const CameraStorage& storage,
                                       const Visitor& visitor) {
    using Next = CameraDispatch<Visitor, CameraModelList<Rest...>>;
    constexpr std::int32_t here = CameraModelIndex<First, CameraModels>::value;
    return index == here ? visitor(storage.get<First>()) : Next::call(index, storage, visitor);
  }
};

// What is known of a model without a camera.
struct CameraModelFacts {
  const char* name;
  std::size_t parameter_count;
  const char* (*parameter_name)(std::size_t);
  void (*make)(const double* parameters, CameraStorage& storage, std::int32_t& index);
};

template <class Model>
void makeCameraModel(const double* parameters, CameraStorage& storage, std::int32_t& index) {
  typename Model::Parameters values;
  for (std::size_t i = 0; i < Model::parameterCount(); ++i) values[i] = parameters[i];
  storage.set(Model(values));
  index = CameraModelIndex<Model, CameraModels>::value;
}

template <class... Models>
const CameraModelFacts* factsOf(CameraModelList<Models...>) {
  static const CameraModelFacts facts[] = {{Models::name(), Models::parameterCount(),
                                            Models::parameterName, makeCameraModel<Models>}...};
  return facts;
}

// CameraModels::size() of them, in the order of the list.
inline const CameraModelFacts* cameraModelFacts() {
  return factsOf(CameraModels());
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_GEOMETRY_DETAIL_CAMERA_MODELS_H
