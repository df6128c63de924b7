#include <gslam/datasets_ros.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::printf("usage: quickstart RECORDING [TOPIC]\n");
    return 0;
  }
  const auto recording = gslam::Recording::open(argv[1]);  // .bag, .db3, .mcap, or a folder
  for (const gslam::RecordedTopic& topic : recording->topics()) {
    std::printf("%8zu %s %s\n", topic.count, topic.name.c_str(), topic.type.c_str());
  }
  if (argc > 2) {
    const gslam::Trajectory way = gslam::readTrajectory(*recording, argv[2]);
    std::printf("%zu poses, %.1f m\n", way.size(), way.length());
  }
} catch (const gslam::Error& error) {
  std::printf("%s\n", error.what());
  return 1;
}
