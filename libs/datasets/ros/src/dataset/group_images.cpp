#include "group_images.h"

#include <gslam/core/associate.h>

#include <algorithm>

namespace gslam {
inline namespace v1 {
namespace ros {

std::vector<ImageGroup> groupImages(const std::vector<std::vector<std::int64_t>>& stamps,
                                    std::int64_t tolerance) {
  std::vector<ImageGroup> groups;
  for (std::size_t camera = 0; camera < stamps.size(); ++camera) {
    std::vector<std::int64_t> known;
    for (const ImageGroup& group : groups) known.push_back(group.stamp);
    std::vector<char> is_taken(stamps[camera].size());
    for (const StampPair& pair : associate(known, stamps[camera], tolerance)) {
      groups[pair.a].images[camera] = pair.b;
      is_taken[pair.b] = 1;
    }
    for (std::size_t i = 0; i < stamps[camera].size(); ++i) {
      if (is_taken[i] != 0) continue;
      ImageGroup group;
      group.stamp = stamps[camera][i];
      group.images.assign(stamps.size(), kNoImage);
      group.images[camera] = i;
      groups.push_back(group);
    }
    std::sort(groups.begin(), groups.end(),
              [](const ImageGroup& a, const ImageGroup& b) { return a.stamp < b.stamp; });
  }
  return groups;
}

bool isDense(const std::vector<std::int64_t>& stamps, std::int64_t tolerance) noexcept {
  constexpr std::size_t kMost = 1000;
  for (std::size_t i = kMost; i < stamps.size(); ++i) {
    const auto first = static_cast<std::uint64_t>(stamps[i - kMost]);
    const std::uint64_t apart = static_cast<std::uint64_t>(stamps[i]) - first;
    if (apart <= static_cast<std::uint64_t>(tolerance)) return true;
  }
  return false;
}

bool isComplete(const ImageGroup& group) noexcept {
  return std::find(group.images.begin(), group.images.end(), kNoImage) == group.images.end();
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
