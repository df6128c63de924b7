// Any bytes are a vocabulary in which every way down ends at a word, and which goes to ORB-SLAM's
// text and back, or are refused with a gslam::Error.
#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/write_orb_text.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/load.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

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
    roundTrip(vocabulary);
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
