// With the flags that make it do what the others do: check UTF-8, round correctly.
#include "json.h"

#include <rapidjson/document.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

namespace {

class RapidJson {
 public:
  void parse(const std::string& text) {
    rapidjson::Document value;
    parse(text, value);
    benchmark::DoNotOptimize(value.IsArray());
  }
  void keep(const std::string& text) { parse(text, value_); }
  std::size_t print() {
    rapidjson::StringBuffer buffer;
    rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
    value_.Accept(writer);
    benchmark::DoNotOptimize(buffer.GetString());
    return buffer.GetSize();
  }

 private:
  static void parse(const std::string& text, rapidjson::Document& value) {
    constexpr unsigned flags =
        rapidjson::kParseFullPrecisionFlag | rapidjson::kParseValidateEncodingFlag;
    value.Parse<flags>(text.data(), text.size());
  }

  rapidjson::Document value_;
};

const bool kMeasured = measure<RapidJson>("rapidjson");

}  // namespace
