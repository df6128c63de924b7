// From descriptors to words: train, save, open, transform, compare.
#include <gslam/vocabulary.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

// What a detector would give: 200 binary descriptors of 32 bytes for each of 30 images, of which
// images 0, 5, 10... show the same place, images 1, 6, 11... another.
std::vector<std::uint8_t> descriptorsOfImage(std::uint32_t image) {
  std::vector<std::uint8_t> bytes(200 * 32);
  std::uint32_t state = 1 + image % 5;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    state = state * 1664525 + 1013904223;
    bytes[i] = static_cast<std::uint8_t>(state >> 24);
    if (i % 32 == image) bytes[i] ^= 1;  // some noise
  }
  return bytes;
}

}  // namespace

int main() {
  std::vector<std::vector<std::uint8_t>> images;
  for (std::uint32_t i = 0; i < 30; ++i) images.push_back(descriptorsOfImage(i));

  std::vector<gslam::Descriptors> views;  // nothing is copied
  for (const std::vector<std::uint8_t>& image : images) {
    views.push_back(gslam::binaryDescriptors(image.data(), 200, 32));
  }
  gslam::TrainingOptions options;
  options.branching = 8;
  options.depth = 3;
  saveVocabulary(gslam::trainVocabulary(views, options), "places.gvoc");

  const gslam::Vocabulary vocabulary = gslam::openVocabulary("places.gvoc");  // mapped, not read
  std::printf("%u words\n", vocabulary.wordCount());

  gslam::BowVector here, again, elsewhere;
  gslam::FeatureVector features;  // by node, for matching
  gslam::TransformMemory memory;  // kept, so that nothing is allocated
  transform(vocabulary, views[0], 2, here, features, memory);
  transform(vocabulary, views[5], again, memory);
  transform(vocabulary, views[6], elsewhere, memory);
  const double same = score(vocabulary.scoring(), here, again);
  const double other = score(vocabulary.scoring(), here, elsewhere);
  std::printf("the same place %.2f, another %.2f\n", same, other);

  std::remove("places.gvoc");
  return same > 0.8 && other < 0.2 ? 0 : 1;
}
