// Any bytes are a vocabulary that gives words, and in which, once it is verified, every way down
// ends at one, and which goes to ORB-SLAM's text and back, or are refused with a gslam::Error.
#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/write_orb_text.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/transform.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

using gslam::Vocabulary;
using gslam::detail::Children;
using gslam::detail::TreeData;

gslam::Span<const std::uint8_t> bytesOfText(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

volatile unsigned seen = 0;  // so that all is read

// The first leaf by the lowest children, and the last.
void goDown(const Vocabulary& vocabulary) {
  const gslam::detail::TreeView& tree = vocabulary.tree();
  unsigned sum = 0;
  for (const bool is_last : {false, true}) {
    std::uint32_t node = 0;
    for (Children children = childrenOf(tree, node); children.count != 0;
         children = childrenOf(tree, node)) {
      node = children.first + (is_last ? children.count - 1 : 0);
      for (std::size_t i = 0; i < tree.stride; ++i) sum += descriptorOf(tree, node)[i];
    }
    const std::uint32_t word = wordOf(tree, node);
    if (word != gslam::detail::kNone && vocabulary.weight(word) < 0) ++sum;
  }
  seen = sum;
}

void findWords(const Vocabulary& vocabulary) {
  const gslam::DescriptorFormat& format = vocabulary.format();
  const std::vector<float> numbers(format.size, 0.5F);
  const std::vector<std::uint8_t> bits(format.size, 0x5A);
  gslam::BowVector bow;
  gslam::FeatureVector features;
  transform(vocabulary,
            format.type == gslam::DescriptorType::binary
                ? gslam::binaryDescriptors(bits.data(), 1, format.size)
                : gslam::floatDescriptors(numbers.data(), 1, format.size),
            1, bow, features);
  for (const std::uint32_t word : bow.words) {
    if (word >= vocabulary.wordCount()) std::abort();
  }
}

void roundTrip(const Vocabulary& vocabulary) {
  gslam::verifyVocabulary(vocabulary);
  if (vocabulary.format().type != gslam::DescriptorType::binary) return;
  const TreeData data = gslam::detail::treeDataOf(vocabulary);
  std::string text;
  gslam::detail::OrbTextWriter(data).write(
      [&text](const char* piece, std::size_t size) { text.append(piece, size); });
  const TreeData again =
      gslam::detail::treeDataOf(gslam::loadVocabulary(bytesOfText(text), "text"));
  if (again.descriptors != data.descriptors || again.words != data.words ||
      again.weights != data.weights || again.parents.size() != data.parents.size()) {
    std::abort();
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Vocabulary vocabulary =
        gslam::loadVocabulary(gslam::Span<const std::uint8_t>(data, size), "fuzz");
    goDown(vocabulary);
    findWords(vocabulary);
    roundTrip(vocabulary);
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
