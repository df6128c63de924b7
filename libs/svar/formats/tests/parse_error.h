// Tables of texts that must be refused, each with what the error says.
#ifndef GSLAM_SVAR_FORMATS_TESTS_PARSE_ERROR_H
#define GSLAM_SVAR_FORMATS_TESTS_PARSE_ERROR_H

#include <gslam/svar_formats.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace parse_error {

struct Case {
  const char* name;
  std::string text;
  std::string error;  // without the name of the source
};

// A literal with all its bytes, zero bytes among them.
template <std::size_t size>
std::string bytes(const char (&text)[size]) {
  return std::string(text, size - 1);
}

template <class F>
std::string errorOf(F parse) {
  try {
    parse();
  } catch (const gslam::ParseError& error) {
    const std::string place = error.source() + ":" + std::to_string(error.line()) + ":" +
                              std::to_string(error.column()) + ": ";
    EXPECT_EQ(std::string(error.what()).find(place), 0u) << error.what();
    EXPECT_GT(error.line(), 0u);
    EXPECT_GT(error.column(), 0u);
    return std::string(error.what()).substr(error.source().size() + 1);
  } catch (const gslam::Error& error) {
    return error.what();
  }
  return "accepted";
}

inline std::string yamlError(const std::string& text,
                             const gslam::YamlOptions& options = gslam::YamlOptions()) {
  return errorOf([&] { gslam::parseYaml(text, "YAML", options); });
}

inline std::string xmlError(const std::string& text,
                            const gslam::XmlOptions& options = gslam::XmlOptions()) {
  return errorOf([&] { gslam::parseXml(text, "XML", options); });
}

}  // namespace parse_error

#endif  // GSLAM_SVAR_FORMATS_TESTS_PARSE_ERROR_H
