#ifndef GSLAM_SVAR_CONFIG_H
#define GSLAM_SVAR_CONFIG_H

#include <gslam/svar/detail/config_parameter.h>
#include <gslam/svar/shared.h>

#include <cstddef>
#include <string>
#include <vector>

/// @file
/// Parameters of a program: declared once, given by files, the environment and the command line.

namespace gslam {
inline namespace v1 {

/// What Config::parse() leaves to the program.
struct CommandLine {
  /// Arguments that are no parameters, in their order: files, folders...
  std::vector<std::string> rest;
  /// What `--help`, `--dump-config` or `--bash-completion` asks for: print it and end. Else empty.
  std::string answer;
};

/// The parameters of a program. arg() declares them, parse() gives them values.
///
///     gslam::Config config("player [options] DIR", "Plays a sequence to a SLAM system.");
///     config.arg<double>("fps", 30, "frames a second").range(1, 120);
///     const gslam::CommandLine line = config.parse(argc, argv);
///
/// **Values** come from, later ones win: the defaults, files (`--config FILE`, any number, each
/// over the one before), the environment (`GSLAM_FPS` for "fps", `GSLAM_CAMERA_FX` for
/// "camera.fx"), the command line. Objects are laid over one another, all else is replaced. What is
/// given and cannot be used is an error that says where: an unknown name, a wrong type, a value out
/// of range.
///
/// **Command line.** `--fps 30`, `--fps=30`, `-fps 30`, `-fps=30` and `fps=30` are the same, and so
/// are - and _ in names. `--flag` sets a bool, as `--flag=true` and `--flag true` do; `--no-flag`
/// clears it. A value may be a negative number; one that begins with a dash for other reasons needs
/// the `=`. Behind `--` nothing is a parameter. Lists are `1,2,3` or JSON, objects are JSON. What
/// is inside of a parameter of type Svar needs no declaration: `--slam.features 2000`.
///
/// **Names** are letters, digits, - and _, with dots between the names of nested objects, and begin
/// with a letter. Parameters are values of a SharedSvar, so threads may read, set, bind and watch
/// them; types, ranges and choices are kept to then, too. Declare and parse in one thread, before.
class Config : public SharedSvar {
 public:
  template <class T>
  class Argument;

  /// @param usage        the line that help begins with, such as "player [options] DIR"; empty for
  ///                     the name of the program and "[options]"
  /// @param about        what the program does, for the help; may be empty
  /// @param environment  what names of environment variables begin with; empty to read none
  explicit Config(const std::string& usage = "", const std::string& about = "",
                  const std::string& environment = "GSLAM_")
      : usage_(usage), about_(about), environment_(environment) {}

  /// Declares a parameter. T is anything that Svar::as() knows.
  /// @param name           its path, such as "fps" or "camera.fx"
  /// @param default_value  its value until another is given
  /// @param help           one sentence for `--help`
  /// @throws ArgumentError for a name that is malformed or declared already
  template <class T>
  Argument<T> arg(const std::string& name, const typename std::common_type<T>::type& default_value,
                  const std::string& help);
  /// Declares a parameter that must be given: parse() throws where it is not.
  template <class T>
  Argument<T> arg(const std::string& name, const std::string& help);

  /// Takes over the values of a file, as `--config FILE` does. Svar::load() says which kinds of
  /// file there are.
  /// @throws FileError and ParseError when it cannot be read; ConfigError for a value that is not
  ///         declared or does not fit. Nothing is changed then
  void loadFile(const std::string& path);

  /// Takes over files, environment and arguments, those of main().
  /// @throws ConfigError that names what was given and is wrong or is missing, and as loadFile().
  ///         Nothing is changed then
  CommandLine parse(int argc, const char* const* argv);
  /// The same, without the name of the program.
  CommandLine parse(const std::vector<std::string>& arguments);

  /// All parameters with types, defaults, values and where these came from.
  /// @param width  of a line, in characters
  std::string help(std::size_t width = 80) const;
  /// The values of all declared parameters as JSON, which `--config` takes.
  /// @throws SvarError for a value that JSON does not have
  std::string dump() const;
  /// A script for bash, to be sourced: completes names, choices and files.
  std::string bashCompletion() const;
  /// Where the value of a parameter came from: "default", the name of a file or of an environment
  /// variable, "command line", or "program" for set().
  /// @throws ArgumentError for what is not declared
  std::string origin(const std::string& name) const;

 private:
  struct Source;

  template <class T>
  std::unique_ptr<detail::Parameter> declared(const std::string& name,
                                              const std::string& help) const;
  detail::Parameter& add(std::unique_ptr<detail::Parameter> parameter,
                         std::unique_ptr<detail::ParameterRule> rule);
  void readFile(const std::string& path, Source& source) const;
  void readEnvironment(Source& source) const;
  void listFileValues(const Svar& part, const std::string& name, Source& source) const;
  [[noreturn]] void failUnknown(const std::string& path, const Source& source) const;
  void lay(const Source& source, Svar& tree) const;
  [[noreturn]] static void fail(const detail::Given& one, const Source& source,
                                const SvarError& error);
  static void failBound(const std::vector<Source>& sources, const SvarError& error);
  void takeOver(const std::vector<Source>& sources, bool all_must_be_there);
  void checkRequired(const Svar& tree) const;
  std::string programName() const;
  std::string originOf(const detail::Parameter& parameter, const Svar& tree) const;

  std::string usage_;
  std::string about_;
  std::string environment_;
  detail::Parameters parameters_;
};

/// What can be added to the declaration of a parameter:
/// `config.arg<int>("level", 3, "of the pyramid").range(0, 8).group("Tracker")`.
template <class T>
class Config::Argument {
 public:
  /// Only values from low to high, both included, are taken.
  /// @throws SvarError when the default, or the value it has already, is not among them
  Argument& range(const T& low, const T& high) {
    parameter_->rule->setRange<T>(low, high);
    return checked();
  }
  /// Only these values are taken.
  /// @throws SvarError when the default, or the value it has already, is none of them
  Argument& choices(const std::vector<T>& values) {
    parameter_->rule->setChoices(Svar(values));
    return checked();
  }
  /// The heading in the help under which it stands; else "Options".
  Argument& group(const std::string& heading) {
    parameter_->group = heading;
    return *this;
  }
  /// A second name, mostly one letter: "f" makes `-f 30` mean `--fps 30`.
  /// @throws ArgumentError when it is malformed or taken
  Argument& shortName(const std::string& name);

 private:
  friend class Config;
  Argument(Config& config, detail::Parameter& parameter)
      : config_(&config), parameter_(&parameter) {}
  Argument& checked();

  Config* config_;
  detail::Parameter* parameter_;
};

}  // namespace v1
}  // namespace gslam

#include <gslam/svar/detail/config_impl.h>

#endif  // GSLAM_SVAR_CONFIG_H
