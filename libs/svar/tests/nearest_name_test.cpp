// Which name was most likely meant.
#include <gslam/svar/detail/nearest_name.h>
#include <gtest/gtest.h>

#include <string>

namespace {

using gslam::detail::editDistance;
using gslam::detail::nearestName;

// Tries all first steps: right, and slow.
std::size_t distanceByDefinition(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a.size() + b.size();
  const std::string c = a.substr(1);
  const std::string d = b.substr(1);
  std::size_t least = distanceByDefinition(c, d) + (a[0] == b[0] ? 0 : 1);
  least = std::min(least, 1 + std::min(distanceByDefinition(c, b), distanceByDefinition(a, d)));
  if (a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0]) {
    least = std::min(least, 1 + distanceByDefinition(a.substr(2), b.substr(2)));
  }
  return least;
}

TEST(EditDistance, IsThatOfItsDefinition) {
  const std::string letters = "ab";
  std::vector<std::string> words = {""};
  for (std::size_t i = 0; i < words.size() && words[i].size() < 4; ++i) {
    for (const char c : letters) words.push_back(words[i] + c);
  }
  for (const std::string& a : words) {
    for (const std::string& b : words) EXPECT_EQ(editDistance(a, b), distanceByDefinition(a, b));
  }
}

TEST(NearestName, IsNearOrNone) {
  const std::vector<std::string> names = {"fps", "features", "realtime", "camera.fx"};
  EXPECT_EQ(nearestName("fsp", names), "fps");
  EXPECT_EQ(nearestName("feature", names), "features");
  EXPECT_EQ(nearestName("raeltmie", names), "realtime");
  EXPECT_EQ(nearestName("camera.fz", names), "camera.fx");
  EXPECT_EQ(nearestName("xyz", names), "");
  EXPECT_EQ(nearestName("", names), "");
  EXPECT_EQ(nearestName(std::string(100000, 'f'), names), "");
  EXPECT_EQ(nearestName("fps", {}), "");
}

}  // namespace
