#include <gslam/datasets.h>

#include <cstdio>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  // Give it a dataset of yours; else it makes one.
  const std::string made = (std::filesystem::temp_directory_path() / "gslam_example").string();
  if (argc < 2) {
    std::filesystem::remove_all(made);
    const auto world = gslam::openSynthetic(
        gslam::syntheticOptions("synthetic://room?sensors=stereo&imu=true&frames=20"));
    gslam::exportDataset(*world, made, "euroc");
  }
  const auto dataset = gslam::openDataset(argc < 2 ? made : argv[1]);
  const gslam::DatasetInfo& info = dataset->info();
  std::printf("%s, %zu frames, body: %s\n", info.format.c_str(), info.frame_count,
              info.body.c_str());
  for (const std::string& remark : info.remarks) std::printf("note: %s\n", remark.c_str());
  std::size_t images = 0, inertial = 0;
  while (const auto frame = dataset->next()) {
    images += frame->images.size();
    inertial += frame->imu.size();
  }
  std::printf("%zu images, %zu inertial samples\n", images, inertial);
  return images > 0 ? 0 : 1;
}
