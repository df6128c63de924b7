#include "loops/loop_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "loops/loop_check.h"
#include "loops/place_search.h"

namespace visual {

using gslam::Covisible;
using gslam::KeyframeId;
using gslam::SE3d;

namespace {

constexpr std::uint32_t kFewKeyframes = 10;  // from one loop to the next, and to what is near
constexpr std::uint32_t kNeighbour = 15;     // points that neighbours share
constexpr std::uint32_t kConnected = 5;      // points of places that the map knows to be near
constexpr double kNearBest = 0.75;           // of the score of the best place
constexpr std::size_t kMostCandidates = 5;
constexpr std::size_t kMostOfPlace = 10;  // keyframes whose scores count, and points
constexpr std::size_t kMostMatched = 6;   // keyframes that are matched by descriptors alone
constexpr std::size_t kLeastAlike = 20;   // matches by descriptors alone
constexpr int kLeastParts = 8;            // of the image, 36 in all

// A keyframe with the scores of its place.
struct Candidate {
  double sum;
  KeyframeId best;
};

// What the map knows to be near: what sees the same points, and what sees those of its neighbours.
std::vector<bool> connectedTo(const Scene& scene, KeyframeId keyframe,
                              const std::vector<Covisible>& around) {
  std::vector<bool> is_connected(scene.facts.size(), false);
  const std::uint32_t number = std::uint32_t(keyframe);
  for (std::uint32_t i = 0; i < is_connected.size(); ++i) {
    is_connected[i] = i + kFewKeyframes > number;
  }
  for (const Covisible& near : around) {
    if (near.shared >= kConnected) is_connected[std::uint32_t(near.keyframe)] = true;
    if (near.shared < kNeighbour) continue;
    for (const Covisible& next : scene.neighbours(near.keyframe)) {
      is_connected[std::uint32_t(next.keyframe)] = true;
    }
  }
  return is_connected;
}

}  // namespace

LoopDetector::LoopDetector(const Options& options, const PlaceIndex& places)
    : options_(options), places_(places) {}

void LoopDetector::reset() {
  trails_.clear();
}

std::optional<Loop> LoopDetector::detect(const Scene& scene, KeyframeId keyframe) {
  if (std::uint32_t(keyframe) < closed_at_) closed_at_ = 0;  // of another map
  if (!places_.hasVocabulary() || std::uint32_t(keyframe) < closed_at_ + kFewKeyframes) {
    trails_.clear();
    return std::nullopt;
  }
  std::optional<Loop> best;
  for (const KeyframeId there : consistent(scene, candidates(scene, keyframe))) {
    std::optional<Loop> loop = confirm(scene, keyframe, there);
    if (loop && (!best || loop->matches.size() > best->matches.size())) best = std::move(loop);
  }
  if (best) {
    closed_at_ = std::uint32_t(keyframe);
    trails_.clear();
  }
  return best;
}

// Places that look more like the keyframe than the least similar of its neighbours does: this is
// how similar the same place looks here. The scores of a place add up, so that it is not one
// picture that decides.
std::vector<KeyframeId> LoopDetector::candidates(const Scene& scene, KeyframeId keyframe) const {
  std::vector<double> scores(scene.facts.size(), 0);
  for (const SimilarPlace& similar :
       places_.similar(scene.view(keyframe), std::numeric_limits<std::size_t>::max())) {
    const std::uint32_t number = std::uint32_t(similar.keyframe);
    if (scene.map.find(similar.keyframe) != nullptr) scores[number] = similar.score;
  }
  const std::vector<Covisible> around = covisibleKeyframes(scene.map, keyframe);
  double least = 1;
  for (const Covisible& near : around) {
    if (near.shared >= kNeighbour) least = std::min(least, scores[std::uint32_t(near.keyframe)]);
  }
  const std::vector<bool> is_connected = connectedTo(scene, keyframe, around);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (is_connected[i] || !(scores[i] > least)) scores[i] = 0;
  }

  std::vector<Candidate> places;
  double most = 0;
  for (std::uint32_t i = 0; i < scores.size(); ++i) {
    if (!(scores[i] > 0)) continue;
    Candidate place = {0, KeyframeId(i)};
    for (const KeyframeId id : placeAround(scene, KeyframeId(i), kMostOfPlace)) {
      const double score = scores[std::uint32_t(id)];
      place.sum += score;
      if (score > scores[std::uint32_t(place.best)]) place.best = id;
    }
    most = std::max(most, place.sum);
    places.push_back(place);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Candidate& a, const Candidate& b) { return a.sum > b.sum; });
  std::vector<KeyframeId> found;
  for (const Candidate& place : places) {
    if (place.sum < kNearBest * most || found.size() == kMostCandidates) break;
    if (std::find(found.begin(), found.end(), place.best) == found.end()) {
      found.push_back(place.best);
    }
  }
  return found;
}

// Those that the keyframes before looked like, too.
std::vector<KeyframeId> LoopDetector::consistent(const Scene& scene,
                                                 const std::vector<KeyframeId>& candidates) {
  std::vector<KeyframeId> found;
  std::vector<Trail> trails;
  for (const KeyframeId candidate : candidates) {
    Trail trail;
    trail.group = placeAround(scene, candidate, scene.facts.size());
    std::sort(trail.group.begin(), trail.group.end());
    for (const Trail& before : trails_) {
      const bool is_same =
          std::any_of(before.group.begin(), before.group.end(), [&](KeyframeId id) {
            return std::binary_search(trail.group.begin(), trail.group.end(), id);
          });
      if (is_same) trail.length = std::max(trail.length, before.length);
    }
    ++trail.length;
    if (trail.length >= options_.loop.consistent) found.push_back(candidate);
    trails.push_back(std::move(trail));
  }
  trails_ = std::move(trails);
  return found;
}

std::optional<Loop> LoopDetector::confirm(const Scene& scene, KeyframeId here, KeyframeId there) {
  const View& view = scene.view(here);
  const std::vector<KeyframeId> place = placeAround(scene, there, kMostOfPlace);
  std::vector<Match> matches;
  std::vector<bool> is_taken(view.size(), false);
  for (std::size_t i = 0; i < std::min(place.size(), kMostMatched); ++i) {
    for (const Match& match : matchKeyframe(view, scene, place[i], {kStrictDistance, 0.8F})) {
      if (!is_taken[match.feature]) matches.push_back(match);
      is_taken[match.feature] = true;
    }
  }
  if (matches.size() < kLeastAlike) return std::nullopt;

  SE3d pose;
  const std::uint64_t seed = options_.seed + std::uint32_t(here);
  if (!fitter_.find(view, scene, matches, seed, pose)) return std::nullopt;
  if (!searchPlace(view, scene, pointsOf(scene, place), projector_, fitter_, matches, pose)) {
    return std::nullopt;
  }
  if (matches.size() < std::size_t(options_.loop.least_matches) ||
      partsOfImage(view, scene.eye, matches) < kLeastParts) {
    return std::nullopt;
  }
  LoopGeometry geometry = {here, there, pose, 1};
  if (!checkLoop(scene, place, matches, geometry)) return std::nullopt;
  return Loop{here, there, geometry.S_there_here(scene), std::move(matches)};
}

}  // namespace visual
