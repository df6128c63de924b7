// From YAML text to values. What yaml.h says of parseYaml() and loadYaml() is done here.
#include <gslam/svar_formats/yaml.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <utility>

#include "yaml_builder.h"

namespace gslam {
namespace formats {
namespace {

std::vector<Svar> readYaml(detail::Text text, const std::string& name, const YamlOptions& options,
                           bool one) {
  const SourceText source(text, name);
  const YamlText yaml(source);
  YamlBuilder builder(yaml, options, one);
  const auto offset_of = [&yaml](const YAML::Mark& mark) {
    return mark.pos < 0 ? yaml.text().size() : static_cast<std::size_t>(mark.pos);
  };
  try {
    std::istringstream stream(yaml.text());
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::DeepRecursion& error) {
    yaml.fail(offset_of(error.mark),
              "expected at most 490 arrays and objects inside one another, found more");
  } catch (const YAML::Exception& error) {
    yaml.fail(offset_of(error.mark), "cannot be read as YAML: " + error.msg);
  }
  if (one && builder.documents().empty()) {
    yaml.fail(yaml.text().size(), "expected a document, found nothing");
  }
  return std::move(builder.documents());
}

}  // namespace
}  // namespace formats

inline namespace v1 {

Svar parseYaml(detail::Text text, const std::string& source, const YamlOptions& options) {
  return std::move(formats::readYaml(text, source, options, true).front());
}

std::vector<Svar> parseYamlDocuments(detail::Text text, const std::string& source,
                                     const YamlOptions& options) {
  return formats::readYaml(text, source, options, false);
}

Svar loadYaml(const std::string& path, const YamlOptions& options) {
  return parseYaml(detail::readFile(path), path, options);
}

std::vector<Svar> loadYamlDocuments(const std::string& path, const YamlOptions& options) {
  return parseYamlDocuments(detail::readFile(path), path, options);
}

}  // namespace v1
}  // namespace gslam
