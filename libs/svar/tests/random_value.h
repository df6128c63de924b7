// Random values for tests of properties; the same ones from the same seed everywhere.
#ifndef GSLAM_SVAR_TESTS_RANDOM_VALUE_H
#define GSLAM_SVAR_TESTS_RANDOM_VALUE_H

#include <gslam/svar.h>

#include <cstdint>
#include <random>
#include <string>

class RandomValues {
 public:
  explicit RandomValues(unsigned seed) : engine_(seed) {}

  // From 0 on, below `end`. (The standard's distributions differ between libraries.)
  int below(int end) { return static_cast<int>(engine_() % static_cast<unsigned>(end)); }

  std::string name() {
    static const char* const names[] = {
        "a", "b", "a.b", "a/b", "~", "~1", "", "0", "1", "-", "/", ".", "long name of a member"};
    return names[below(13)];
  }

  // Arrays and objects are not deeper than that.
  gslam::Svar value(int depth) {
    switch (below(depth > 0 ? 10 : 6)) {
      case 0:
        return nullptr;
      case 1:
        return below(2) == 0;
      case 2:
      case 3:
        return below(3);
      case 4:
        return below(3) / 2.0;
      case 5:
        return name();
      case 6:
      case 7:
        return array(depth);
      default:
        return object(depth);
    }
  }

  gslam::Svar array(int depth) {
    gslam::Svar made = gslam::Svar::array();
    for (int i = below(6); i > 0; --i) made.push_back(value(depth - 1));
    return made;
  }

  gslam::Svar object(int depth) {
    gslam::Svar made = gslam::Svar::object();
    for (int i = below(6); i > 0; --i) {
      made.set("/" + gslam::detail::escapeName(name()), value(depth - 1));
    }
    return made;
  }

 private:
  std::mt19937 engine_;
};

#endif  // GSLAM_SVAR_TESTS_RANDOM_VALUE_H
