#ifndef GSLAM_APPS_OPTIONS_H
#define GSLAM_APPS_OPTIONS_H

#include <gslam/core/plugins.h>
#include <gslam/svar/config.h>

#include <string>
#include <vector>

namespace app {

/// The parameters of a sub-command, with those that all have: --json and --log.
class Options : public gslam::Config {
 public:
  Options(const std::string& usage, const std::string& about);

  /// Takes over the arguments, sets the log up, and prints what --help asks for.
  /// @return whether the command is to go on
  bool read(const std::vector<std::string>& arguments);

  /// Arguments that are no parameters.
  const std::vector<std::string>& words() const { return words_; }
  /// The only one of them.
  /// @throws ConfigError when there are none or more
  const std::string& oneWord(const std::string& what) const;
  /// @throws ConfigError when there are any
  void noWords() const;

  /// Whether the output is for machines.
  bool isJson() const { return get<bool>("json"); }

 private:
  std::vector<std::string> words_;
};

/// All plugins that can be loaded; the log says what was refused.
/// @param plugins  that look for them
void loadAllPlugins(gslam::Plugins& plugins);

}  // namespace app

#endif  // GSLAM_APPS_OPTIONS_H
