// A list of JSON that is written while it grows.
#ifndef GSLAM_APPS_JSON_LIST_H
#define GSLAM_APPS_JSON_LIST_H

#include <gslam/svar/json.h>

#include <iostream>

namespace app {

/// Writes `[`, elements, one a line, and `]` to stdout: however many there are, none is kept.
class JsonList {
 public:
  void add(const gslam::Svar& element) {
    std::cout << (is_empty_ ? "[\n" : ",\n") << gslam::printJson(element);
    is_empty_ = false;
  }
  void end() { std::cout << (is_empty_ ? "[]\n" : "\n]\n"); }

 private:
  bool is_empty_ = true;
};

}  // namespace app

#endif  // GSLAM_APPS_JSON_LIST_H
