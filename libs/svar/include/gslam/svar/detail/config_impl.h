// Function bodies of config.h, which says what they do.
#ifndef GSLAM_SVAR_DETAIL_CONFIG_IMPL_H
#define GSLAM_SVAR_DETAIL_CONFIG_IMPL_H

#include <gslam/base/error.h>
#include <gslam/svar/config.h>
#include <gslam/svar/detail/bash_completion.h>
#include <gslam/svar/detail/command_line.h>
#include <gslam/svar/detail/config_help.h>

#include <algorithm>
#include <cstdlib>

namespace gslam {
inline namespace v1 {

// --- declaring

namespace detail {

/// @throws ArgumentError for a name that cannot be declared any more
inline void checkNewName(const Parameters& parameters, const std::string& name, bool is_bool) {
  if (!isParameterName(name)) {
    throw ArgumentError("\"" + name + "\"",
                        "is no name of a parameter: expected letters, digits, - and _, the first a "
                        "letter, with single dots between names of objects");
  }
  for (const char* ours : {"help", "config", "dump_config", "bash_completion"}) {
    if (sameName(name, ours)) throw ArgumentError(name, "is a parameter of every program");
  }
  if (findParameter(parameters, name) != nullptr) throw ArgumentError(name, "is declared already");
  for (const std::unique_ptr<Parameter>& one : parameters) {
    if (liesInside(name, one->name) || liesInside(one->name, name)) {
      const bool inside = liesInside(name, one->name);
      throw ArgumentError(name, "cannot be declared beside " + one->name + ": " +
                                    (inside ? one->name : name) + " is a value of its own");
    }
    if ((one->is_bool && sameName(name, "no-" + one->name)) ||
        (is_bool && sameName(one->name, "no-" + name))) {
      throw ArgumentError(
          name, "cannot be declared beside " + one->name + ": --no-NAME clears the bool NAME");
    }
  }
}

}  // namespace detail

// What a declaration says beside its default.
template <class T>
std::unique_ptr<detail::Parameter> Config::declared(const std::string& name,
                                                    const std::string& help) const {
  const bool is_bool = std::is_same<T, bool>::value;
  detail::checkNewName(parameters_, name, is_bool);
  std::unique_ptr<detail::Parameter> made(new detail::Parameter);
  made->name = name;
  made->help = help;
  made->group = "Options";
  made->placeholder = detail::Placeholder<T>::text();
  made->is_bool = is_bool;
  made->is_open = std::is_same<T, Svar>::value;
  made->read = &detail::ValueOfText<T>::read;
  return made;
}

// Nothing is declared where its rule is refused.
inline detail::Parameter& Config::add(std::unique_ptr<detail::Parameter> parameter,
                                      std::unique_ptr<detail::ParameterRule> rule) {
  parameter->rule = rule.get();
  addRule(std::move(rule), parameter->is_required ? nullptr : &parameter->default_value);
  parameters_.push_back(std::move(parameter));
  return *parameters_.back();
}

template <class T>
Config::Argument<T> Config::arg(const std::string& name,
                                const typename std::common_type<T>::type& default_value,
                                const std::string& help) {
  using Rule = detail::ParameterRule;
  std::unique_ptr<detail::Parameter> made = declared<T>(name, help);
  made->default_value = Svar(default_value).frozen();
  return Argument<T>(*this, add(std::move(made), Rule::make<T>(name, Rule::must_be_there)));
}

template <class T>
Config::Argument<T> Config::arg(const std::string& name, const std::string& help) {
  using Rule = detail::ParameterRule;
  std::unique_ptr<detail::Parameter> made = declared<T>(name, help);
  made->is_required = true;
  return Argument<T>(*this, add(std::move(made), Rule::make<T>(name, Rule::may_be_missing)));
}

template <class T>
Config::Argument<T>& Config::Argument<T>::shortName(const std::string& name) {
  detail::checkNewName(config_->parameters_, name, parameter_->is_bool);
  parameter_->short_name = name;
  return *this;
}

template <class T>
Config::Argument<T>& Config::Argument<T>::checked() {
  if (!parameter_->is_required) parameter_->rule->check(parameter_->default_value);
  const std::string& name = parameter_->name;
  if (config_->contains(name)) parameter_->rule->check(config_->template get<Svar>(name));
  return *this;
}

// --- taking over what is given

/// Values that came from one place.
struct Config::Source {
  std::string name;
  std::vector<detail::Given> given;
};

inline void Config::readFile(const std::string& path, Source& source) const {
  source.name = path;
  const Svar content = Svar::load(path);
  if (content.isNull()) return;
  if (content.type() != SvarType::object) {
    throw ConfigError(
        path, "expected an object with parameters, found " + detail::SvarParts::describe(content));
  }
  listFileValues(content, "", source);
}

// A file may write "camera.fx" as one name or as objects inside of one another.
inline void Config::listFileValues(const Svar& part, const std::string& name,
                                   Source& source) const {
  for (const Svar::Member& member : part.members()) {
    const std::string path = name.empty() ? member.first : name + "." + member.first;
    const auto is_inside = [&path](const std::unique_ptr<detail::Parameter>& one) {
      return detail::liesInside(one->name, path);
    };
    if (detail::Parameter* const one = detail::findParameter(parameters_, path)) {
      source.given.push_back({one, one->name, member.second, source.name});
    } else if (detail::Parameter* const open = detail::findOpenParameter(parameters_, path)) {
      if (!detail::isParameterName(path)) throw ConfigError(source.name, path + " is no name");
      source.given.push_back({open, detail::pathInside(*open, path), member.second, source.name});
    } else if (!std::any_of(parameters_.begin(), parameters_.end(), is_inside)) {
      failUnknown(path, source);
    } else if (member.second.isNull() || member.second.type() == SvarType::object) {
      listFileValues(member.second, path, source);
    } else {
      throw ConfigError(source.name, path + ": expected an object with parameters, found " +
                                         detail::SvarParts::describe(member.second));
    }
  }
}

inline void Config::failUnknown(const std::string& path, const Source& source) const {
  std::vector<std::string> names;
  for (const std::unique_ptr<detail::Parameter>& one : parameters_) names.push_back(one->name);
  throw ConfigError(source.name, path + " is no parameter" +
                                     detail::suggestion(detail::nearestName(path, names)) +
                                     " (--help lists them)");
}

inline void Config::readEnvironment(Source& source) const {
  if (environment_.empty()) return;
  for (const std::unique_ptr<detail::Parameter>& one : parameters_) {
    std::string variable = environment_;
    for (const char c : one->name) {
      const bool lower = c >= 'a' && c <= 'z';
      variable.push_back(lower ? static_cast<char>(c - 'a' + 'A') : c == '.' || c == '-' ? '_' : c);
    }
    const char* const text = std::getenv(variable.c_str());
    if (text == nullptr) continue;
    try {
      source.given.push_back({one.get(), one->name, one->read(text), variable});
    } catch (const SvarError& error) {
      throw ConfigError(variable, error.what());
    }
  }
}

// Puts what is given into a tree that is not frozen. Each value is checked as it comes, so that the
// error can say where it was given.
inline void Config::lay(const Source& source, Svar& tree) const {
  for (const detail::Given& one : source.given) {
    try {
      const Svar* const there = detail::SvarParts::find(tree, one.path);
      tree.set(one.path, there != nullptr ? there->merged(one.value) : one.value.clone());
      one.parameter->rule->check(*detail::SvarParts::find(tree, one.parameter->name));
    } catch (const SvarError& error) {
      fail(one, source, error);
    }
  }
}

inline void Config::fail(const detail::Given& one, const Source& source, const SvarError& error) {
  // The place says which parameter it is, unless it is a file.
  const bool in_file = one.place == source.name;
  const bool same = error.path() == one.parameter->name;
  throw ConfigError(one.place, in_file || !same ? error.what() : error.problem());
}

// A bound variable asks for more than the declaration does.
inline void Config::failBound(const std::vector<Source>& sources, const SvarError& error) {
  const std::string& path = error.path();
  for (std::size_t i = sources.size(); i-- > 0;) {
    const std::vector<detail::Given>& given = sources[i].given;
    for (std::size_t k = given.size(); k-- > 0;) {
      const std::string& name = given[k].parameter->name;
      if (path == name || detail::liesInside(path, name)) fail(given[k], sources[i], error);
    }
  }
}

inline void Config::takeOver(const std::vector<Source>& sources, bool all_must_be_there) {
  Svar tree;
  try {
    apply([&](Change& made) {
      tree = made.root.clone();
      for (const Source& source : sources) lay(source, tree);
      if (all_must_be_there) checkRequired(tree);
      tree = made.root = tree.frozen();
    });
  } catch (const SvarError& error) {
    failBound(sources, error);
    throw;
  }
  for (const Source& source : sources) {
    for (const detail::Given& one : source.given) {
      one.parameter->origin = source.name.empty() ? one.place : source.name;
      one.parameter->given = *detail::SvarParts::find(tree, one.parameter->name);
    }
  }
  callBack();
}

inline void Config::loadFile(const std::string& path) {
  std::vector<Source> sources(1);
  readFile(path, sources[0]);
  takeOver(sources, false);
}

inline CommandLine Config::parse(int argc, const char* const* argv) {
  if (usage_.empty() && argc > 0) {
    const std::string program = argv[0];
    usage_ = program.substr(program.rfind('/') + 1) + " [options]";
  }
  return parse(std::vector<std::string>(argv + (argc > 0 ? 1 : 0), argv + argc));
}

inline CommandLine Config::parse(const std::vector<std::string>& arguments) {
  detail::CommandLineReader reader(parameters_, arguments);
  reader.read();
  std::vector<Source> sources(reader.files.size() + 2);
  for (std::size_t i = 0; i < reader.files.size(); ++i) readFile(reader.files[i], sources[i]);
  readEnvironment(sources[reader.files.size()]);
  sources.back().name = "command line";
  sources.back().given = reader.given;
  takeOver(sources, reader.question.empty());
  CommandLine line;
  line.rest = reader.rest;
  if (reader.question == "help") line.answer = help();
  if (reader.question == "dump_config") line.answer = dump();
  if (reader.question == "bash_completion") line.answer = bashCompletion();
  return line;
}

inline void Config::checkRequired(const Svar& tree) const {
  for (const std::unique_ptr<detail::Parameter>& one : parameters_) {
    if (!one->is_required || tree.contains(one->name)) continue;
    throw ConfigError("--" + one->name,
                      "must be given" + std::string(one->help.empty() ? "" : ": ") + one->help);
  }
}

// --- telling

inline std::string Config::programName() const {
  return usage_.substr(0, usage_.find(' '));
}

// set() does not say that it was called; the value does.
inline std::string Config::originOf(const detail::Parameter& parameter, const Svar& tree) const {
  const Svar* const now = detail::SvarParts::find(tree, parameter.name);
  if (now == nullptr) return "nowhere";
  const bool is_default = parameter.origin == "default";
  const Svar& then = is_default ? parameter.default_value : parameter.given;
  return detail::SvarParts::same(*now, then) ? parameter.origin : "program";
}

inline std::string Config::origin(const std::string& name) const {
  const detail::Parameter* const parameter = detail::findParameter(parameters_, name);
  if (parameter == nullptr) throw ArgumentError(name, "is no parameter");
  return originOf(*parameter, snapshot());
}

inline std::string Config::help(std::size_t width) const {
  const Svar tree = snapshot();
  std::string out = "Usage: ";
  detail::appendWrapped(out, usage_.empty() ? "PROGRAM [options]" : usage_, out.size(), 7, width);
  out += "\n";
  if (!about_.empty()) {
    detail::appendWrapped(out, about_, 0, 0, width);
    out += "\n";
  }
  detail::HelpTable table(width);
  for (const std::unique_ptr<detail::Parameter>& one : parameters_) {
    table.add(one->group, detail::parameterUsage(*one),
              detail::parameterHelp(*one, tree, originOf(*one, tree)));
  }
  table.add("General", "--config FILE", "read parameters from a file; may be given several times");
  table.add("General", "--dump-config", "print all values as JSON, which --config reads, and end");
  table.add("General", "--bash-completion", "print a script for bash, to be sourced, and end");
  const bool h_is_free = detail::findParameter(parameters_, "h") == nullptr;
  table.add("General", h_is_free ? "-h, --help" : "--help", "print this and end");
  out += table.text() + "\n";
  const std::string variables =
      environment_.empty() ? "" : ", environment (" + environment_ + "NAME)";
  detail::appendWrapped(out, "Later ones win: defaults, files" + variables + ", command line.", 0,
                        0, width);
  return out + "\n";
}

inline std::string Config::dump() const {
  const Svar tree = snapshot();
  Svar values = Svar::object();
  for (const std::unique_ptr<detail::Parameter>& one : parameters_) {
    const Svar* const value = detail::SvarParts::find(tree, one->name);
    if (value != nullptr) values.set(one->name, *value);
  }
  return printJson(values, 2) + "\n";
}

inline std::string Config::bashCompletion() const {
  const std::string program = programName();
  return detail::bashCompletionScript(program.empty() ? "PROGRAM" : program, parameters_);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_CONFIG_IMPL_H
