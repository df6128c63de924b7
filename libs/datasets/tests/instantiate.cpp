// Uses every function of GSLAM::datasets; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/datasets.h>

#include <memory>
#include <string>

bool instantiateDatasets(const std::string& name);

bool instantiateDatasets(const std::string& name) {
  const gslam::SyntheticOptions options = gslam::syntheticOptions(name, gslam::Svar::object());
  const std::unique_ptr<gslam::Dataset> dataset = gslam::openSynthetic(options);
  const gslam::FrameRanges ranges = gslam::FrameRanges::fromText("1-2");
  return dataset->next() != nullptr && ranges.contains(1) && ranges.text() == "1-2" &&
         gslam::parseCalibration(name, "name").format.empty() &&
         gslam::calibrationFormats().empty() && gslam::syntheticFactory().recognizes(name) &&
         gslam::Svar(options).as<gslam::SyntheticOptions>().world == options.world;
}
