// Training with all descriptors in memory.
#ifndef GSLAM_VOCABULARY_DETAIL_MEMORY_TRAINING_H
#define GSLAM_VOCABULARY_DETAIL_MEMORY_TRAINING_H

#include <gslam/base/parallel.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/detail/row_buffer.h>
#include <gslam/vocabulary/detail/training.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// The number of the first row of each image, and of all; the images are checked but for their
// numbers.
inline std::vector<std::size_t> firstRows(Span<const Descriptors> images,
                                          DescriptorFormat& format) {
  std::vector<std::size_t> first_rows(1, 0);
  bool is_first = true;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (images[i].count != 0) {
      if (is_first) {
        checkDescriptorSize(images[i], i);
        format = rowFormat(images[i]);
      }
      is_first = false;
      checkImage(images[i], i, format);
    }
    const std::size_t room = static_cast<std::size_t>(-1) - first_rows.back();
    first_rows.push_back(first_rows.back() + std::min(room, images[i].count));
  }
  return first_rows;
}

// Copies images side by side, and returns the range of their numbers; not all when the training is
// cancelled.
inline FloatRange copyImages(Span<const Descriptors> images,
                             const std::vector<std::size_t>& first_rows, Training& training,
                             RowBuffer& rows) {
  ParallelOptions options = training.options.parallel;
  options.grain = 4;
  return parallelReduce(
      0, images.size(), FloatRange(),
      [&](std::size_t first, std::size_t end) {
        FloatRange range;
        for (std::size_t i = first; i < end && training.progress.goesOn(); ++i) {
          for (std::size_t j = 0; j < images[i].count; ++j) {
            std::uint8_t* const row = rows.row(first_rows[i] + j);
            copyRow(images[i], i, j, row, rows.stride());
            if (!images[i].is_binary) {
              range.add(reinterpret_cast<const float*>(row), images[i].size);
            }
          }
        }
        return range;
      },
      [](FloatRange all, const FloatRange& part) {
        all.add(part);
        return all;
      },
      options);
}

inline Vocabulary trainFromMemory(Span<const Descriptors> images, Training& training) {
  DescriptorFormat format;
  const std::vector<std::size_t> first_rows = firstRows(images, format);
  const std::size_t count = first_rows.back();
  checkCount(count, training.options.depth);
  checkStorage(training.options.storage, format);
  training.report.images = images.size();
  training.report.descriptors = count;
  training.report.passes = 1;
  {
    RowBuffer rows(count, strideOf(format));
    training.progress.setTotal(std::uint64_t(count) * training.options.depth);
    training.setFormat(format, copyImages(images, first_rows, training, rows));
    if (!training.progress.isCancelled()) {
      const std::vector<std::uint8_t> some_row(rows.row(0), rows.row(0) + rows.stride());
      training.grow(rows.row(0), std::vector<GrowingNode>(1, training.root(count)));
      growOnlyChild(training.settings, some_row.data(), training.tree);
    }
  }
  return training.finish([&](WordCounts& counts) {
    countWords(
        images, training.options.parallel, [&] { return training.progress.goesOn(); }, counts);
  });
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_MEMORY_TRAINING_H
