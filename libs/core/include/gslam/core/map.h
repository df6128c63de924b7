#ifndef GSLAM_CORE_MAP_H
#define GSLAM_CORE_MAP_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/core/detail/cow.h>
#include <gslam/core/detail/list_table.h>
#include <gslam/core/detail/record_table.h>
#include <gslam/core/map_range.h>
#include <gslam/core/map_types.h>
#include <gslam/core/rig.h>
#include <gslam/geometry/sim3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// @file
/// What a SLAM system knows of the world.

namespace gslam {
inline namespace v1 {
namespace detail {
struct MapLoader;
}

/// Keyframes, the points they see, and their relative poses: the bundle graph and the pose graph.
///
///     Map map;
///     const KeyframeId here = map.add(keyframe);
///     const PointId corner = map.add(point);
///     map.observe(corner, here, 17);  // feature 17 of the keyframe sees it
///     for (const Observation& seen : map.observations(corner)) ...
///
/// **A value.** A copy takes microseconds, whatever the size: it shares all storage, and who writes
/// first to a part of 256 ids copies that part. So a copy is a snapshot; SharedMap hands them out.
///
/// **Threads.** As an int: one map may be read and copied by many threads, or written by one. Maps
/// that are copies of each other are independent.
///
/// **Time.** All takes constant time, or as long as the lists that it changes, unless said
/// otherwise.
///
/// **Memory**, measured on x86-64 with 1e6 points, 1e5 keyframes and 1e7 observations: 50 bytes a
/// point, 235 a keyframe, 16 an observation (8 in the list of its point, 4 in that of its keyframe,
/// the rest for heads and room to grow), and beside the graph 24 a feature and what descriptors and
/// images have. A point's shape takes 58, its descriptor 50 where it is a view of others.
///
/// Pointers and spans that it gives are valid until it changes or is gone; what its functions are
/// given may be in the map itself: `map.set(id, map.at(other))`.
class Map {
 public:
  /// @{
  /// Ranges for loops.
  using Keyframes = MapRange<KeyframeId, Keyframe, detail::KeyframeRow>;
  using Points = MapRange<PointId, MapPoint>;
  using Edges = MapRange<EdgeId, PoseEdge>;
  /// @}

  /// No sensors, no keyframes, no points.
  Map() = default;
  /// @{
  /// A copy is a snapshot; what was moved from is empty.
  Map(const Map& other) = default;
  Map(Map&& other) noexcept { swap(other); }
  Map& operator=(const Map& other) = default;
  Map& operator=(Map&& other) noexcept {
    Map moved(std::move(other));
    swap(moved);
    return *this;
  }
  /// @}
  ~Map() = default;

  /// Exchanges two maps, in no time.
  void swap(Map& other) noexcept {
    std::swap(owner_, other.owner_);
    std::swap(rig_, other.rig_);
    std::swap(keyframes_, other.keyframes_);
    std::swap(points_, other.points_);
    std::swap(shapes_, other.shapes_);
    std::swap(descriptors_, other.descriptors_);
    std::swap(edges_, other.edges_);
    std::swap(observations_, other.observations_);
    std::swap(edge_lists_, other.edge_lists_);
    std::swap(observation_count_, other.observation_count_);
    std::swap(keyframe_end_, other.keyframe_end_);
    std::swap(point_end_, other.point_end_);
    std::swap(edge_end_, other.edge_end_);
  }

  /// The sensors, whose cameras Feature::camera counts.
  const SensorRig& rig() const noexcept {
    static const SensorRig kNone;
    return rig_ == nullptr ? kNone : *rig_;
  }
  /// Sets the sensors.
  /// @throws ArgumentError when a camera has images of an unknown kind
  void setRig(const SensorRig& rig) {
    for (const CameraSensor& sensor : rig.cameras) checkKind(sensor.kind);
    rig_ = std::make_shared<const SensorRig>(rig);
  }

  /// @{
  /// All of a kind, in the order of their ids.
  Keyframes keyframes() const noexcept { return Keyframes(keyframes_); }
  Points points() const noexcept { return Points(points_); }
  Edges edges() const noexcept { return Edges(edges_); }
  /// @}
  /// Features that see a point.
  std::size_t observationCount() const noexcept { return observation_count_; }

  /// @{
  /// Null where there is none of that id.
  const Keyframe* find(KeyframeId id) const noexcept {
    const detail::KeyframeRow* const row = keyframes_.find(std::uint32_t(id));
    return row == nullptr ? nullptr : &row->keyframe;
  }
  const MapPoint* find(PointId id) const noexcept { return points_.find(std::uint32_t(id)); }
  const PoseEdge* find(EdgeId id) const noexcept { return edges_.find(std::uint32_t(id)); }
  /// @}

  /// @{
  /// The one of that id.
  /// @throws ArgumentError when there is none
  const Keyframe& at(KeyframeId id) const { return row(id).keyframe; }
  const MapPoint& at(PointId id) const { return checked(find(id), "point", std::uint32_t(id)); }
  const PoseEdge& at(EdgeId id) const { return checked(find(id), "edge", std::uint32_t(id)); }
  /// @}

  /// @{
  /// What the next one added will be called.
  KeyframeId nextKeyframeId() const noexcept { return KeyframeId(keyframe_end_); }
  PointId nextPointId() const noexcept { return PointId(point_end_); }
  EdgeId nextEdgeId() const noexcept { return EdgeId(edge_end_); }
  /// @}

  /// @{
  /// Adds one.
  /// @throws ArgumentError when descriptors are kept, but not one row a feature; when an edge's
  ///   keyframe is not in the map or both are the same; when it, or an image, is of an unknown
  ///   kind; Error when all ids were given
  KeyframeId add(const Keyframe& keyframe) {
    const KeyframeId id = KeyframeId(freeId(keyframe_end_));
    insert(id, keyframe);
    return id;
  }
  PointId add(const MapPoint& point) {
    const PointId id = PointId(freeId(point_end_));
    insert(id, point);
    return id;
  }
  EdgeId add(PoseEdge edge) {
    const EdgeId id = EdgeId(freeId(edge_end_));
    insert(id, edge);
    return id;
  }
  /// @}

  /// @{
  /// Adds one with an id of the caller's; those that add() gives are above it from then on.
  /// @throws ArgumentError as add(), and when the id is taken or 0xFFFFFFFF
  void insert(KeyframeId id, const Keyframe& keyframe) {
    const std::uint32_t number = checkedFree(find(id), "keyframe", std::uint32_t(id));
    detail::KeyframeRow row;
    row.keyframe = keyframe;
    if (row.keyframe.content == nullptr) {
      row.keyframe.content = std::make_shared<const KeyframeContent>();
    }
    checkKinds(row.keyframe.content->images);
    const std::size_t features = checkedFeatureCount(*row.keyframe.content);
    if (features != 0) row.points.edit(owner_).assign(features, kNoPoint);
    keyframes_.insert(number, std::move(row), owner_);
    keyframe_end_ = std::max(keyframe_end_, number + 1);
  }
  void insert(PointId id, const MapPoint& point) {
    const std::uint32_t number = checkedFree(find(id), "point", std::uint32_t(id));
    checkKind(point.kind);
    points_.insert(number, point, owner_);
    point_end_ = std::max(point_end_, number + 1);
  }
  void insert(EdgeId id, PoseEdge edge) {
    const std::uint32_t number = checkedFree(find(id), "edge", std::uint32_t(id));
    checkEdge(edge);
    edges_.insert(number, edge, owner_);
    edge_end_ = std::max(edge_end_, number + 1);
    edge_lists_.add(std::uint32_t(edge.from), id, owner_);
    edge_lists_.add(std::uint32_t(edge.to), id, owner_);
  }
  /// @}

  /// Moves a keyframe.
  /// @throws ArgumentError when there is none
  void setPose(KeyframeId id, SE3d T_world_body) {
    editRow(id).keyframe.T_world_body = T_world_body;
  }
  /// Replaces the images of a keyframe, such as by none to save memory. Copies its features.
  /// @throws ArgumentError when there is none, or an image is of an unknown kind
  void setImages(KeyframeId id, std::vector<CameraImage> images) {
    checkKinds(images);
    Keyframe& keyframe = editRow(id).keyframe;
    keyframe.content = withImages(keyframe, std::move(images));
  }
  /// Moves a point.
  /// @throws ArgumentError when there is none
  void setPosition(PointId id, Vec3d position) { editPoint(id).position = position; }
  /// Replaces a point; who sees it, its shape and its descriptor stay.
  /// @throws ArgumentError when there is none, or it is of an unknown kind
  void set(PointId id, MapPoint point) {
    checkKind(point.kind);
    editPoint(id) = point;
  }
  /// Replaces an edge, which may change its ends.
  /// @throws ArgumentError when there is none, or as for add()
  void set(EdgeId id, PoseEdge edge) {
    at(id);
    checkEdge(edge);
    remove(id);
    insert(id, edge);
  }

  /// The extent of a point; null where it has none, or is not in the map.
  const Shape* shape(PointId id) const noexcept { return shapes_.find(std::uint32_t(id)); }
  /// Gives a point an extent.
  /// @throws ArgumentError when there is no such point
  void setShape(PointId id, const Shape& shape) {
    at(id);
    shapes_.set(std::uint32_t(id), shape, owner_);
  }
  /// Takes it away, where there is one.
  void removeShape(PointId id) { shapes_.erase(std::uint32_t(id), owner_); }

  /// The descriptor of a point: an image of one row, such as a view of a row of
  /// KeyframeContent::descriptors; null where it has none, or is not in the map.
  const Image* descriptor(PointId id) const noexcept {
    return descriptors_.find(std::uint32_t(id));
  }
  /// Gives a point a descriptor, which nobody may write to any more; no image takes it away.
  /// @throws ArgumentError when there is no such point, or the image has more than one row
  void setDescriptor(PointId id, const Image& row) {
    at(id);
    if (row.height() > 1) throw ArgumentError("descriptor", "is " + row.text() + ", not one row");
    if (row.empty()) {
      descriptors_.erase(std::uint32_t(id), owner_);
    } else {
      descriptors_.set(std::uint32_t(id), row, owner_);
    }
  }

  /// Who sees a point, in the order it was said; nobody where it is not in the map.
  Span<const Observation> observations(PointId id) const noexcept {
    return observations_.list(std::uint32_t(id));
  }
  /// The point that each feature of a keyframe sees, or kNoPoint; as many as it has features.
  /// @throws ArgumentError when there is no such keyframe
  Span<const PointId> pointsSeen(KeyframeId id) const {
    const std::vector<PointId>* const points = row(id).points.get();
    return points == nullptr ? Span<const PointId>() : Span<const PointId>(*points);
  }
  /// The point that a feature sees, or kNoPoint.
  /// @throws ArgumentError when there is no such keyframe or feature
  PointId pointSeen(KeyframeId id, std::uint32_t feature) const {
    const Span<const PointId> points = pointsSeen(id);
    checkFeature(id, feature, points.size());
    return points[feature];
  }
  /// The edges of a keyframe, whichever end it is; none where it is not in the map.
  Span<const EdgeId> edgesOf(KeyframeId id) const noexcept {
    return edge_lists_.list(std::uint32_t(id));
  }

  /// Says that a feature sees a point, and no other any more.
  /// @throws ArgumentError when one of them is not in the map
  void observe(PointId point, KeyframeId keyframe, std::uint32_t feature) {
    at(point);
    if (pointSeen(keyframe, feature) == point) return;
    forget(keyframe, feature);
    std::vector<PointId>& points = editRow(keyframe).points.edit(owner_);
    observations_.add(std::uint32_t(point), Observation{keyframe, feature}, owner_);
    points[feature] = point;
    ++observation_count_;
  }
  /// Says that a feature sees no point.
  /// @throws ArgumentError when there is no such keyframe or feature
  void forget(KeyframeId keyframe, std::uint32_t feature) {
    const PointId point = pointSeen(keyframe, feature);
    if (point == kNoPoint) return;
    std::vector<PointId>& points = editRow(keyframe).points.edit(owner_);
    observations_.remove(std::uint32_t(point), Observation{keyframe, feature}, owner_);
    points[feature] = kNoPoint;
    --observation_count_;
  }

  /// @{
  /// Removes one, with its observations, edges, shape and descriptor. Its id is not used again.
  /// @return whether there was one
  bool remove(KeyframeId id) {
    if (find(id) == nullptr) return false;
    const Span<const PointId> points = pointsSeen(id);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (points[i] == kNoPoint) continue;
      observations_.remove(std::uint32_t(points[i]), Observation{id, i}, owner_);
      --observation_count_;
    }
    const Span<const EdgeId> edges = edgesOf(id);
    for (const EdgeId edge : std::vector<EdgeId>(edges.begin(), edges.end())) remove(edge);
    return keyframes_.erase(std::uint32_t(id), owner_);
  }
  bool remove(PointId id) {
    if (find(id) == nullptr) return false;
    const Span<const Observation> seen = observations(id);
    for (const Observation& by : seen) {
      editRow(by.keyframe).points.edit(owner_)[by.feature] = kNoPoint;
    }
    observation_count_ -= seen.size();
    observations_.clear(std::uint32_t(id), owner_);
    shapes_.erase(std::uint32_t(id), owner_);
    descriptors_.erase(std::uint32_t(id), owner_);
    return points_.erase(std::uint32_t(id), owner_);
  }
  bool remove(EdgeId id) {
    const PoseEdge* const edge = find(id);
    if (edge == nullptr) return false;
    const std::uint32_t from = std::uint32_t(edge->from), to = std::uint32_t(edge->to);
    edge_lists_.remove(from, id, owner_);
    edge_lists_.remove(to, id, owner_);
    return edges_.erase(std::uint32_t(id), owner_);
  }
  /// @}

  /// Makes one of two points that are the same in the world. What saw the one that goes sees the
  /// other one then, except where a camera of a keyframe saw both: there the observation of the one
  /// that stays is right.
  /// @throws ArgumentError when one is not in the map, or both are the same
  void merge(PointId stays, PointId goes) {
    at(stays);
    at(goes);
    if (stays == goes) throw ArgumentError("goes", "is the point that stays");
    const Span<const Observation> seen = observations(goes);
    const std::vector<Observation> moved(seen.begin(), seen.end());
    remove(goes);
    for (const Observation& by : moved) {
      if (!isSeen(stays, by.keyframe, cameraOf(by))) observe(stays, by.keyframe, by.feature);
    }
  }

  /// Moves, turns and scales the world. Every point is seen at the same pixel as before: all that
  /// is a length is scaled, also the places of the sensors on the body, the depth scales and, so
  /// that they weigh the same, the information matrices of edges. Takes time as the map is large.
  /// @param S_new_old  takes old to new coordinates
  void transform(const SIM3d& S_new_old) {
    const double scale = S_new_old.scale();
    transformKeyframes(S_new_old);
    transformPoints(S_new_old);
    if (scale == 1) return;
    edges_.editAll(owner_, [scale](PoseEdge& edge) { scaleEdge(edge, scale); });
    if (rig_ != nullptr) setRig(scaled(*rig_, scale));
  }

 private:
  // Values that come in are copies where a record is written before they are read: writing may
  // free or move what the caller named.
  friend struct detail::MapLoader;

  template <class Value>
  static const Value& checked(const Value* value, const char* kind, std::uint32_t id) {
    if (value != nullptr) return *value;
    throw ArgumentError(std::string(kind) + " " + std::to_string(id), "is not in the map");
  }
  static std::uint32_t checkedFree(const void* taken, const char* kind, std::uint32_t id) {
    if (taken == nullptr && id != 0xFFFFFFFF) return id;
    throw ArgumentError(std::string(kind) + " " + std::to_string(id),
                        taken == nullptr ? "is no id" : "is in the map already");
  }
  static std::uint32_t freeId(std::uint32_t end) {
    if (end == 0xFFFFFFFF) throw Error("a map has no ids left: 4294967295 were given");
    return end;
  }
  static std::size_t checkedFeatureCount(const KeyframeContent& content) {
    const std::size_t features = content.features.size();
    const Image& rows = content.descriptors;
    if (rows.empty() || std::size_t(rows.height()) == features) return features;
    throw ArgumentError("descriptors", "are " + rows.text() + ", expected " +
                                           std::to_string(features) + " rows: one a feature");
  }
  static void checkFeature(KeyframeId id, std::uint32_t feature, std::size_t count) {
    if (feature < count) return;
    throw ArgumentError("feature " + std::to_string(feature),
                        "is none of the " + std::to_string(count) + " of keyframe " +
                            std::to_string(std::uint32_t(id)));
  }
  // Files have no place for kinds that are none.
  static void checkKind(std::uint8_t kind, std::uint8_t end, const char* what) {
    if (kind < end) return;
    throw ArgumentError(
        std::string("kind of ") + what,
        "is " + std::to_string(kind) + ", expected 0 to " + std::to_string(end - 1));
  }
  static void checkKind(ImageKind kind) {
    checkKind(std::uint8_t(kind), detail::kImageKinds, "image");
  }
  static void checkKind(PointKind kind) {
    checkKind(std::uint8_t(kind), detail::kPointKinds, "point");
  }
  static void checkKinds(const std::vector<CameraImage>& images) {
    for (const CameraImage& image : images) checkKind(image.kind);
  }
  void checkEdge(const PoseEdge& edge) const {
    checkKind(std::uint8_t(edge.kind), detail::kEdgeKinds, "edge");
    at(edge.from);
    at(edge.to);
    if (edge.from == edge.to) throw ArgumentError("edge", "has the same keyframe at both ends");
  }

  const detail::KeyframeRow& row(KeyframeId id) const {
    return checked(keyframes_.find(std::uint32_t(id)), "keyframe", std::uint32_t(id));
  }
  detail::KeyframeRow& editRow(KeyframeId id) {
    row(id);
    return *keyframes_.edit(std::uint32_t(id), owner_);
  }
  MapPoint& editPoint(PointId id) {
    at(id);
    return *points_.edit(std::uint32_t(id), owner_);
  }

  std::uint16_t cameraOf(const Observation& by) const {
    return at(by.keyframe).content->features[by.feature].camera;
  }
  bool isSeen(PointId point, KeyframeId keyframe, std::uint16_t camera) const {
    for (const Observation& by : observations(point)) {
      if (by.keyframe == keyframe && cameraOf(by) == camera) return true;
    }
    return false;
  }

  static SE3d scaled(const SE3d& pose, double scale) {
    return SE3d(pose.rotation(), scale * pose.translation());
  }
  static SensorRig scaled(SensorRig rig, double scale) {
    for (CameraSensor& sensor : rig.cameras) {
      sensor.T_body_camera = scaled(sensor.T_body_camera, scale);
      sensor.depth_scale *= scale;
    }
    rig.imu.T_body_imu = scaled(rig.imu.T_body_imu, scale);
    rig.gnss_antenna *= scale;
    return rig;
  }
  static std::vector<CameraImage> scaled(std::vector<CameraImage> images, double scale) {
    for (CameraImage& image : images) {
      image.T_body_camera = scaled(image.T_body_camera, scale);
      image.depth_scale *= scale;
    }
    return images;
  }
  static void scaleEdge(PoseEdge& edge, double scale) {
    edge.T_from_to = scaled(edge.T_from_to, scale);
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t c = 0; c < 6; ++c) {
        edge.information(r, c) /= (r < 3 ? scale : 1) * (c < 3 ? scale : 1);
      }
    }
  }

  void transformKeyframes(const SIM3d& S) {
    keyframes_.editAll(owner_, [&S](detail::KeyframeRow& row) {
      SE3d& pose = row.keyframe.T_world_body;
      pose = SE3d(S.rotation() * pose.rotation(), S * pose.translation());
      if (S.scale() == 1 || row.keyframe.content->images.empty()) return;
      row.keyframe.content =
          withImages(row.keyframe, scaled(row.keyframe.content->images, S.scale()));
    });
  }
  void transformPoints(const SIM3d& S) {
    const SO3f R = S.rotation().cast<float>();
    points_.editAll(owner_, [&S, &R](MapPoint& point) {
      point.position = S * point.position;
      point.normal = R * point.normal;
    });
    shapes_.editAll(owner_, [&S](Shape& shape) {
      shape.R_world_shape = S.rotation() * shape.R_world_shape;
      shape.size *= S.scale();
    });
  }

  static std::shared_ptr<const KeyframeContent> withImages(const Keyframe& keyframe,
                                                           std::vector<CameraImage> images) {
    KeyframeContent content = *keyframe.content;
    content.images = std::move(images);
    return std::make_shared<const KeyframeContent>(std::move(content));
  }

  detail::CowOwner owner_;
  std::shared_ptr<const SensorRig> rig_;
  detail::RecordTable<detail::KeyframeRow> keyframes_;
  detail::RecordTable<MapPoint> points_;
  detail::RecordTable<Shape> shapes_;
  detail::RecordTable<Image> descriptors_;
  detail::RecordTable<PoseEdge> edges_;
  detail::ListTable<Observation> observations_;
  detail::ListTable<EdgeId> edge_lists_;
  std::size_t observation_count_ = 0;
  std::uint32_t keyframe_end_ = 0;
  std::uint32_t point_end_ = 0;
  std::uint32_t edge_end_ = 0;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_H
