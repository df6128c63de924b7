// Tables of JSON that must be refused, each with what the error says.
#ifndef GSLAM_SVAR_TESTS_JSON_REJECT_H
#define GSLAM_SVAR_TESTS_JSON_REJECT_H

#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace json_reject {

struct Case {
  const char* name;
  std::string text;
  std::string error;  // without the name of the source
};

inline std::string errorOf(const std::string& text, const gslam::JsonOptions& options) {
  try {
    gslam::parseJson(text, "JSON", options);
  } catch (const gslam::ParseError& error) {
    EXPECT_EQ(error.source(), "JSON");
    const std::string place = std::to_string(error.line()) + ":" + std::to_string(error.column());
    EXPECT_EQ(std::string(error.what()).find("JSON:" + place + ": "), 0u) << error.what();
    return std::string(error.what()).substr(5);
  }
  return "accepted";
}

template <std::size_t count>
void check(const Case (&cases)[count], const gslam::JsonOptions& options = gslam::JsonOptions()) {
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    EXPECT_EQ(errorOf(one.text, options), one.error);
    // What ends late is read faster.
    if (one.error.find("the text") != std::string::npos) continue;
    EXPECT_EQ(errorOf(one.text + std::string(32, ' '), options), one.error);
  }
}

}  // namespace json_reject

#endif  // GSLAM_SVAR_TESTS_JSON_REJECT_H
