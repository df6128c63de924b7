#include "bundle/general_structure.h"

#include <algorithm>
#include <utility>

#include "factors/bundle_terms.h"

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {

// Most numbers in all partial sums of the reduced matrix together.
constexpr std::size_t kMostPartialSums = std::size_t(1) << 24;
constexpr std::size_t kMostChunks = 8;
constexpr std::size_t kLeastChunkObservations = 512;
constexpr std::size_t kLeastChunkValues = 32768;

class StructureBuilder {
 public:
  StructureBuilder(const BundleProblem& problem, GeneralFill fill)
      : problem_(problem), fill_(fill) {
    s_.blocks = bundleBlocks(problem);
  }

  GeneralStructure build() {
    sortObservations();
    makeGroups();
    collectPriors();
    makePattern();
    makeChunks();
    makeRowChunks();
    return std::move(s_);
  }

 private:
  // Those that are seen, by point.
  void sortObservations() {
    const BundleValues values = bundleValues(problem_, s_.blocks);
    const std::size_t n = problem_.observation_point.size();
    std::vector<std::uint8_t> is_seen(n);
    first_of_point_.assign(problem_.points.size() + 1, 0);
    ObservationTerm term;
    for (std::size_t i = 0; i < n; ++i) {
      is_seen[i] = observationTerm(problem_, s_.blocks, values, i, false, term) ? 1 : 0;
      if (is_seen[i] != 0) {
        ++first_of_point_[problem_.observation_point[i] + 1];
      } else {
        ++s_.left_out;
      }
    }
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      first_of_point_[p + 1] += first_of_point_[p];
    }
    s_.groups.observation.resize(n - s_.left_out);
    std::vector<std::size_t> next = first_of_point_;
    for (std::size_t i = 0; i < n; ++i) {
      if (is_seen[i] == 0) continue;
      s_.groups.observation[next[problem_.observation_point[i]]++] = static_cast<std::uint32_t>(i);
    }
  }

  void makeGroups() {
    GeneralGroups& g = s_.groups;
    g.slot.resize(4 * g.observation.size());
    g.first_observation.push_back(0);
    g.first_entry.push_back(0);
    for (std::size_t p = 0; p < problem_.points.size(); ++p) {
      const std::size_t begin = first_of_point_[p], end = first_of_point_[p + 1];
      if (s_.blocks.point_free[p] != 0) {
        if (begin != end) addGroup(static_cast<std::uint32_t>(p), end);
      } else {
        for (std::size_t i = begin; i < end; ++i) addGroup(kNoBlock, i + 1);
      }
    }
  }

  void addGroup(std::uint32_t point, std::size_t end) {
    GeneralGroups& g = s_.groups;
    const std::size_t begin = g.first_observation.back();
    touched_.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const ObservationBlocks b = observationBlocks(problem_, s_.blocks, g.observation[i]);
      touched_.insert(touched_.end(), b.block, b.block + b.count);
    }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (std::size_t i = begin; i < end; ++i) {
      const ObservationBlocks b = observationBlocks(problem_, s_.blocks, g.observation[i]);
      for (std::size_t k = 0; k < b.count; ++k) {
        const auto place = std::lower_bound(touched_.begin(), touched_.end(), b.block[k]);
        g.slot[4 * i + k] = static_cast<std::uint32_t>(place - touched_.begin());
      }
    }
    for (const std::uint32_t block : touched_) {
      g.entry_block.push_back(block);
      g.entry_offset.push_back(s_.couplings);
      if (point != kNoBlock) s_.couplings += 3 * s_.blocks.size(block);
    }
    g.point.push_back(point);
    g.first_observation.push_back(end);
    g.first_entry.push_back(g.entry_block.size());
  }

  // Blocks that priors couple.
  void collectPriors() {
    coupled_.resize(s_.blocks.count());
    const auto couple = [this](std::uint32_t pose_a, std::uint32_t pose_b) {
      const std::uint32_t a = s_.blocks.pose[pose_a], b = s_.blocks.pose[pose_b];
      if (a != kNoBlock && b != kNoBlock) coupled_[std::min(a, b)].push_back(std::max(a, b));
    };
    for (const RelativePosePrior& prior : problem_.relative_priors) couple(prior.from, prior.to);
    for (const WindowPrior& prior : problem_.window_priors) {
      for (const std::uint32_t a : prior.poses) {
        for (const std::uint32_t b : prior.poses) {
          if (a < b) couple(a, b);
        }
      }
    }
  }

  struct Use {
    std::uint32_t group;
    std::uint32_t number;
  };

  // For each block the places where it is an entry: group, and number in the group.
  void listEntries() {
    const GeneralGroups& g = s_.groups;
    first_use_.assign(s_.blocks.count() + 1, 0);
    for (const std::uint32_t block : g.entry_block) ++first_use_[block + 1];
    for (std::size_t b = 0; b < s_.blocks.count(); ++b) first_use_[b + 1] += first_use_[b];
    use_.resize(g.entry_block.size());
    std::vector<std::size_t> next = first_use_;
    for (std::uint32_t group = 0; group < g.count(); ++group) {
      for (std::size_t e = g.first_entry[group]; e < g.first_entry[group + 1]; ++e) {
        use_[next[g.entry_block[e]]++] = {group,
                                          static_cast<std::uint32_t>(e - g.first_entry[group])};
      }
    }
  }

  void makePattern() {
    GeneralGroups& g = s_.groups;
    GeneralPattern& pattern = s_.pattern;
    g.first_pair.assign(1, 0);
    for (std::size_t group = 0; group < g.count(); ++group) {
      const std::size_t n = g.entries(group);
      g.first_pair.push_back(g.first_pair.back() + n * (n + 1) / 2);
    }
    g.pair.resize(g.first_pair.back());
    listEntries();
    const std::size_t count = s_.blocks.count();
    place_.assign(count, 0);
    number_.assign(count, 0);
    pattern.first.push_back(0);
    pattern.offset.push_back(0);
    for (std::uint32_t row = 0; row < count; ++row) addRow(row);
  }

  void addRow(std::uint32_t row) {
    GeneralPattern& pattern = s_.pattern;
    touched_.assign(1, row);
    touched_.insert(touched_.end(), coupled_[row].begin(), coupled_[row].end());
    const std::uint32_t mark = row + 1;
    for (const std::uint32_t column : touched_) place_[column] = mark;
    const auto touch = [&](std::uint32_t column) {
      if (column < row || place_[column] == mark) return;
      place_[column] = mark;
      touched_.push_back(column);
    };
    for (std::size_t u = first_use_[row]; u < first_use_[row + 1]; ++u) {
      forEachCoupled(use_[u], row, touch);
    }
    std::sort(touched_.begin(), touched_.end());
    touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
    for (const std::uint32_t column : touched_) {
      number_[column] = static_cast<std::uint32_t>(pattern.column.size());
      pattern.column.push_back(column);
      pattern.offset.push_back(pattern.offset.back() +
                               s_.blocks.size(row) * s_.blocks.size(column));
    }
    pattern.first.push_back(pattern.column.size());
    for (std::size_t u = first_use_[row]; u < first_use_[row + 1]; ++u) setPairs(use_[u], mark);
  }

  // Blocks that a group couples with one of its entries, maybe more than once.
  template <class Visit>
  void forEachCoupled(const Use& use, std::uint32_t row, const Visit& visit) const {
    const GeneralGroups& g = s_.groups;
    if (fill_ == GeneralFill::Reduced) {
      for (std::size_t e = g.first_entry[use.group]; e < g.first_entry[use.group + 1]; ++e) {
        visit(g.entry_block[e]);
      }
      return;
    }
    for (std::size_t i = g.first_observation[use.group]; i < g.first_observation[use.group + 1];
         ++i) {
      const ObservationBlocks b = observationBlocks(problem_, s_.blocks, g.observation[i]);
      if (std::find(b.block, b.block + b.count, row) == b.block + b.count) continue;
      for (std::size_t k = 0; k < b.count; ++k) visit(b.block[k]);
    }
  }

  void setPairs(const Use& use, std::uint32_t mark) {
    GeneralGroups& g = s_.groups;
    const std::size_t n = g.entries(use.group), a = use.number;
    std::uint32_t* pair = &g.pair[g.first_pair[use.group] + a * n - a * (a + 1) / 2 + a];
    const std::size_t begin = g.first_entry[use.group];
    for (std::size_t b = a; b < n; ++b) {
      const std::uint32_t column = g.entry_block[begin + b];
      *pair++ = place_[column] == mark ? number_[column] : kNoBlock;
    }
  }

  void makeChunks() {
    const GeneralGroups& g = s_.groups;
    const std::size_t observations = g.observation.size();
    const std::size_t by_memory = kMostPartialSums / (s_.pattern.offset.back() + 1);
    const std::size_t chunks = std::max<std::size_t>(
        1, std::min({kMostChunks, observations / kLeastChunkObservations, by_memory}));
    s_.chunk.push_back(0);
    for (std::size_t k = 1; k < chunks; ++k) {
      const std::size_t target = observations * k / chunks;
      const auto place =
          std::lower_bound(g.first_observation.begin(), g.first_observation.end() - 1, target);
      s_.chunk.push_back(static_cast<std::size_t>(place - g.first_observation.begin()));
    }
    s_.chunk.push_back(g.count());
  }

  void makeRowChunks() {
    const GeneralPattern& pattern = s_.pattern;
    const std::size_t rows = s_.blocks.count(), values = pattern.offset.back();
    const std::size_t chunks =
        std::max<std::size_t>(1, std::min(kMostChunks, values / kLeastChunkValues));
    s_.row_chunk.push_back(0);
    std::size_t row = 0;
    for (std::size_t k = 1; k < chunks; ++k) {
      while (row < rows && pattern.offset[pattern.first[row]] < values * k / chunks) ++row;
      s_.row_chunk.push_back(row);
    }
    s_.row_chunk.push_back(rows);
  }

  const BundleProblem& problem_;
  const GeneralFill fill_;
  GeneralStructure s_;
  std::vector<std::size_t> first_of_point_;
  std::vector<std::vector<std::uint32_t>> coupled_;
  std::vector<std::size_t> first_use_;
  std::vector<Use> use_;
  std::vector<std::uint32_t> touched_;
  std::vector<std::uint32_t> place_;   // mark of the row that a column was last seen in
  std::vector<std::uint32_t> number_;  // of a column's block in the present row
};

}  // namespace

std::size_t GeneralPattern::find(std::uint32_t row, std::uint32_t block_column) const {
  const auto begin = column.begin() + static_cast<std::ptrdiff_t>(first[row]);
  const auto end = column.begin() + static_cast<std::ptrdiff_t>(first[row + 1]);
  return static_cast<std::size_t>(std::lower_bound(begin, end, block_column) - column.begin());
}

GeneralStructure generalStructure(const BundleProblem& problem, GeneralFill fill) {
  return StructureBuilder(problem, fill).build();
}

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
