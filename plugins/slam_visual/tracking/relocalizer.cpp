#include "tracking/relocalizer.h"

#include <algorithm>

#include "loops/place_search.h"

namespace visual {

using gslam::KeyframeId;
using gslam::SE3d;

namespace {

constexpr std::size_t kMostPlaces = 15;
constexpr std::size_t kMostOfOldPlace = 15;  // of a place
constexpr std::size_t kLeastMatched = 15;    // matches by descriptors alone

// Points that have nothing to do with the view find a feature that looks like them now and then:
// in a window of a few pixels some ten of a thousand points do, and on the same thing in another
// place many more, but these in one part of the image.
constexpr std::size_t kFewMatches = 15;  // where it was expected
constexpr std::size_t kMostNearby = 5;   // keyframes that are matched by descriptors alone
constexpr std::size_t kManyMatches = 50;
constexpr std::size_t kEnoughMatches = 30;
constexpr int kLeastPartsOfMany = 6;
constexpr int kLeastPartsOfEnough = 12;

bool isSure(const View& view, const Eye& eye, const std::vector<Match>& matches) {
  if (matches.size() < kEnoughMatches) return false;
  const int least = matches.size() >= kManyMatches ? kLeastPartsOfMany : kLeastPartsOfEnough;
  return partsOfImage(view, eye, matches) >= least;
}

}  // namespace

Relocalizer::Relocalizer(const Options& options, const PlaceIndex& places)
    : options_(options), places_(places) {}

bool Relocalizer::locate(const View& view, const Scene& scene, const Guess* guess,
                         std::vector<Match>& matches, SE3d& T_world_body) {
  matches.clear();
  if (view.size() == 0) return false;
  if (guess != nullptr && locateNear(view, scene, *guess, matches, T_world_body)) return true;
  matches.clear();
  std::vector<Match> found;
  std::vector<KeyframeId> known;  // places that were found: their keyframes say the same
  std::size_t tried = 0;
  for (const SimilarPlace& similar : places_.similar(view, kMostPlaces)) {
    // The index may be ahead of the scene, or behind it.
    if (scene.map.find(similar.keyframe) == nullptr) continue;
    if (std::find(known.begin(), known.end(), similar.keyframe) != known.end()) continue;
    if (++tried > kMostPlaces) break;
    SE3d pose;
    if (!locateAt(view, scene, similar.keyframe, found, pose)) continue;
    const std::vector<KeyframeId> place = placeAround(scene, similar.keyframe, kMostOfOldPlace);
    known.insert(known.end(), place.begin(), place.end());
    if (found.size() <= matches.size()) continue;
    matches.swap(found);
    T_world_body = pose;
  }
  return !matches.empty();
}

// What it saw last may be far away by now, so that little of it is found; but then it says the same
// as the motion did.
bool Relocalizer::locateNear(const View& view, const Scene& scene, const Guess& guess,
                             std::vector<Match>& matches, SE3d& T_world_body) {
  std::vector<bool> is_taken(view.size(), false);
  for (const KeyframeId id : placeAround(scene, guess.reference, kMostNearby)) {
    for (const Match& match : matchKeyframe(view, scene, id, {kStrictDistance, 0.8F})) {
      if (!is_taken[match.feature]) matches.push_back(match);
      is_taken[match.feature] = true;
    }
  }
  if (!fitter_.find(view, scene, matches, options_.seed, T_world_body)) return false;
  const std::vector<KeyframeId> place = placeAround(scene, guess.reference, kMostOfOldPlace);
  if (!searchPlace(view, scene, pointsOf(scene, place), projector_, fitter_, matches,
                   T_world_body)) {
    return false;
  }
  const double off = (T_world_body.translation() - guess.T_world_body.translation()).norm();
  return matches.size() >= kFewMatches && off <= guess.within;
}

bool Relocalizer::locateAt(const View& view, const Scene& scene, KeyframeId keyframe,
                           std::vector<Match>& matches, SE3d& T_world_body) {
  matches = matchKeyframe(view, scene, keyframe, {kStrictDistance, 0.8F});
  if (matches.size() < kLeastMatched) return false;
  if (!fitter_.find(view, scene, matches, options_.seed, T_world_body)) return false;
  const std::vector<KeyframeId> place = placeAround(scene, keyframe, kMostOfOldPlace);
  return searchPlace(view, scene, pointsOf(scene, place), projector_, fitter_, matches,
                     T_world_body) &&
         isSure(view, scene.eye, matches);
}

}  // namespace visual
