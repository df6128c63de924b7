#include "image_bags.h"

#include <gslam/vocabulary/opencv.h>
#include <unistd.h>

#include <atomic>
#include <memory>

#include "image_features.h"
#include "interrupt.h"
#include "progress.h"
#include "vocabulary_report.h"

namespace app {
namespace {

const FeatureKind& featureOf(const Options& options, const gslam::Vocabulary& vocabulary) {
  const auto name = options.get<std::string>("feature");
  const gslam::DescriptorFormat& format = vocabulary.format();
  if (name == "auto") return featureKindFor(format);
  const FeatureKind& kind = featureKind(name);
  const bool is_binary = format.type == gslam::DescriptorType::binary;
  if (kind.is_binary == is_binary && kind.size == format.size) return kind;
  throw gslam::ConfigError("--feature",
                           "is " + name + ", with descriptors of " + std::to_string(kind.size) +
                               (kind.is_binary ? " bytes of bits" : " floats") +
                               ", but the vocabulary is for " + descriptorText(format));
}

}  // namespace

void declareBags(Options& options) {
  std::vector<std::string> names = featureNames();
  names.insert(names.begin(), "auto");
  options.arg<std::string>("feature", "auto", "kind of features; auto: by the vocabulary's size")
      .choices(names)
      .group("Features");
  FeatureStream::declare(options);
  ImageStream::declare(options);
}

bool forEachBag(const Options& options, const gslam::Vocabulary& vocabulary,
                const std::vector<std::string>& words, std::uint32_t levels_up,
                const std::function<void(const ImageBag&)>& visit) {
  const FeatureKind& feature = featureOf(options, vocabulary);
  ImageStream images(options, words);
  FeatureStream stream(options, feature, images);
  std::atomic<bool> stop{false};
  const OnInterrupt interrupt([&stop] { stop = true; });
  // On a terminal the results themselves say how far it is.
  const auto progress = isatty(STDOUT_FILENO) ? nullptr : std::make_unique<Progress>("image");
  ImageFeatures found;
  ImageBag bag;
  gslam::TransformMemory memory;
  for (std::uint64_t done = 1; !stop && stream.next(found); ++done) {
    bag.name = found.name;
    bag.features = static_cast<std::size_t>(found.descriptors.rows);
    transform(vocabulary, gslam::viewDescriptors(found.descriptors), levels_up, bag.bow,
              bag.by_node, memory);
    visit(bag);
    if (progress != nullptr) progress->show(done, images.count());
  }
  return !stop;
}

}  // namespace app
