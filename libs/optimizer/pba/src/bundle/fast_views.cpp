#include "bundle/fast_views.h"

#include <algorithm>

#include "factors/reprojection.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

constexpr std::size_t kPairGrain = std::size_t(1) << 16;  // observations

bool isFlagSet(Span<const std::uint8_t> flags, std::size_t i) {
  return !flags.empty() && flags[i] != 0;
}

bool isIdentity(const SE3d& pose) {
  const double* const d = pose.data();
  return d[0] == 0 && d[1] == 0 && d[2] == 0 && d[4] == 0 && d[5] == 0 && d[6] == 0;
}

// Pairs of a pose and a camera, each once; few cameras see from one pose.
class PairFinder {
 public:
  explicit PairFinder(std::size_t poses) : first_(poses, kNoBlock) {}

  void add(std::uint32_t pose, std::uint32_t camera) {
    std::uint32_t* link = &first_[pose];
    while (*link != kNoBlock) {
      if ((found_[*link] & 0xffffffffU) == camera) return;
      link = &next_[*link];
    }
    *link = static_cast<std::uint32_t>(found_.size());
    next_.push_back(kNoBlock);
    found_.push_back((std::uint64_t(pose) << 32) | camera);
  }
  const std::vector<std::uint64_t>& found() const { return found_; }

 private:
  std::vector<std::uint32_t> first_, next_;
  std::vector<std::uint64_t> found_;
};

std::vector<std::uint64_t> findPairs(const BundleProblem& problem, unsigned threads) {
  using Pairs = std::vector<std::uint64_t>;
  Pairs pairs = parallelReduce(
      0, problem.pixels.size(), Pairs(),
      [&](std::size_t first, std::size_t last) {
        PairFinder finder(problem.T_world_body.size());
        for (std::size_t k = first; k < last; ++k) {
          finder.add(problem.observation_pose[k], cameraOfObservation(problem, k));
        }
        return finder.found();
      },
      [](Pairs all, const Pairs& found) {
        all.insert(all.end(), found.begin(), found.end());
        return all;
      },
      // Each part has a table of all poses.
      fastParallel(std::max(kPairGrain, problem.T_world_body.size()), threads));
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// Blocks in the order of their poses, so that neighbours in a sequence stay neighbours.
void makeBlocks(const BundleProblem& problem, FastStructure& structure) {
  for (FastView& view : structure.views) {
    const bool is_pose_free = !isFlagSet(problem.pose_fixed, view.pose);
    if (!is_pose_free && !view.has_free_camera) continue;
    if (structure.blocks.empty() || structure.blocks.back().pose != view.pose) {
      structure.blocks.push_back({view.pose, kNoBlock, is_pose_free});
    }
    view.block = static_cast<std::uint32_t>(structure.blocks.size()) - 1;
    if (!view.has_free_camera) continue;
    structure.blocks.back().camera = view.camera;
    structure.freedom = 9;
  }
}

// Whether a view sees a point at the start.
class StartCheck {
 public:
  StartCheck(const BundleProblem& problem, const FastStructure& structure)
      : problem_(problem), structure_(structure) {
    T_camera_world_.reserve(structure.views.size());
    for (const FastView& view : structure.views) {
      const SE3d& pose = problem.T_world_body[view.pose];
      T_camera_world_.push_back(
          (problem.T_body_camera.empty() ? pose : pose * problem.T_body_camera[view.camera])
              .inverse());
    }
  }
  bool isSeen(std::size_t number, const Vec3d& point) const {
    const FastView& view = structure_.views[number];
    const Vec3d local = T_camera_world_[number] * point;
    if (view.is_plain) return local[2] != 0;
    Vec2d pixel;
    return projectEverywhere(problem_.cameras[view.camera], local, pixel);
  }

 private:
  const BundleProblem& problem_;
  const FastStructure& structure_;
  std::vector<SE3d> T_camera_world_;
};

// The first view of each pose.
std::vector<std::uint32_t> firstViews(const BundleProblem& problem,
                                      const FastStructure& structure) {
  std::vector<std::uint32_t> first(problem.T_world_body.size(), 0);
  for (std::size_t i = structure.views.size(); i-- > 0;) {
    first[structure.views[i].pose] = static_cast<std::uint32_t>(i);
  }
  return first;
}

}  // namespace

void makeViews(const BundleProblem& problem, unsigned threads, FastStructure& structure) {
  for (const std::uint64_t pair : findPairs(problem, threads)) {
    FastView view;
    view.pose = static_cast<std::uint32_t>(pair >> 32);
    view.camera = static_cast<std::uint32_t>(pair & 0xffffffffU);
    view.is_plain = isPlainCamera(problem.cameras[view.camera]);
    view.has_free_camera = isCameraFree(problem, view.camera);
    if (!view.is_plain) structure.all_plain = false;
    if (!problem.T_body_camera.empty() && !isIdentity(problem.T_body_camera[view.camera])) {
      structure.has_rig = true;
    }
    structure.views.push_back(view);
  }
  makeBlocks(problem, structure);
  for (const FastView& view : structure.views) structure.block_of_view.push_back(view.block);
}

RawVector<std::uint32_t> viewOfObservations(const BundleProblem& problem, unsigned threads,
                                            FastStructure& structure,
                                            std::vector<std::atomic<std::uint32_t>>& seen_by) {
  const StartCheck check(problem, structure);
  const std::vector<std::uint32_t> first_view = firstViews(problem, structure);
  RawVector<std::uint32_t> view_of(problem.pixels.size());
  structure.left_out = parallelReduce(
      0, view_of.size(), std::size_t(0),
      [&](std::size_t first, std::size_t last) {
        std::size_t left_out = 0;
        for (std::size_t k = first; k < last; ++k) {
          const std::uint32_t camera = cameraOfObservation(problem, k);
          std::uint32_t view = first_view[problem.observation_pose[k]];
          while (structure.views[view].camera != camera) ++view;
          const std::uint32_t point = problem.observation_point[k];
          const bool is_seen = check.isSeen(view, problem.points[point]);
          view_of[k] = is_seen ? view : kNoBlock;
          if (is_seen) {
            seen_by[point].fetch_add(1, std::memory_order_relaxed);
          } else {
            ++left_out;
          }
        }
        return left_out;
      },
      [](std::size_t sum, std::size_t part) { return sum + part; },
      fastParallel(kPairGrain, threads));
  return view_of;
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
