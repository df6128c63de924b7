// Any bytes are a pose graph whose indices are there, or are refused with a ParseError.
#include <gslam/base/error.h>
#include <gslam/optimizer/files/toro.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace {

struct CheckGraph {
  template <class Group>
  void operator()(const gslam::PoseGraph<Group>& graph) const {
    const std::size_t n = graph.from.size(), poses = graph.T_world_body.size();
    bool is_right = graph.to.size() == n && graph.T_from_to.size() == n;
    is_right = is_right && graph.information.size() == n && graph.ids.size() == poses;
    is_right = is_right && (graph.pose_fixed.empty() || graph.pose_fixed.size() == poses);
    for (std::size_t i = 0; is_right && i < n; ++i) {
      is_right = graph.from[i] < poses && graph.to[i] < poses && graph.from[i] != graph.to[i];
    }
    if (!is_right) std::abort();
  }
};

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    std::visit(CheckGraph(), gslam::parseToro(text, "fuzz"));
  } catch (const gslam::ParseError&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
