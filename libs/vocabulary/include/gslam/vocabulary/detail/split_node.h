// The children of one node of a tree: k-means of the descriptors that fall under it.
#ifndef GSLAM_VOCABULARY_DETAIL_SPLIT_NODE_H
#define GSLAM_VOCABULARY_DETAIL_SPLIT_NODE_H

#include <gslam/base/parallel.h>
#include <gslam/vocabulary/descriptors.h>
#include <gslam/vocabulary/detail/centre_bounds.h>
#include <gslam/vocabulary/detail/centre_sums.h>
#include <gslam/vocabulary/detail/encode.h>
#include <gslam/vocabulary/detail/nearest.h>
#include <gslam/vocabulary/detail/random.h>
#include <gslam/vocabulary/detail/training_progress.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Rows are `format`, binary or float32; centres are of it, too, but only take values that `storage`
// has: what falls where does not change when they are kept in it.
struct SplitSettings {
  DescriptorFormat format;
  DescriptorFormat storage;
  std::uint32_t clusters = 0;
  std::uint32_t most_iterations = 0;
};

// What happened in all splits of a splitter.
struct SplitCounts {
  std::uint64_t iterations = 0;
  std::uint64_t unconverged = 0;
  std::uint64_t reseeded = 0;

  SplitCounts& operator+=(const SplitCounts& other) noexcept {
    iterations += other.iterations;
    unconverged += other.unconverged;
    reseeded += other.reseeded;
    return *this;
  }
};

// Splits one node after the other, and keeps its memory.
//
// Seeds by k-means++ (D. Arthur, S. Vassilvitskii, SODA 2007), where the squared L2 distance of
// bits is the Hamming distance; then Lloyd's iterations until nothing changes. A cluster that is
// left empty is moved to the row that is farthest from its centre. All that is left to chance or to
// the order of sums depends on the order of the rows and the seed, but not on threads.
class NodeSplitter {
 public:
  NodeSplitter(const SplitSettings& settings, const ParallelOptions& parallel,
               TrainingProgress& progress)
      : settings_(settings),
        stride_(strideOf(settings.format)),
        parallel_(parallel),
        progress_(progress),
        is_binary_(settings.format.type == DescriptorType::binary),
        sums_(settings.format),
        bounds_(settings.format),
        centres_(stride_ * settings.clusters) {
    parallel_.grain = kChunkRows;
  }

  // Brings `count` rows, at least one, into the order of the children, and keeps it within them.
  // Returns how many children there are: none when all rows are equal, or it was cancelled.
  std::uint32_t split(std::uint8_t* rows, std::size_t count, std::uint64_t seed) {
    rows_ = rows;
    count_ = count;
    chunks_ = chunkCount(count, kChunkRows);
    labels_.resize(count);
    distances_.resize(count);
    chunk_sums_.resize(chunks_);
    child_counts_.clear();
    const bool has_only_seeds = chooseSeeds(seed);
    if (clusters_ == 1 || progress_.isCancelled()) return 0;
    if (has_only_seeds) {
      settleSeeds();
    } else {
      refine();
    }
    if (countChildren() == 1) {  // all centres but one became the same
      chooseSeeds(seed);
      settleSeeds();
      if (countChildren() == 1) return 0;
    }
    if (progress_.isCancelled()) return 0;
    orderRows();
    return static_cast<std::uint32_t>(child_counts_.size());
  }

  // Of the last split: rows of a child, and its centre.
  std::uint32_t childCount(std::uint32_t child) const noexcept { return child_counts_[child]; }
  const std::uint8_t* childCentre(std::uint32_t child) const noexcept {
    return &centres_[child * stride_];
  }

  const SplitCounts& counts() const noexcept { return counts_; }

 private:
  // What assigning does to a chunk.
  static constexpr std::uint8_t kChanges = 1;
  static constexpr std::uint8_t kHasTraces = 2;

  // body(chunk, first row, end) for each chunk
  template <class Body>
  void forChunks(const Body& body) const {
    parallelChunks(
        0, count_,
        [&](std::size_t first, std::size_t end) { body(first / kChunkRows, first, end); },
        parallel_);
  }

  std::uint8_t* row(std::size_t i) const noexcept { return rows_ + i * stride_; }

  // Whether one look at all rows takes so long that the callback should be asked.
  bool isBig() const noexcept { return chunks_ > 8; }

  // Returns whether there is no row but the seeds and those equal to one. Each row has the label
  // of its nearest seed.
  bool chooseSeeds(std::uint64_t seed) {
    SplitMix64 random(seed);
    clusters_ = 0;
    takeSeed(random.below(count_));
    for (;;) {
      double total = 0;
      for (const double sum : chunk_sums_) total += sum;
      if (!(total > 0)) return true;
      if (isBig()) progress_.ask();
      if (clusters_ == settings_.clusters || progress_.isCancelled()) return false;
      takeSeed(rowAt(random.unit() * total));
    }
  }

