// The descriptors of an image for those who want them from OpenCV.
#ifndef GSLAM_BENCH_VOCABULARY_PEERS_OPENCV_IMAGE_H
#define GSLAM_BENCH_VOCABULARY_PEERS_OPENCV_IMAGE_H

#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <vector>

#include "subject.h"

/// A view of them.
inline cv::Mat matOf(const Image& image) {
  const int rows = static_cast<int>(image.count);
  return image.isBinary() ? cv::Mat(rows, 32, CV_8U, const_cast<std::uint8_t*>(image.bytes.data()))
                          : cv::Mat(rows, 128, CV_32F, const_cast<float*>(image.floats.data()));
}

/// A view of each.
inline std::vector<cv::Mat> rowsOf(const cv::Mat& all) {
  std::vector<cv::Mat> rows;
  for (int i = 0; i < all.rows; ++i) rows.push_back(all.row(i));
  return rows;
}

/// Fills `nodes` and `words` of DBoW2 or DBoW3, which are members of their vocabularies, with a
/// tree.
/// @param descriptor_of  makes a descriptor of the bytes at a pointer
template <class Nodes, class WordList, class DescriptorOf>
void fillDBow(const gslam::detail::TreeData& tree, const DescriptorOf& descriptor_of, Nodes& nodes,
              WordList& words) {
  const std::size_t row = bytesOf(tree.format);
  nodes.resize(tree.ids.size() + 1);
  for (std::size_t i = 0; i < tree.ids.size(); ++i) {
    auto& node = nodes[tree.ids[i]];
    node.id = tree.ids[i];
    node.parent = tree.parents[i];
    node.weight = tree.weights[i];
    node.descriptor = descriptor_of(&tree.descriptors[i * row]);
    nodes[node.parent].children.push_back(node.id);
    if (tree.words[i] == gslam::detail::kNone) continue;
    node.word_id = tree.words[i];
    if (words.size() <= node.word_id) words.resize(node.word_id + 1);
    words[node.word_id] = &node;
  }
}

/// A descriptor of DBoW3, and of DBoW2 where it is binary.
inline cv::Mat descriptorAt(const gslam::DescriptorFormat& format, const std::uint8_t* bytes) {
  const bool is_binary = format.type == gslam::DescriptorType::binary;
  cv::Mat descriptor(1, static_cast<int>(format.size), is_binary ? CV_8U : CV_32F);
  std::memcpy(descriptor.data, bytes, bytesOf(format));
  return descriptor;
}

#endif  // GSLAM_BENCH_VOCABULARY_PEERS_OPENCV_IMAGE_H
