#include "frame_tree.h"

#include <gslam/base/error.h>

#include <cmath>
#include <set>

#include "messages/decode.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

std::string plain(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

// Up to rounding: publishers write the same transform again.
bool isSame(const SE3d& a, const SE3d& b) {
  return (a.inverse() * b).log().norm() < 1e-9;
}

}  // namespace

void FrameTree::add(const std::string& parent, const std::string& child,
                    const SE3d& T_parent_child) {
  neighbours_[plain(parent)].emplace_back(plain(child), T_parent_child);
  neighbours_[plain(child)].emplace_back(plain(parent), T_parent_child.inverse());
}

void FrameTree::addTopics(const Recording& recording, const std::vector<std::size_t>& topics,
                          reading::Remarks& remarks) {
  std::map<std::pair<std::string, std::string>, SE3d> latest;  // which counts, as in tf
  for (const MessageRef& ref : recording.messages(topics)) {
    for (const TransformStamped& one : readMessage<TfMessage>(recording, ref).transforms) {
      const Triple& t = one.transform.position;
      const Quadruple& q = one.transform.orientation;
      try {
        const SE3d pose(SO3d::fromQuaternion(q[0], q[1], q[2], q[3]), {t[0], t[1], t[2]});
        if (!std::isfinite(t[0] + t[1] + t[2])) throw ArgumentError("translation", "is not finite");
        const auto added = latest.emplace(
            std::make_pair(plain(one.header.frame_id), plain(one.child_frame_id)), pose);
        if (added.second) continue;
        if (!isSame(added.first->second, pose)) {
          remarks.say("the static transform of " + one.header.frame_id + " to " +
                      one.child_frame_id + " changes: the last one was taken");
        }
        added.first->second = pose;
      } catch (const ArgumentError& error) {
        remarks.skip("static transforms that are none",
                     one.header.frame_id + " to " + one.child_frame_id + ": " + error.what());
      }
    }
  }
  for (const auto& one : latest) add(one.first.first, one.first.second, one.second);
}

bool FrameTree::find(const std::string& a, const std::string& b, SE3d& T_a_b) const {
  const std::string wanted = plain(b);
  std::vector<std::pair<std::string, SE3d>> queue = {{plain(a), SE3d()}};
  std::set<std::string> seen = {plain(a)};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::pair<std::string, SE3d> here = queue[i];
    if (here.first == wanted) {
      T_a_b = here.second;
      return true;
    }
    const auto found = neighbours_.find(here.first);
    if (found == neighbours_.end()) continue;
    for (const auto& next : found->second) {
      if (seen.insert(next.first).second) {
        queue.emplace_back(next.first, here.second * next.second);
      }
    }
  }
  return false;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
