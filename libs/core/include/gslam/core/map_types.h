#ifndef GSLAM_CORE_MAP_TYPES_H
#define GSLAM_CORE_MAP_TYPES_H

#include <gslam/core/frame.h>
#include <gslam/core/image.h>
#include <gslam/geometry/mat.h>
#include <gslam/geometry/se3.h>
#include <gslam/geometry/so3.h>
#include <gslam/geometry/vec.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

/// @file
/// What a Map is made of: plain records and the ids that connect them.

namespace gslam {
inline namespace v1 {

/// @{
/// Names of the parts of a map: numbers that stay the same as long as the map lives, in its copies
/// and in its file. They are counted up from 0 and not given twice.
///
///     const PointId third = PointId(2);
///     const std::uint32_t number = std::uint32_t(third);
enum class KeyframeId : std::uint32_t {};
enum class PointId : std::uint32_t {};
enum class EdgeId : std::uint32_t {};
/// @}

constexpr PointId kNoPoint = PointId(0xFFFFFFFF);  ///< what a feature sees that sees no point

/// A place in an image that can be found again in others.
struct Feature {
  Vec2f pixel{};             ///< (u, v)
  float size = 0;            ///< diameter, pixels; 0: unknown
  float angle = 0;           ///< radians, from the u to the v axis
  float response = 0;        ///< how strong it is; the larger the better
  std::int16_t octave = 0;   ///< level of the pyramid where it was found
  std::uint16_t camera = 0;  ///< which one, by its place in Map::rig()
};

/// What was seen in a keyframe. It does not change once it is in a map, which shares it.
struct KeyframeContent {
  std::vector<CameraImage> images;  ///< in the order of Frame::images; none: not kept
  std::vector<Feature> features;    ///< of all cameras
  Image descriptors;                ///< one row a feature; no image: not kept
};

/// A frame that is kept in the map.
struct Keyframe {
  std::uint64_t frame = 0;                         ///< Frame::id
  std::int64_t stamp = 0;                          ///< Frame::stamp, nanoseconds
  SE3d T_world_body;                               ///< metres, or the map's own unit
  std::shared_ptr<const KeyframeContent> content;  ///< in a map it is never null
};

/// A feature that sees a point, from the point's side.
struct Observation {
  KeyframeId keyframe;    ///< where
  std::uint32_t feature;  ///< place in KeyframeContent::features

  /// Whether both are the same.
  friend bool operator==(const Observation& a, const Observation& b) noexcept {
    return a.keyframe == b.keyframe && a.feature == b.feature;
  }
  /// Not ==.
  friend bool operator!=(const Observation& a, const Observation& b) noexcept { return !(a == b); }
};

/// What is seen: a point, or what has more extent than one. The numbers stand in files.
enum class PointKind : std::uint8_t {
  point = 0,
  control = 1,  ///< a point whose place was surveyed: Shape::size are the standard deviations
  line = 2,     ///< a piece of a line: along x of its Shape, as long as size[0]
  plane = 3,    ///< a piece of a plane: z of its Shape is the normal, size[0] by size[1] along x, y
  object = 4    ///< a thing in a box: Shape::size are its edges
};

namespace detail {
constexpr std::uint8_t kPointKinds = 5;  // number of them
}

/// Its name, such as "point"; "unknown" for a number that is no kind.
inline const char* pointKindName(PointKind kind) noexcept {
  static const char* const kNames[] = {"point", "control", "line", "plane", "object"};
  const std::size_t i = static_cast<std::size_t>(kind);
  return i < sizeof(kNames) / sizeof(kNames[0]) ? kNames[i] : "unknown";
}

/// A colour; none where alpha is 0.
struct Color {
  std::uint8_t red;    ///< 0 to 255
  std::uint8_t green;  ///< 0 to 255
  std::uint8_t blue;   ///< 0 to 255
  std::uint8_t alpha;  ///< 255: opaque

  /// Whether all four are the same.
  friend bool operator==(const Color& a, const Color& b) noexcept {
    return a.red == b.red && a.green == b.green && a.blue == b.blue && a.alpha == b.alpha;
  }
  /// Not ==.
  friend bool operator!=(const Color& a, const Color& b) noexcept { return !(a == b); }
};

/// A point of the map, or the centre of what is more than a point.
struct MapPoint {
  Vec3d position{};                   ///< world coordinates
  Vec3f normal{};                     ///< length 1, world coordinates; all zero: unknown
  Color color{};                      ///< as it was seen
  std::uint32_t label = 0;            ///< number of a class or object; 0: none
  PointKind kind = PointKind::point;  ///< what it is
  std::uint8_t reserved[3] = {};      ///< zero; not written to files
};

/// The extent of what is more than a point, about MapPoint::position. PointKind says what it means.
struct Shape {
  SO3d R_world_shape;  ///< takes the axes of the shape to those of the world
  Vec3d size{};        ///< along its axes; 0: unknown or without end
};

/// Where a relative pose comes from. The numbers stand in files.
enum class EdgeKind : std::uint8_t {
  odometry = 0,   ///< from one keyframe to the next: tracking, wheels, inertia
  loop = 1,       ///< a place that was seen again
  reference = 2,  ///< the keyframe that another was made from, as in a spanning tree
  other = 3
};

namespace detail {
constexpr std::uint8_t kEdgeKinds = 4;  // number of them
}

/// Its name, such as "loop"; "unknown" for a number that is no kind.
inline const char* edgeKindName(EdgeKind kind) noexcept {
  static const char* const kNames[] = {"odometry", "loop", "reference", "other"};
  const std::size_t i = static_cast<std::size_t>(kind);
  return i < sizeof(kNames) / sizeof(kNames[0]) ? kNames[i] : "unknown";
}

/// A relative pose of two keyframes' bodies, as it was measured.
struct PoseEdge {
  KeyframeId from{};                   ///< the one
  KeyframeId to{};                     ///< the other
  SE3d T_from_to;                      ///< takes coordinates of body `to` to those of `from`
  double scale = 1;                    ///< of lengths around `to` in those around `from`
  Mat<double, 6, 6> information{};     ///< of (translation, rotation) in T_from_to * exp(delta);
                                       ///< zero: a link without a measurement
  EdgeKind kind = EdgeKind::odometry;  ///< where it comes from
  std::uint8_t reserved[7] = {};       ///< zero; not written to files
};

static_assert(sizeof(Feature) == 24 && sizeof(Observation) == 8 && sizeof(MapPoint) == 48 &&
                  sizeof(Shape) == 56 && sizeof(PoseEdge) == 368,
              "maps cross plugin borders");
static_assert(sizeof(void*) != 8 || sizeof(Keyframe) == 88, "maps cross plugin borders");

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_TYPES_H
