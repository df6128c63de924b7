#include <gslam/svar/json.h>
#include <gslam/svar_formats/files.h>
#include <gslam/svar_formats/xml.h>
#include <gslam/svar_formats/yaml.h>

namespace gslam {
inline namespace v1 {

void addFileFormats() {
  detail::FileFormats& formats = detail::FileFormats::ofProgram();
  const auto load_yaml = [](const std::string& path) { return loadYaml(path); };
  const auto save_yaml = [](const std::string& path, const Svar& value) { saveYaml(path, value); };
  formats.add({".yaml", load_yaml, save_yaml});
  formats.add({".yml", load_yaml, save_yaml});
  formats.add({".xml", [](const std::string& path) { return loadXml(path); },
               [](const std::string& path, const Svar& value) { saveXml(path, value); }});
}

}  // namespace v1
}  // namespace gslam
