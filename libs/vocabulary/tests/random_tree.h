// Trees and descriptors that are made, not trained: for tests and benchmarks.
#ifndef GSLAM_VOCABULARY_TESTS_RANDOM_TREE_H
#define GSLAM_VOCABULARY_TESTS_RANDOM_TREE_H

#include <gslam/vocabulary/detail/build_tree.h>
#include <gslam/vocabulary/detail/half.h>
#include <gslam/vocabulary/vocabulary.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace random_tree {

using gslam::DescriptorFormat;
using gslam::DescriptorType;

inline DescriptorFormat formatOf(DescriptorType type, std::uint32_t size) {
  DescriptorFormat format;
  format.type = type;
  format.size = size;
  if (type == DescriptorType::int8) {
    format.scale = 0.01F;
    format.offset = 0.1F;
  }
  return format;
}

// Any descriptor, as a tree of that format keeps it.
inline void fillRow(std::mt19937& random, const DescriptorFormat& format, std::uint8_t* row) {
  for (std::size_t i = 0; i < format.size; ++i) {
    const float value = float(random() % 2001) / 1000.0F - 1;
    if (format.type == DescriptorType::float32) {
      std::memcpy(row + i * 4, &value, 4);
    } else if (format.type == DescriptorType::float16) {
      const std::uint16_t half = gslam::detail::halfOfFloat(value);
      std::memcpy(row + i * 2, &half, 2);
    } else {
      row[i] = static_cast<std::uint8_t>(random());
    }
  }
}

// One a little like what is there; numbers become any.
inline void vary(std::mt19937& random, const DescriptorFormat& format, std::uint32_t flips,
                 std::uint8_t* row) {
  if (format.type != DescriptorType::binary) return fillRow(random, format, row);
  for (std::uint32_t i = 0; i < flips; ++i) {
    const auto bit = static_cast<std::uint32_t>(random() % (format.size * 8));
    row[bit / 8] = static_cast<std::uint8_t>(row[bit / 8] ^ (1U << (bit % 8)));
  }
}

// A tree with `depth` levels. Nodes have `branching` children; where it is ragged from 2 on, and
// below the first level one in four has none. Binary children are the more like their parents the
// deeper they are.
inline gslam::detail::TreeData dataOf(const DescriptorFormat& format, std::uint32_t branching,
                                      std::uint32_t depth, bool is_ragged = false,
                                      std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  gslam::detail::TreeData data;
  data.format = format;
  data.branching = branching;
  data.depth = depth;
  const std::size_t row = gslam::bytesOf(format);
  std::vector<std::uint32_t> level = {0};
  for (std::uint32_t l = 1; l <= depth; ++l) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t parent : level) {
      std::uint32_t count = branching;
      if (is_ragged) {
        count = l > 1 && random() % 4 == 0
                    ? 0
                    : 2 + static_cast<std::uint32_t>(random() % (branching - 1));
      }
      for (std::uint32_t c = 0; c < count; ++c) {
        const std::size_t begin = data.descriptors.size();
        data.descriptors.resize(begin + row);
        if (parent == 0) {
          fillRow(random, format, &data.descriptors[begin]);
        } else {
          std::memcpy(&data.descriptors[begin], &data.descriptors[(parent - 1) * row], row);
          vary(random, format, format.size * 2 / l, &data.descriptors[begin]);
        }
        data.parents.push_back(parent);
        data.weights.push_back(double(random() % 400) / 100);
        next.push_back(static_cast<std::uint32_t>(data.parents.size()));
      }
    }
    level.swap(next);
  }
  return data;
}

inline gslam::Vocabulary treeOf(const DescriptorFormat& format, std::uint32_t branching,
                                std::uint32_t depth, bool is_ragged = false,
                                std::uint32_t seed = 1) {
  return gslam::detail::buildVocabulary(dataOf(format, branching, depth, is_ragged, seed), "made");
}

// Binary descriptors like nodes of the tree, without gaps.
inline std::vector<std::uint8_t> queriesLike(const gslam::Vocabulary& vocabulary, std::size_t count,
                                             std::uint32_t seed = 2) {
  std::mt19937 random(seed);
  const gslam::detail::TreeView& tree = vocabulary.tree();
  const std::size_t row = gslam::bytesOf(tree.format);
  std::vector<std::uint8_t> queries(count * row);
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = 1 + static_cast<std::uint32_t>(random() % (tree.node_count - 1));
    std::memcpy(&queries[i * row], gslam::detail::descriptorOf(tree, node), row);
    vary(random, tree.format, tree.format.size / 4, &queries[i * row]);
  }
  return queries;
}

// Numbers from -1 to 1.
inline std::vector<float> floats(std::size_t count, std::uint32_t seed = 3) {
  std::mt19937 random(seed);
  std::vector<float> values(count);
  for (float& value : values) value = float(random() % 2001) / 1000.0F - 1;
  return values;
}

}  // namespace random_tree

#endif  // GSLAM_VOCABULARY_TESTS_RANDOM_TREE_H
