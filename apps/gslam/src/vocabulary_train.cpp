#include <gslam/svar/json.h>
#include <gslam/vocabulary/opencv.h>
#include <gslam/vocabulary/quality.h>
#include <gslam/vocabulary/train.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>

#include "command.h"
#include "descriptor_spool.h"
#include "image_features.h"
#include "interrupt.h"
#include "progress.h"
#include "vocabulary.h"
#include "vocabulary_file.h"
#include "vocabulary_report.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// "500M", "1.5G". The least is enough for the widest tree of the longest descriptors.
std::size_t bytesOfText(const std::string& option, const std::string& text) {
  char* end = nullptr;
  double bytes = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  if (unit == "K" || unit == "k") bytes *= 1024;
  if (unit == "M") bytes *= 1024.0 * 1024;
  if (unit == "G") bytes *= 1024.0 * 1024 * 1024;
  const bool is_unit = unit.empty() || unit == "K" || unit == "k" || unit == "M" || unit == "G";
  if (end == text.c_str() || !is_unit || !(bytes >= 4 << 20) || bytes > 1e15) {
    throw gslam::ConfigError(option,
                             "is '" + text + "', expected 4M bytes or more, such as 500M or 2G");
  }
  return static_cast<std::size_t>(bytes);
}

void declareTraining(Options& options) {
  options.arg<std::string>("out", "file to write: .gvoc (GSLAM's own) or .txt (ORB-SLAM's text)")
      .shortName("o");
  options.arg<std::string>("feature", "orb", "kind of features")
      .choices(featureNames())
      .group("Features");
  options.arg<std::uint32_t>("branching", 10, "K: most children of a node")
      .range(2, 64)
      .shortName("k")
      .group("Tree");
  options.arg<std::uint32_t>("depth", 6, "L: levels below the root")
      .range(1, 64)
      .shortName("l")
      .group("Tree");
  options.arg<std::string>("weighting", "tf-idf", "how much words count")
      .choices(weightingNames())
      .group("Tree");
  options.arg<std::string>("scoring", "l1", "how bags are compared")
      .choices(scoringNames())
      .group("Tree");
  options.arg<std::uint64_t>("seed", 0, "another one gives another tree").group("Tree");
  options.arg<std::string>("storage", "float32", "how descriptors of floats are kept")
      .choices(storageNames())
      .group("Tree");
  options.arg<std::string>("memory", "1G",
                           "for descriptors that are worked on at once: where there are more, the "
                           "top of the tree comes from a sample");
  FeatureStream::declare(options);
  ImageStream::declare(options);
}

gslam::TrainingOptions trainingOf(const Options& options) {
  gslam::TrainingOptions training;
  training.branching = options.get<std::uint32_t>("branching");
  training.depth = options.get<std::uint32_t>("depth");
  training.weighting = weightingOf(options.get<std::string>("weighting"));
  training.scoring = scoringOf(options.get<std::string>("scoring"));
  training.storage = storageOf(options.get<std::string>("storage"));
  training.seed = options.get<std::uint64_t>("seed");
  training.memory = bytesOfText("--memory", options.get<std::string>("memory"));
  training.parallel.threads = options.get<unsigned>("threads");
  return training;
}

// What would fail after the training fails before it.
void checkOutput(const Options& options, const FeatureKind& feature) {
  if (feature.is_binary && options.get<std::string>("storage") != "float32") {
    throw gslam::ConfigError("--storage", "is for floats, but " + std::string(feature.name) +
                                              " has descriptors of bits");
  }
  const auto out = options.get<std::string>("out");
  if (!isOrbSlamText(out, "--out")) return;
  if (!feature.is_binary) {
    throw gslam::ConfigError("--out", "is '" + out +
                                          "', but ORB-SLAM's text has descriptors of "
                                          "bits only, expected a name that ends in .gvoc");
  }
  if (options.get<std::uint32_t>("branching") > 20 || options.get<std::uint32_t>("depth") > 10) {
    throw gslam::ConfigError("--out", "is '" + out +
                                          "', but ORB-SLAM reads K up to 20 and L up to "
                                          "10, expected a name that ends in .gvoc");
  }
}

