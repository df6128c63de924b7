#ifndef GSLAM_APPS_COMMAND_H
#define GSLAM_APPS_COMMAND_H

#include <string>
#include <vector>

namespace app {

/// How the process ends.
enum ExitStatus {
  kSuccess = 0,
  kFailure = 1,        ///< what was asked for could not be done
  kUsage = 2,          ///< what was asked for makes no sense
  kInterrupted = 130,  ///< Ctrl-C; what was done until then is kept
};

/// A word after `gslam`.
struct Command {
  const char* name;
  const char* summary;
  int (*run)(const std::vector<std::string>& arguments);
};

/// @{
/// Each takes the arguments behind its name, and gives the exit status. Throws gslam::Error.
int runCommand(const std::vector<std::string>& arguments);
int playCommand(const std::vector<std::string>& arguments);
int infoCommand(const std::vector<std::string>& arguments);
int evalCommand(const std::vector<std::string>& arguments);
int mapCommand(const std::vector<std::string>& arguments);
int vocabularyCommand(const std::vector<std::string>& arguments);
int optimizeCommand(const std::vector<std::string>& arguments);
int pluginsCommand(const std::vector<std::string>& arguments);
int datasetsCommand(const std::vector<std::string>& arguments);
int configCommand(const std::vector<std::string>& arguments);
/// @}

}  // namespace app

#endif  // GSLAM_APPS_COMMAND_H
