#include "settings.h"

#include <gslam/svar/error.h>

#include <cctype>
#include <cstddef>

namespace app {
namespace {

// NAME=VALUE, where names are those of parameters.
bool isSetting(const std::string& text) {
  const std::size_t end = text.find('=');
  if (end == std::string::npos || end == 0) return false;
  if (std::isalpha(static_cast<unsigned char>(text[0])) == 0) return false;
  for (std::size_t i = 0; i < end; ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (std::isalnum(c) == 0 && c != '_' && c != '-' && c != '.') return false;
  }
  return true;
}

bool beginsWith(const std::string& text, const char* begin) {
  return text.rfind(begin, 0) == 0;
}

[[noreturn]] void fail(const std::string& found) {
  throw gslam::ConfigError(
      "--set", "expected NAME=VALUE, found " + (found.empty() ? "nothing" : "'" + found + "'"));
}

}  // namespace

std::vector<std::string> withSettings(const std::vector<std::string>& arguments) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--") {
      result.insert(result.end(), arguments.begin() + std::ptrdiff_t(i), arguments.end());
      break;
    }
    if (argument == "--set") {
      const std::string next = i + 1 < arguments.size() ? arguments[i + 1] : "";
      if (!isSetting(next)) fail(next);
      while (i + 1 < arguments.size() && isSetting(arguments[i + 1])) {
        result.push_back("--set." + arguments[++i]);
      }
    } else if (beginsWith(argument, "--set=")) {
      if (!isSetting(argument.substr(6))) fail(argument.substr(6));
      result.push_back("--set." + argument.substr(6));
    } else if (beginsWith(argument, "--param.")) {
      result.push_back("--set." + argument.substr(8));
    } else {
      result.push_back(argument);
    }
  }
  return result;
}

}  // namespace app