class Training {
 public:
  explicit Training(const Options& options)
      : options_(options),
        feature_(featureKind(options.get<std::string>("feature"))),
        out_(options.get<std::string>("out")),
        how_(trainingOf(options)) {
    checkOutput(options, feature_);
  }

  int run() {
    ImageStream images(options_, options_.words());
    if (images.isLive()) {
      throw gslam::ConfigError("IMAGES",
                               "are those of a device, which never ends: record it first");
    }
    DescriptorSpool spool(out_);
    {
      const OnInterrupt interrupt([this] { stop_ = true; });
      read(images, spool);
      if (!stop_) train(spool);
    }
    if (stop_) {
      std::cerr << "gslam vocabulary train: stopped, nothing was written\n";
      return kInterrupted;
    }
    report(spool);
    return kSuccess;
  }

 private:
  void read(ImageStream& images, DescriptorSpool& spool) {
    const Clock::time_point begin = Clock::now();
    Progress progress("image");
    FeatureStream stream(options_, feature_, images);
    ImageFeatures image;
    while (!stop_ && stream.next(image)) {
      spool.add(gslam::viewDescriptors(image.descriptors));
      progress.show(++image_count_, images.count());
      if (image.descriptors.empty()) ++without_;
    }
    reading_ = secondsSince(begin);
    if (!stop_ && spool.count() == 0) {
      throw gslam::Error("no " + std::string(feature_.name) + " features were found in " +
                         std::to_string(image_count_) + " images");
    }
  }

  void train(DescriptorSpool& spool) {
    const Clock::time_point begin = Clock::now();
    Progress progress;
    how_.progress = [&](double part) {
      progress.showPart("training", part);
      return !stop_;
    };
    const gslam::Span<const gslam::Descriptors> all = spool.images();
    vocabulary_ = gslam::trainVocabulary(
        all.size(), [all](std::size_t i) { return all[i]; }, how_, &trained_);
    training_ = secondsSince(begin);
    if (trained_.is_cancelled) stop_ = true;
    if (!stop_) writeVocabulary(vocabulary_, out_);
  }

  void report(DescriptorSpool& spool) {
    const gslam::VocabularyQuality quality =
        gslam::qualityOf(vocabulary_, spool.images(), how_.parallel);
    if (options_.isJson()) {
      gslam::Svar facts = describe(vocabulary_, out_);
      facts.set("file", out_);
      facts.set("feature", feature_.name);
      facts.set("images", image_count_);
      facts.set("images_without_features", without_);
      facts.set("training_descriptors", spool.count());
      facts.set("passes", trained_.passes);
      facts.set("quality", describe(quality));
      facts.set("reading_s", reading_);
      facts.set("training_s", training_);
      std::cout << gslam::printJson(facts) << '\n';
      return;
    }
    std::cout << "images       " << image_count_ << ", " << spool.count() << " " << feature_.name
              << " features";
    if (without_ != 0) std::cout << "; " << without_ << " images have none";
    std::cout << "\ntime         " << reading_ << " s to find features, " << training_
              << " s to train, in " << trained_.passes << " passes\n";
    print(vocabulary_, out_);
    print(quality, feature_.is_binary);
    std::cout << "written to   " << out_ << '\n';
    if (spool.count() < std::uint64_t(4) * vocabulary_.wordCount()) {
      std::cout << "note: there are less than 4 descriptors a word, so what is seen again will "
                   "hardly get the same words: take more images, or a lower --depth\n";
    }
  }

  const Options& options_;
  const FeatureKind& feature_;
  const std::string out_;
  gslam::TrainingOptions how_;
  std::atomic<bool> stop_{false};
  std::uint64_t image_count_ = 0, without_ = 0;
  double reading_ = 0, training_ = 0;  // seconds
  gslam::TrainingReport trained_;
  gslam::Vocabulary vocabulary_;
};

}  // namespace

int vocabularyTrain(const std::vector<std::string>& arguments) {
  Options options(
      "gslam vocabulary train [options] IMAGES... --out FILE",
      "Makes a vocabulary of images: files, folders of images, datasets. Features are "
      "kept in a temporary file beside FILE meanwhile, so there may be more than the "
      "memory holds. The result depends on the images, their order and the options, not "
      "on the number of threads.");
  declareTraining(options);
  if (!options.read(arguments)) return kSuccess;
  return Training(options).run();
}

}  // namespace app
