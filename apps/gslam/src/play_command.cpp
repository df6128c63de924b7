#include <gslam/svar/json.h>

#include <iostream>

#include "command.h"
#include "session.h"

namespace app {

int playCommand(const std::vector<std::string>& arguments) {
  Options options("gslam play --dataset D [--slam S] [options]",
                  "Plays a dataset, to a SLAM system or to nobody, and says how fast it went.");
  Session::declare(options);
  if (!options.read(arguments)) return kSuccess;
  options.noWords();
  Session session(options);
  const gslam::RunResult result = session.play();
  if (options.isJson()) {
    std::cout << gslam::printJson(describe(result)) << '\n';
  } else {
    printResult(result, session.hasSlam());
  }
  return statusOf(result.play);
}

}  // namespace app
