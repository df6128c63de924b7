// From the arguments of main() to values of parameters.
#ifndef GSLAM_SVAR_DETAIL_COMMAND_LINE_H
#define GSLAM_SVAR_DETAIL_COMMAND_LINE_H

#include <gslam/svar/detail/config_parameter.h>
#include <gslam/svar/detail/nearest_name.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

/// Reads arguments; the members say what was found.
class CommandLineReader {
 public:
  CommandLineReader(const Parameters& parameters, const std::vector<std::string>& arguments)
      : parameters_(parameters), arguments_(arguments) {}

  std::vector<Given> given;
  std::vector<std::string> files;  // of --config
  std::vector<std::string> rest;
  std::string question;  // help, dump-config or bash-completion, whichever came first

  void read() {
    while (next_ < arguments_.size()) {
      const std::string argument = arguments_[next_++];
      if (argument == "--") {
        rest.insert(rest.end(), arguments_.begin() + static_cast<std::ptrdiff_t>(next_),
                    arguments_.end());
        return;
      }
      if (beginsLikeOption(argument)) {
        readOption(argument);
      } else if (!readAssignment(argument)) {
        rest.push_back(argument);
      }
    }
  }

 private:
  // "-" is a file by custom, and "-3" and "-.5" are numbers.
  static bool beginsLikeOption(const std::string& argument) {
    if (argument.size() < 2 || argument[0] != '-') return false;
    const std::size_t first = argument[1] == '.' ? 2 : 1;
    return first == argument.size() || !isDigit(argument[first]);
  }

  // --name, --name=value, --name value, or the same with one dash.
  void readOption(const std::string& argument) {
    const std::size_t dashes = argument[1] == '-' ? 2 : 1;
    const std::size_t equals = argument.find('=');
    const bool has_value = equals != std::string::npos;
    Word word;
    word.name = argument.substr(dashes, has_value ? equals - dashes : equals);
    word.as_written = argument.substr(0, equals);
    word.has_value = has_value;
    if (has_value) word.value = argument.substr(equals + 1);
    if (readBuiltIn(word)) return;
    Parameter* const parameter = findParameter(parameters_, word.name);
    if (parameter != nullptr && parameter->is_bool) {
      readFlag(*parameter, word);
    } else if (parameter != nullptr) {
      take(*parameter, parameter->name, word);
    } else if (!readInside(word) && !readNegation(word)) {
      failUnknown(word.as_written, word.name, argument.substr(0, dashes));
    }
  }

  struct Word {
    std::string name;
    std::string as_written;  // with its dashes
    bool has_value;
    std::string value;
  };

  bool readBuiltIn(Word& word) {
    const std::string name = withUnderscores(word.name);
    if (name == "config") {
      files.push_back(valueOf(word));
      return true;
    }
    const bool asks = name == "help" || name == "dump_config" || name == "bash_completion";
    if (!asks && (word.name != "h" || findParameter(parameters_, "h") != nullptr)) return false;
    if (word.has_value) throw ConfigError(word.as_written, "takes no value");
    if (question.empty()) question = asks ? name : "help";
    return true;
  }

  // name=value
  bool readAssignment(const std::string& argument) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos || !isParameterName(argument.substr(0, equals))) return false;
    Word word = {argument.substr(0, equals), argument.substr(0, equals), true,
                 argument.substr(equals + 1)};
    if (readBuiltIn(word)) return true;
    Parameter* const parameter = findParameter(parameters_, word.name);
    if (parameter != nullptr) {
      take(*parameter, parameter->name, word);
    } else if (!readInside(word)) {
      failUnknown(word.as_written, word.name, "");
    }
    return true;
  }

  void readFlag(Parameter& parameter, Word& word) {
    if (!word.has_value) {
      word.value = "true";
      const std::string after = next_ < arguments_.size() ? arguments_[next_] : "";
      for (const char* said : {"true", "false", "yes", "no", "on", "off"}) {
        if (after != said) continue;
        word.value = after;
        ++next_;
        break;
      }
      word.has_value = true;
    }
    take(parameter, parameter.name, word);
  }

  // --no-flag and --noflag
  bool readNegation(Word& word) {
    const std::string name = withUnderscores(word.name);
    if (name.compare(0, 2, "no") != 0) return false;
    Parameter* parameter = findParameter(parameters_, name.substr(2));
    if (name.compare(0, 3, "no_") == 0) parameter = findParameter(parameters_, name.substr(3));
    if (parameter == nullptr || !parameter->is_bool) return false;
    if (word.has_value) throw ConfigError(word.as_written, "takes no value");
    given.push_back({parameter, parameter->name, Svar(false), word.as_written});
    return true;
  }

  // --slam.features 2000, of a parameter "slam" that is a Svar
  bool readInside(Word& word) {
    Parameter* const parameter = findOpenParameter(parameters_, word.name);
    if (parameter == nullptr) return false;
    if (!isParameterName(word.name)) throw ConfigError(word.as_written, "is no name");
    take(*parameter, pathInside(*parameter, word.name), word);
    return true;
  }

  void take(Parameter& parameter, const std::string& path, Word& word) {
    const std::string text = valueOf(word);
    try {
      given.push_back({&parameter, path, parameter.read(text), word.as_written});
    } catch (const SvarError& error) {
      throw ConfigError(word.as_written, error.what());
    }
  }

  const std::string& valueOf(Word& word) {
    if (word.has_value) return word.value;
    if (next_ == arguments_.size()) throw ConfigError(word.as_written, "expected a value after it");
    const std::string& after = arguments_[next_];
    if (beginsLikeOption(after)) {
      throw ConfigError(word.as_written, "expected a value, found " + after +
                                             "; a value that begins "
                                             "with a dash is written " +
                                             word.as_written + "=" + after);
    }
    word.has_value = true;
    word.value = after;
    ++next_;
    return word.value;
  }

  [[noreturn]] void failUnknown(const std::string& written, const std::string& name,
                                const std::string& dashes) const {
    std::vector<std::string> names = {"help", "config", "dump-config", "bash-completion"};
    for (const std::unique_ptr<Parameter>& one : parameters_) {
      names.push_back(one->name);
      if (one->is_bool) names.push_back("no-" + one->name);
    }
    const std::string nearest = nearestName(name, names);
    throw ConfigError(written, "is no parameter" +
                                   suggestion(nearest.empty() ? "" : dashes + nearest) +
                                   " (--help lists them)");
  }

  const Parameters& parameters_;
  const std::vector<std::string>& arguments_;
  std::size_t next_ = 0;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_COMMAND_LINE_H
