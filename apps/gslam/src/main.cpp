// The command `gslam`: finds the sub-command and says how it ended.
#include <gslam/core/detail/exception_text.h>
#include <gslam/core/isolation_worker.h>
#include <gslam/core/version.h>
#include <gslam/svar/detail/nearest_name.h>
#include <gslam/svar/error.h>

#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include "command.h"
#include "interrupt.h"
#include "run_worker.h"

namespace {

using app::Command;

constexpr Command kCommands[] = {
    {"run", "run a SLAM system on a dataset and keep the results", app::runCommand},
    {"play", "play a dataset, to a SLAM system or to nobody", app::playCommand},
    {"info", "say what is in a dataset", app::infoCommand},
    {"eval", "measure a trajectory against ground truth", app::evalCommand},
    {"map", "say what is in a map file, or convert it", app::mapCommand},
    {"vocabulary", "train, read and convert vocabularies, and find places by them",
     app::vocabularyCommand},
    {"optimize", "adjust a bundle or a pose graph", app::optimizeCommand},
    {"plugins", "list the plugins, what they bring and its parameters", app::pluginsCommand},
    {"datasets", "list the kinds of datasets that can be read", app::datasetsCommand},
    {"config", "print the parameters of a SLAM system or dataset as a file", app::configCommand},
};

void printHelp(std::ostream& out) {
  out << "usage: gslam COMMAND [arguments]\n\n"
         "Runs SLAM systems on datasets, and looks at both and at the results.\n\n";
  for (const Command& command : kCommands) {
    const std::string name = command.name;
    out << "  " << name << std::string(12 - name.size(), ' ') << command.summary << '\n';
  }
  out << "\n`gslam COMMAND --help` says more. Plugins are looked for in the folders of\n"
         "GSLAM_PLUGIN_PATH, beside the program, and in ../lib/gslam/plugins.\n";
}

int failUnknown(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  std::cerr << "gslam: there is no command '" << name << "'"
            << gslam::detail::suggestion(gslam::detail::nearestName(name, names))
            << "\nTry `gslam --help`.\n";
  return app::kUsage;
}

int dispatch(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    printHelp(std::cerr);
    return app::kUsage;
  }
  const std::string& name = arguments[0];
  if (name == "--help" || name == "-h" || name == "help") {
    if (arguments.size() == 1 || name != "help") {
      printHelp(std::cout);
      return app::kSuccess;
    }
    return dispatch({arguments[1], "--help"});
  }
  if (name == "--version") {
    std::cout << "gslam " GSLAM_CORE_VERSION "\n";
    return app::kSuccess;
  }
  const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (name == app::kRunWorker) return app::runWorker(rest);
  for (const Command& command : kCommands) {
    if (name == command.name) return command.run(rest);
  }
  return failUnknown(name);
}

}  // namespace

int main(int argc, char** argv) {
  if (gslam::isIsolationWorker(argc, argv)) return gslam::runIsolationWorker(argc, argv);
  std::string what = "gslam";
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (!arguments.empty()) what += " " + (arguments[0] == app::kRunWorker ? "run" : arguments[0]);
    app::holdInterrupts();
    const int status = dispatch(arguments);
    std::cout.flush();
    if (!std::cout && status == app::kSuccess) throw gslam::Error("cannot write to the output");
    return status;
  } catch (const gslam::ConfigError& error) {
    std::cerr << what << ": " << error.what() << "\nTry `" << what << " --help`.\n";
    return app::kUsage;
  } catch (...) {
    std::cerr << what << ": " << gslam::detail::exceptionText() << '\n';
    return app::kFailure;
  }
}
