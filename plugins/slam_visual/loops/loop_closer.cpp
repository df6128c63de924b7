#include "loops/loop_closer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "loops/loop_graph.h"
#include "loops/place_search.h"

namespace visual {

using gslam::KeyframeId;
using gslam::kNoPoint;
using gslam::PointId;
using gslam::SE3d;
using gslam::SIM3d;
using gslam::Vec3d;

namespace {

constexpr std::uint32_t kSharedByNeighbours = 15;  // points that neighbours share
constexpr std::size_t kMostAround = 20;            // keyframes of the old place
constexpr std::uint32_t kSharedOfLoop = 50;        // points of a pair across the loop that counts
constexpr double kSameDistance = 0.2;              // by how much those of one point may differ
constexpr double kWindow = 5;                      // pixels

// Features of keyframes at the new end of the loop that see points of the old one.
struct Seam {
  KeyframeId keyframe;
  std::vector<Match> matches;
};

// Closes one loop: looks at the scene as it was, and writes to the world once all is known.
class Closing {
 public:
  Closing(World& world, const Loop& loop, const Options& options)
      : world_(world), before_(world.scene()), loop_(loop), options_(options) {}

  LoopReport run();

 private:
  void correctNewEnd(LoopGraph& graph);
  void addConfirmed(std::vector<Match>& matches) const;
  void sew(const LoopGraph& graph);
  void addLoops(LoopGraph& graph) const;
  std::size_t mergePoints();
  void refreshSeam();
  void addEdge(const LoopGraph& graph);
  void moveAll(const LoopGraph& graph);
  bool isSamePoint(const Match& match, const Seam& seam, const LoopGraph& graph) const;

