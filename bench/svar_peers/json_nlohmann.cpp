#include <nlohmann/json.hpp>

#include "json.h"

namespace {

class Nlohmann {
 public:
  void parse(const std::string& text) { benchmark::DoNotOptimize(nlohmann::json::parse(text)); }
  void keep(const std::string& text) { value_ = nlohmann::json::parse(text); }
  std::size_t print() {
    const std::string text = value_.dump();
    benchmark::DoNotOptimize(text.data());
    return text.size();
  }

 private:
  nlohmann::json value_;
};

const bool kMeasured = measure<Nlohmann>("nlohmann");

}  // namespace
