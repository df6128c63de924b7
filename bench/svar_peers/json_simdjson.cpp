// Its parser is kept from text to text, as its authors advise. It prints from the parsed tape.
#include "json.h"

#include <simdjson.h>

namespace {

class Simdjson {
 public:
  void parse(const std::string& text) {
    simdjson::dom::element value;
    if (parser_.parse(text).get(value) != simdjson::SUCCESS) std::abort();
    benchmark::DoNotOptimize(value);
  }
  void keep(const std::string& text) { value_ = parser_.parse(text).value(); }
  std::size_t print() {
    const std::string text = simdjson::minify(value_);
    benchmark::DoNotOptimize(text.data());
    return text.size();
  }

 private:
  simdjson::dom::parser parser_;
  simdjson::dom::element value_;
};

const bool kMeasured = measure<Simdjson>("simdjson");

}  // namespace
