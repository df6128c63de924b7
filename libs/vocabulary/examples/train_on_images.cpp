// A vocabulary of photographs: train_on_images OUTPUT IMAGE...
#include <cstdio>

#ifdef GSLAM_HAS_OPENCV

#include <gslam/vocabulary.h>
#include <gslam/vocabulary/opencv.h>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace {

// Without images of the user's: circles and boxes at random.
cv::Mat drawnImage(int number) {
  cv::Mat image(480, 640, CV_8UC1, cv::Scalar(90));
  cv::RNG random(static_cast<std::uint64_t>(number) + 1);
  for (int i = 0; i < 150; ++i) {
    const cv::Point at(random.uniform(0, 640), random.uniform(0, 480));
    const cv::Scalar grey(random.uniform(0, 256));
    if (i % 2 == 0) cv::circle(image, at, random.uniform(4, 30), grey, cv::FILLED);
    if (i % 2 == 1) cv::rectangle(image, at, at + cv::Point(25, 15), grey, cv::FILLED);
  }
  return image;
}

cv::Mat orbOf(const cv::Mat& image) {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  cv::ORB::create(1000)->detectAndCompute(image, cv::noArray(), points, descriptors);
  return descriptors;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<cv::Mat> descriptors;
  for (int i = 2; i < argc; ++i) {
    const cv::Mat image = cv::imread(argv[i], cv::IMREAD_GRAYSCALE);
    if (image.empty()) return std::printf("%s: cannot be read\n", argv[i]), 1;
    descriptors.push_back(orbOf(image));
  }
  for (int i = 0; argc < 3 && i < 10; ++i) descriptors.push_back(orbOf(drawnImage(i)));

  std::vector<gslam::Descriptors> views;
  for (const cv::Mat& image : descriptors) views.push_back(gslam::viewDescriptors(image));

  gslam::TrainingOptions options;
  options.branching = 10;
  options.depth = 4;
  options.progress = [](double part) {
    std::printf("\rtraining %3.0f %%", part * 100);
    return std::fflush(stdout) == 0;  // false would end it
  };
  gslam::TrainingReport report;
  const gslam::Vocabulary vocabulary = gslam::trainVocabulary(views, options, &report);
  std::printf("\n%u words of %llu descriptors\n", vocabulary.wordCount(),
              static_cast<unsigned long long>(report.descriptors));
  const char* const path = argc > 1 ? argv[1] : "photographs.gvoc";
  saveVocabulary(vocabulary, path);
  std::printf("saved as %s\n", path);
  if (argc < 2) std::remove(path);
  return vocabulary.empty() ? 1 : 0;
}

#else

int main() {
  std::printf("this example needs OpenCV, which was not found when it was built\n");
  return 0;
}

#endif
