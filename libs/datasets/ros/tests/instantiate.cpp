// Uses every function of GSLAM::datasets_ros; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/datasets_ros.h>

#include <string>
#include <vector>

bool instantiateDatasetsRos(const std::string& path);

bool instantiateDatasetsRos(const std::string& path) {
  if (!gslam::isRecording(path)) return false;
  const auto recording = gslam::Recording::open(path);
  const gslam::DatasetFactory factory = gslam::rosFactory();
  std::vector<std::string> remarks = recording->remarks();
  const gslam::Trajectory way = gslam::readTrajectory(*recording, "/odom", &remarks);
  const std::size_t topic = recording->topic("/odom");
  for (const gslam::MessageRef& message : recording->messages({topic})) {
    if (recording->read(message) != recording->readHead(message, 100)) return false;
  }
  return recording->messages().size() == recording->topics()[topic].count && !way.empty() &&
         recording->path() == path && factory.recognizes(path);
}
