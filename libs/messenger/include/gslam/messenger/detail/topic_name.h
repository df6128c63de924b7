// Names of topics, and patterns that name many.
#ifndef GSLAM_MESSENGER_DETAIL_TOPIC_NAME_H
#define GSLAM_MESSENGER_DETAIL_TOPIC_NAME_H

#include <gslam/base/error.h>

#include <cstddef>
#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

inline bool isWordCharacter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// The name with its first slash, in the name space where it has none.
/// @param space     "" or such as "/orb"
/// @param wildcards whether parts may hold *
/// @throws ArgumentError for anything but words of letters, digits and _, with single slashes
///         between
inline std::string topicName(const std::string& space, const std::string& topic,
                             bool wildcards = false) {
  std::string name = !topic.empty() && topic[0] == '/' ? topic : space + "/" + topic;
  bool part_begins = true;
  bool good = name.size() > 1;
  for (std::size_t i = 1; i < name.size(); ++i) {
    const bool word = isWordCharacter(name[i]) || (wildcards && name[i] == '*');
    good = good && (word || (name[i] == '/' && !part_begins));
    part_begins = name[i] == '/';
  }
  if (good && !part_begins) return name;
  throw ArgumentError("topic", "is \"" + topic +
                                   "\", expected a name such as /sensor/imu, of letters, digits, _ "
                                   "and single slashes");
}

/// Whether a name is one of those that a pattern means: * stands for any characters but slashes,
/// ** for any.
inline bool matchesPattern(const std::string& pattern, const std::string& name) {
  struct Star {
    std::size_t after;  // where the pattern goes on; 0: there was none
    std::size_t end;    // where it ends in the name, for now
  };
  Star one = {0, 0};
  Star two = {0, 0};
  std::size_t p = 0;
  for (std::size_t n = 0; n < name.size() || p < pattern.size();) {
    const bool star = p < pattern.size() && pattern[p] == '*';
    if (star && pattern.compare(p, 2, "**") == 0) {
      p += 2;
      two = {p, n};
      one = {0, 0};
    } else if (star) {
      ++p;
      one = {p, n};
    } else if (p < pattern.size() && n < name.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (one.after != 0 && one.end < name.size() && name[one.end] != '/') {
      p = one.after;  // the star takes one character more
      n = ++one.end;
    } else if (two.after != 0 && two.end < name.size()) {
      p = two.after;
      n = ++two.end;
      one = {0, 0};
    } else {
      return false;
    }
  }
  return true;
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_TOPIC_NAME_H