  // The row that this much of the sum of all distances falls on; never one at a seed.
  std::size_t rowAt(double place) const {
    std::size_t chunk = 0;
    std::size_t last = 0;  // with a distance, for what rounding leaves
    for (; chunk + 1 < chunks_ && place >= chunk_sums_[chunk]; ++chunk) {
      place -= chunk_sums_[chunk];
    }
    for (std::size_t i = chunk * kChunkRows; i < std::min(count_, (chunk + 1) * kChunkRows); ++i) {
      if (!(distances_[i] > 0)) continue;
      last = i;
      place -= static_cast<double>(distances_[i]);
      if (place < 0) return i;
    }
    if (distances_[last] > 0) return last;
    return static_cast<std::size_t>(std::max_element(distances_.begin(), distances_.end()) -
                                    distances_.begin());
  }

  // Makes a row the next centre, and gives it those that are nearer to it than to any before.
  void takeSeed(std::size_t seed_row) {
    const std::uint32_t cluster = clusters_++;
    std::uint8_t* const centre = &centres_[cluster * stride_];
    std::memcpy(centre, row(seed_row), stride_);
    forChunks([&](std::size_t chunk, std::size_t first, std::size_t end) {
      std::uint32_t nearest[kChunkRows];
      float distances[kChunkRows];
      nearestRows(settings_.format, row(first), end - first, centre, 1, nearest, distances);
      double sum = 0;
      for (std::size_t i = first; i < end; ++i) {
        if (cluster == 0 || distances[i - first] < distances_[i]) {
          distances_[i] = distances[i - first];
          labels_[i] = static_cast<std::uint8_t>(cluster);
        }
        sum += static_cast<double>(distances_[i]);
      }
      chunk_sums_[chunk] = sum;
    });
  }

  void refine() {
    sumAll();
    if (!is_binary_) bounds_.begin(count_, clusters_);
    for (std::uint32_t i = 0; i < settings_.most_iterations; ++i) {
      if (isBig()) progress_.ask();
      if (progress_.isCancelled()) return;
      ++counts_.iterations;
      fillEmptyClusters();
      moveCentres();
      if (assign()) continue;
      if (!has_traces_) return;
      sumAll();  // exact ones, which may move the centres a little further
      if (!moveCentres() || !assign()) return;
    }
    ++counts_.unconverged;
  }

  void sumAll() {
    has_traces_ = false;
    sums_.begin(chunks_, clusters_);
    forChunks([&](std::size_t chunk, std::size_t first, std::size_t end) {
      sums_.sumChunk(chunk, row(first), &labels_[first], end - first);
    });
  }

  // To the means of their rows. Returns whether any moved.
  bool moveCentres() {
    before_.assign(centres_.begin(), centres_.end());
    for (std::uint32_t k = 0; k < clusters_; ++k) {
      if (sums_.countOf(k) == 0) continue;
      sums_.writeCentre(k, &centres_[k * stride_]);
      roundCentre(k);
    }
    if (!is_binary_) bounds_.moveCentres(&before_[0], &centres_[0]);
    return before_ != centres_;
  }

  bool hasRoundCentres() const noexcept { return settings_.storage.type != settings_.format.type; }

  void roundCentre(std::uint32_t cluster) {
    if (!hasRoundCentres()) return;
    roundFloats(settings_.storage, reinterpret_cast<float*>(&centres_[cluster * stride_]));
  }

  // Seeds are rows, which the storage may not have.
  void settleSeeds() {
    if (!hasRoundCentres()) return;
    for (std::uint32_t k = 0; k < clusters_; ++k) roundCentre(k);
    sums_.begin(chunks_, clusters_);
    bounds_.begin(count_, clusters_);
    assign();
  }

  // Gives each row to its nearest centre, and sums these anew. Returns whether any changed.
  bool assign() {
    chunk_flags_.assign(chunks_, 0);
    forChunks([&](std::size_t chunk, std::size_t first, std::size_t end) {
      chunk_flags_[chunk] =
          is_binary_ ? assignBits(chunk, first, end) : assignFloats(chunk, first, end);
    });
    unsigned flags = 0;
    for (const std::uint8_t flag : chunk_flags_) flags |= flag;
    has_traces_ = has_traces_ || (flags & kHasTraces) != 0;
    return flags != 0;
  }

  std::uint8_t assignBits(std::size_t chunk, std::size_t first, std::size_t end) {
    std::uint32_t nearest[kChunkRows];
    nearestRows(settings_.format, row(first), end - first, &centres_[0], clusters_, nearest,
                &distances_[first]);
    bool changes = false;
    for (std::size_t i = first; i < end; ++i) {
      const auto label = static_cast<std::uint8_t>(nearest[i - first]);
      changes |= label != labels_[i];
      labels_[i] = label;
    }
    if (!changes) return 0;
    sums_.sumChunk(chunk, row(first), &labels_[first], end - first);
    return kChanges;
  }