  World& world_;
  const Scene before_;
  const Loop& loop_;
  const Options& options_;
  std::vector<KeyframeId> new_end_;
  std::vector<Seam> seams_;
  std::set<PointId> sewn_;  // points that are seen from both ends now
};

// All that is near is moved by the same similarity: drift is small from one keyframe to the next.
void Closing::correctNewEnd(LoopGraph& graph) {
  const SE3d& T_body_camera = before_.eye.T_body_camera;
  const SIM3d S_world_here =
      SIM3d(before_.map.at(loop_.there).T_world_body) * loop_.S_there_here * SIM3d(T_body_camera);
  const SIM3d correction = S_world_here * graph.pose(loop_.here).inverse();
  new_end_.push_back(loop_.here);
  for (const gslam::Covisible& other :
       covisibleKeyframes(before_.map, loop_.here, kSharedByNeighbours)) {
    new_end_.push_back(other.keyframe);
  }
  for (const KeyframeId id : new_end_) graph.pose(id) = correction * graph.pose(id);
}

// Whether a feature's own point is as far away as the old one that it may see, too.
bool Closing::isSamePoint(const Match& match, const Seam& seam, const LoopGraph& graph) const {
  const PointId own = before_.map.pointSeen(seam.keyframe, match.feature);
  if (own == kNoPoint || own == match.point) return true;
  const SIM3d& S = graph.pose(seam.keyframe);
  const Vec3d centre = before_.T_world_camera(seam.keyframe).translation();
  const double now = S.scale() * (before_.map.at(own).position - centre).norm();
  const double then = (before_.map.at(match.point).position - S.translation()).norm();
  return std::abs(now - then) <= kSameDistance * then;
}

// What was found when the loop was, as far as it is still there, counts more than what is found
// now.
void Closing::addConfirmed(std::vector<Match>& matches) const {
  std::set<std::uint32_t> features;
  std::set<PointId> points;
  std::vector<Match> all;
  for (const Match& match : loop_.matches) {
    if (before_.map.find(match.point) == nullptr) continue;
    features.insert(match.feature);
    points.insert(match.point);
    all.push_back(match);
  }
  for (const Match& match : matches) {
    if (features.count(match.feature) == 0 && points.count(match.point) == 0) all.push_back(match);
  }
  matches.swap(all);
}

// Looks for the points of the old place in all keyframes of the new end.
void Closing::sew(const LoopGraph& graph) {
  const std::vector<PointId> points =
      pointsOf(before_, placeAround(before_, loop_.there, kMostAround));
  MatchRules rules;
  rules.most = kStrictDistance;
  rules.ratio = 0.9F;
  ProjectionMatcher projector;
  std::vector<SoughtPoint> sought;
  for (const KeyframeId id : new_end_) {
    const SE3d T_camera_world = graph.pose(id).rigid().inverse();
    sought.clear();
    findVisible(before_, T_camera_world, points, kWindow, sought);
    Seam seam = {id, projector.match(before_.view(id), before_.eye, T_camera_world, sought, rules)};
    if (id == loop_.here) addConfirmed(seam.matches);
    const auto is_other = [&](const Match& match) { return !isSamePoint(match, seam, graph); };
    seam.matches.erase(std::remove_if(seam.matches.begin(), seam.matches.end(), is_other),
                       seam.matches.end());
    seams_.push_back(std::move(seam));
  }
}

// The loop itself, and the other pairs across it that share many points by now.
void Closing::addLoops(LoopGraph& graph) const {
  const auto add = [&graph](KeyframeId from, KeyframeId to, double weight) {
    graph.edges.push_back({from, to, graph.pose(from).inverse() * graph.pose(to), weight});
  };
  add(loop_.there, loop_.here, double(loop_.matches.size()));
  const std::set<KeyframeId> new_end(new_end_.begin(), new_end_.end());
  for (const Seam& seam : seams_) {
    std::map<KeyframeId, std::uint32_t> shared;
    for (const Match& match : seam.matches) {
      for (const gslam::Observation& by : before_.map.observations(match.point)) {
        if (new_end.count(by.keyframe) == 0) ++shared[by.keyframe];
      }
    }
    for (const auto& old : shared) {
      if (old.second < kSharedOfLoop) continue;
      if (seam.keyframe == loop_.here && old.first == loop_.there) continue;
      add(old.first, seam.keyframe, double(old.second));
    }
  }
}

// The old point stays: more keyframes around it stay where they are.
std::size_t Closing::mergePoints() {
  std::size_t merged = 0;
  for (const Seam& seam : seams_) {
    for (const Match& match : seam.matches) {
      const gslam::Map& map = world_.map();
      const PointId own = map.pointSeen(seam.keyframe, match.feature);
      if (map.find(match.point) == nullptr || own == match.point) continue;
      if (featureOf(map, match.point, seam.keyframe) >= 0) continue;
      if (own == kNoPoint) {
        world_.observe(match.point, seam.keyframe, match.feature);
      } else {
        world_.merge(match.point, own);
        ++merged;
      }
      sewn_.insert(match.point);
    }
  }
  return merged;
}

void Closing::addEdge(const LoopGraph& graph) {
  gslam::PoseEdge edge;
  edge.from = loop_.there;
  edge.to = loop_.here;
  edge.T_from_to = loop_.S_there_here.rigid();
  edge.scale = loop_.S_there_here.scale();
  edge.information = informationOf<SE3d>(double(loop_.matches.size()), graph.depthAt(loop_.here));
  edge.kind = gslam::EdgeKind::loop;
  world_.addEdge(edge);
}

// Points go with the keyframe that saw them first.
void Closing::moveAll(const LoopGraph& graph) {
  std::vector<SIM3d> S_new_old(before_.facts.size());
  for (const KeyframeId id : graph.keyframes) {
    const SIM3d& S = graph.pose(id);
    S_new_old[std::uint32_t(id)] = S * SIM3d(before_.T_world_camera(id).inverse());
    if (id == graph.keyframes.front()) continue;  // stays, to the last bit
    world_.moveKeyframe(id, S.rigid() * before_.eye.T_body_camera.inverse(), S.scale());
  }
  std::vector<PointId> points;
  for (const auto& point : world_.map().points()) points.push_back(point.id);
  for (const PointId id : points) {
    const gslam::Span<const gslam::Observation> seen = world_.map().observations(id);
    if (seen.empty()) continue;
    const SIM3d& S = S_new_old[std::uint32_t(seen[0].keyframe)];
    world_.movePoint(id, S * world_.map().at(id).position);
    world_.refresh(id);
  }
}

// Who sees the same points has changed along the seam.
void Closing::refreshSeam() {
  std::set<KeyframeId> seers;
  for (const PointId id : sewn_) {
    for (const gslam::Observation& by : world_.map().observations(id)) seers.insert(by.keyframe);
  }
  for (const KeyframeId id : seers) world_.refreshNeighbours(id);
}

LoopReport Closing::run() {
  LoopReport report;
  LoopGraph graph(before_);
  if (!graph.has(loop_.here) || !graph.has(loop_.there)) {
    report.optimizer = "a keyframe of the loop is gone";
    return report;
  }
  correctNewEnd(graph);
  sew(graph);
  addLoops(graph);
  if (!graph.optimize(!before_.eye.hasDepth(), options_.mapping.backend, report.optimizer))
    return report;
  report.is_closed = true;
  report.merged = mergePoints();
  addEdge(graph);
  moveAll(graph);
  refreshSeam();
  const Vec3d was = before_.map.at(loop_.here).T_world_body.translation();
  report.moved = (world_.map().at(loop_.here).T_world_body.translation() - was).norm();
  report.stretched = graph.pose(loop_.here).scale();
  return report;
}

}  // namespace

LoopReport closeLoop(World& world, const Loop& loop, const Options& options) {
  return Closing(world, loop, options).run();
}

}  // namespace visual
