// synthetic://room?seed=1&frames=300
#include <gslam/base/error.h>
#include <gslam/core/parameters.h>
#include <gslam/datasets/synthetic.h>
#include <gslam/svar/detail/nearest_name.h>
#include <gslam/svar/detail/value_of_text.h>

#include <algorithm>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace {

const char* const kScheme = "synthetic";

// A value as text, of the type that the default has.
Svar valueOf(const std::string& name, const Svar& standard, const std::string& text) {
  try {
    switch (standard.type()) {
      case SvarType::boolean:
        return detail::valueOfBool(text);
      case SvarType::integer:
      case SvarType::real:
        return detail::valueOfNumber(text, "a number");
      case SvarType::array:
        return detail::valueOfJson("[" + text + "]", "numbers with commas between them");
      default:
        return text;
    }
  } catch (const SvarError& error) {
    throw ArgumentError(name, error.what());
  }
}

void readOption(const std::string& text, const Svar& defaults, Svar& options) {
  const std::size_t equal = text.find('=');
  const std::string name = text.substr(0, equal);
  if (equal == std::string::npos) {
    throw ArgumentError("\"" + text + "\"", "is no option, expected name=value");
  }
  std::vector<std::string> names;
  for (const Svar::Member& member : defaults.members()) names.push_back(member.first);
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw ArgumentError(
        "\"" + name + "\"",
        "is no option of synthetic worlds" + detail::suggestion(detail::nearestName(name, names)));
  }
  options.set(name, valueOf(name, defaults[name], text.substr(equal + 1)));
}

Svar optionsOfName(const std::string& name, const Svar& defaults) {
  Svar options = Svar::object();
  const std::string start = std::string(kScheme) + "://";
  if (name == kScheme) return options;
  if (name.compare(0, start.size(), start) != 0) {
    throw ArgumentError("\"" + name + "\"", "is no synthetic world, expected synthetic://WORLD");
  }
  const std::size_t query = std::min(name.find('?'), name.size());
  const std::string world = name.substr(start.size(), query - start.size());
  if (!world.empty()) options.set("world", world);
  for (std::size_t begin = query + 1; begin < name.size();) {
    const std::size_t end = std::min(name.find('&', begin), name.size());
    if (end > begin) readOption(name.substr(begin, end - begin), defaults, options);
    begin = end + 1;
  }
  return options;
}

}  // namespace

SyntheticOptions syntheticOptions(const std::string& name, const Svar& parameters) {
  const Svar defaults(SyntheticOptions{});
  const Svar given = completeParameters(defaults, parameters);
  const Svar named = optionsOfName(name, defaults);
  completeParameters(defaults, named);  // checks
  return given.merged(named).as<SyntheticOptions>();
}

DatasetFactory syntheticFactory() {
  DatasetFactory factory;
  factory.name = kScheme;
  factory.description =
      "Computed worlds with exact truth: synthetic://room, corridor, street or aerial";
  factory.parameters = Svar(SyntheticOptions{});
  factory.recognizes = [](const std::string&) { return false; };
  factory.open = [](const std::string& path, const Svar& parameters) {
    return openSynthetic(syntheticOptions(path, parameters));
  };
  return factory;
}

}  // namespace v1
}  // namespace gslam
