// Uses every function of GSLAM::svar_formats; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/svar_formats.h>

#include <string>
#include <vector>

#if __cplusplus >= 201703L
#include <string_view>
#endif

bool instantiateSvarFormats(const std::string& text, const std::string& path);

bool instantiateSvarFormats(const std::string& text, const std::string& path) {
  gslam::YamlOptions yaml;
  yaml.allow_duplicate_names = true;
  gslam::XmlOptions xml;
  xml.max_depth = 10;
  std::vector<gslam::Svar> values = gslam::parseYamlDocuments(text, "text", yaml);
  values.push_back(gslam::parseYaml(text));
  values.push_back(gslam::parseXml(text, "text", xml));
#if __cplusplus >= 201703L
  values.push_back(gslam::parseYaml(std::string_view(text)));
#endif
  gslam::saveYaml(path, values.front());
  gslam::saveXml(path, values.back());
  return gslam::loadYaml(path, yaml) == gslam::loadXml(path, xml) &&
         gslam::loadYamlDocuments(path, yaml).empty() &&
         gslam::printYaml(values.front()) == gslam::printXml(values.back());
}
