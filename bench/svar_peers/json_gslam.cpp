#include <gslam/svar/json.h>

#include "json.h"

namespace {

class Gslam {
 public:
  void parse(const std::string& text) { benchmark::DoNotOptimize(gslam::parseJson(text)); }
  void keep(const std::string& text) { value_ = gslam::parseJson(text); }
  std::size_t print() {
    const std::string text = gslam::printJson(value_);
    benchmark::DoNotOptimize(text.data());
    return text.size();
  }

 private:
  gslam::Svar value_;
};

const bool kMeasured = measure<Gslam>("gslam");

}  // namespace