  // The sums follow the rows that change their cluster, unless these are many.
  std::uint8_t assignFloats(std::size_t chunk, std::size_t first, std::size_t end) {
    std::uint8_t old_labels[kChunkRows];
    std::copy(&labels_[first], &labels_[first] + (end - first), old_labels);
    std::size_t changes = 0;
    for (std::size_t i = first; i < end; ++i) {
      const std::uint32_t label = bounds_.nearest(i, row(i), &centres_[0], labels_[i]);
      changes += label != labels_[i] ? 1 : 0;
      labels_[i] = static_cast<std::uint8_t>(label);
    }
    if (changes == 0) return 0;
    if (changes > (end - first) / 4) {
      sums_.sumChunk(chunk, row(first), &labels_[first], end - first);
      return kChanges;
    }
    for (std::size_t i = first; i < end; ++i) {
      const std::uint8_t from = old_labels[i - first];
      if (labels_[i] != from) sums_.moveRow(chunk, row(i), from, labels_[i]);
    }
    return kChanges | kHasTraces;
  }

  // Moves clusters without rows to rows that are far from their centres.
  void fillEmptyClusters() {
    std::size_t counts[kMostClusters];
    for (std::uint32_t k = 0; k < clusters_; ++k) counts[k] = sums_.countOf(k);
    if (std::find(counts, counts + clusters_, 0u) == counts + clusters_) return;
    if (!is_binary_) measureDistances();
    bool is_changed = false;
    for (std::uint32_t k = 0; k < clusters_; ++k) {
      if (counts[k] != 0) continue;
      const std::size_t far = farthestRow(counts);
      if (far == count_) break;
      --counts[labels_[far]];
      counts[k] = 1;
      labels_[far] = static_cast<std::uint8_t>(k);
      distances_[far] = 0;
      ++counts_.reseeded;
      is_changed = true;
    }
    if (!is_changed) return;
    sumAll();
    if (!is_binary_) bounds_.begin(count_, clusters_);
  }

  // Of rows of floats, to their centres.
  void measureDistances() {
    forChunks([&](std::size_t, std::size_t first, std::size_t end) {
      for (std::size_t i = first; i < end; ++i) {
        std::uint32_t nearest;
        nearestRows(settings_.format, row(i), 1, &centres_[labels_[i] * stride_], 1, &nearest,
                    &distances_[i]);
      }
    });
  }

  // The first of those farthest from their centres, which is not the only one there; or count_.
  std::size_t farthestRow(const std::size_t* counts) const {
    std::size_t farthest = count_;
    for (std::size_t i = 0; i < count_; ++i) {
      if (distances_[i] > (farthest == count_ ? 0 : distances_[farthest]) &&
          counts[labels_[i]] > 1) {
        farthest = i;
      }
    }
    return farthest;
  }

  // How many clusters have rows. They become the children, in their order.
  std::size_t countChildren() {
    std::uint32_t counts[kMostClusters] = {};
    for (const std::uint8_t label : labels_) ++counts[label];
    child_counts_.clear();
    std::uint8_t children[kMostClusters] = {};
    for (std::uint32_t k = 0; k < clusters_; ++k) {
      if (counts[k] == 0) continue;
      const std::size_t child = child_counts_.size();
      children[k] = static_cast<std::uint8_t>(child);
      if (child != k) std::memcpy(&centres_[child * stride_], &centres_[k * stride_], stride_);
      child_counts_.push_back(counts[k]);
    }
    for (std::uint8_t& label : labels_) label = children[label];
    return child_counts_.size();
  }

  // In place: each row goes where it belongs, and the one from there on to where that belongs.
  void orderRows() {
    std::uint32_t ends[kMostClusters] = {};
    for (std::size_t c = 1; c < child_counts_.size(); ++c) {
      ends[c] = ends[c - 1] + child_counts_[c - 1];
    }
    places_.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) places_[i] = ends[labels_[i]]++;
    for (std::uint32_t i = 0; i < count_; ++i) {
      while (places_[i] != i) {
        const std::uint32_t to = places_[i];
        std::swap_ranges(row(i), row(i) + stride_, row(to));
        std::swap(places_[i], places_[to]);
      }
    }
  }

  const SplitSettings settings_;
  const std::size_t stride_;
  ParallelOptions parallel_;
  TrainingProgress& progress_;
  const bool is_binary_;
  CentreSums sums_;
  bool has_traces_ = false;  // whether rounding left any in the sums
  CentreBounds bounds_;      // of rows of floats
  std::vector<std::uint8_t> centres_;
  std::vector<std::uint8_t> before_;  // the centres were moved
  std::uint32_t clusters_ = 0;

  std::uint8_t* rows_ = nullptr;
  std::size_t count_ = 0;
  std::size_t chunks_ = 0;
  std::vector<std::uint8_t> labels_;  // of each row: its cluster
  std::vector<float> distances_;      // of each row: to its centre
  std::vector<double> chunk_sums_;    // of distances
  std::vector<std::uint8_t> chunk_flags_;
  std::vector<std::uint32_t> places_;
  std::vector<std::uint32_t> child_counts_;
  SplitCounts counts_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_SPLIT_NODE_H
