// Many descriptors on their way from the root to their leaves, a level at a time: so that the
// memory of the next ones is fetched while one is compared.
#ifndef GSLAM_VOCABULARY_DETAIL_DESCEND_H
#define GSLAM_VOCABULARY_DETAIL_DESCEND_H

#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/nearest.h>
#include <gslam/vocabulary/detail/tree_view.h>
#include <gslam/vocabulary/detail/visit.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// As many as fit the first cache together with what is kept of them.
constexpr std::size_t kTogether = 256;

// Bytes that processors have there at least. Who fetches what is there already only loses time.
constexpr std::size_t kSecondCache = std::size_t(1) << 20;

inline void fetch(const void* address) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

// Up to kTogether descriptors.
class Descent {
 public:
  Descent(const TreeView& tree, ChooseFunction choose)
      : tree_(tree), choose_(choose), is_large_(tree.node_count * tree.stride > kSecondCache) {}

  // To the leaves; `nodes` gets these, and `passed` the node at level `level` on the way (or the
  // leaf, where that is above), unless it is null. Level 0 is the root. In a damaged file, which
  // may be deeper than it says, to inner nodes.
  void run(const std::uint8_t* queries, std::size_t query_stride, std::size_t count,
           std::uint32_t level, std::uint32_t* nodes, std::uint32_t* passed) {
    for (std::size_t i = 0; i < count; ++i) {
      indices_[i] = static_cast<std::uint32_t>(i);
      visits_[i] = Visit{queries + i * query_stride, nullptr, 0, 0};
      choices_[i] = Choice{0, 0};
    }
    count_ = count;
    goDown(nodes);
    goDownLevels(level, nodes);
    if (passed != nullptr) std::copy(nodes, nodes + count, passed);
    goDownLevels(tree_.depth - level, nodes);
  }

 private:
  void goDownLevels(std::uint32_t levels, std::uint32_t* nodes) {
    for (; levels != 0 && count_ != 0; --levels) {
      choose_(tree_.format, tree_.stride, visits_, count_, choices_);
      goDown(nodes);
    }
  }

  // To the chosen nodes. Who is at a leaf is left out from now on.
  void goDown(std::uint32_t* nodes) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const std::uint32_t node = visits_[i].first + choices_[i].index;
      const std::uint32_t index = indices_[i];
      nodes[index] = node;
      const Children children = childrenOf(tree_, node);
      if (children.count == 0) continue;
      visits_[kept] = Visit{visits_[i].query, descriptorOf(tree_, children.first), children.count,
                            children.first};
      indices_[kept] = index;
      if (is_large_) fetchFar(visits_[kept], tree_.stride);
      fetch(tree_.links + children.first);
      fetch(tree_.child_counts + children.first);
      ++kept;
    }
    count_ = kept;
  }

  const TreeView& tree_;
  const ChooseFunction choose_;
  const bool is_large_;    // whether rows are far away, so that they are fetched a level ahead
  std::size_t count_ = 0;  // of those on their way
  std::uint32_t indices_[kTogether];
  Visit visits_[kTogether];
  Choice choices_[kTogether];
};

// Whether rows can be compared where they lie: kernels read binary ones in words of 8 bytes.
inline bool canReadInPlace(const TreeView& tree, const Descriptors& descriptors) noexcept {
  return !descriptors.is_binary || descriptors.size == tree.stride;
}

// The leaf of each descriptor, and the node at a level, which the tree has; see Descent::run().
inline void descend(const TreeView& tree, const Descriptors& descriptors, std::uint32_t level,
                    std::uint32_t* nodes, std::uint32_t* passed, std::vector<std::uint8_t>& rows) {
  Descent descent(tree, chooseKernel(tree.format).active());
  const bool in_place = canReadInPlace(tree, descriptors);
  if (!in_place) rows.assign(std::min(kTogether, descriptors.count) * tree.stride, 0);
  for (std::size_t begin = 0; begin < descriptors.count; begin += kTogether) {
    const std::size_t count = std::min(kTogether, descriptors.count - begin);
    const std::uint8_t* queries = descriptors.row(begin);
    if (!in_place) {
      for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(&rows[i * tree.stride], descriptors.row(begin + i), descriptors.size);
      }
      queries = rows.data();
    }
    descent.run(queries, in_place ? descriptors.stride : tree.stride, count, level, nodes + begin,
                passed == nullptr ? nullptr : passed + begin);
  }
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_DESCEND_H
