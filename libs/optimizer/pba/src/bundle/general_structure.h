#ifndef GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_STRUCTURE_H
#define GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_STRUCTURE_H

#include <gslam/optimizer/bundle_problem.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "factors/bundle_blocks.h"

// Which blocks of the normal equations of a bundle are there, and where they lie.

namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {

// Observations in groups: all of a free point, or one of a fixed point. A group touches blocks of
// variables, its entries, ascending; each two of them are a block of the reduced matrix S.
struct GeneralGroups {
  std::vector<std::uint32_t> point;  // of each group; kNoBlock: it is fixed
  std::vector<std::size_t> first_observation;
  std::vector<std::uint32_t> observation;  // numbers in the problem, group after group
  std::vector<std::uint32_t> slot;         // 4 for each: entries of the group that it touches
  std::vector<std::size_t> first_entry;
  std::vector<std::uint32_t> entry_block;
  std::vector<std::size_t> entry_offset;  // of the coupling of block and point, 3 rows
  std::vector<std::size_t> first_pair;
  // Block of the pattern, for entries a <= b, a by a; kNoBlock: it has none.
  std::vector<std::uint32_t> pair;

  std::size_t count() const { return point.size(); }
  std::size_t entries(std::size_t group) const {
    return first_entry[group + 1] - first_entry[group];
  }
};

// Blocks of the upper triangle of the matrix, row by row, columns ascending, the diagonal one
// first. Each is stored row by row.
struct GeneralPattern {
  std::vector<std::size_t> first;  // of each row of blocks, and the end
  std::vector<std::uint32_t> column;
  std::vector<std::size_t> offset;  // of the values of each block, and the end

  std::size_t find(std::uint32_t row, std::uint32_t block_column) const;
};

struct GeneralStructure {
  BundleBlocks blocks;
  GeneralGroups groups;
  GeneralPattern pattern;
  // Borders of ranges of groups, and of rows of the pattern, whatever the number of threads.
  std::vector<std::size_t> chunk, row_chunk;
  std::size_t couplings = 0;  // numbers
  std::size_t left_out = 0;   // observations that are not seen at the start
  std::size_t chunks() const { return chunk.size() - 1; }
};

// What the matrix must have room for.
enum class GeneralFill {
  Reduced,   // S: blocks that see the same point are coupled
  Unreduced  // H and the diagonal blocks of S: blocks of the same observation are coupled
};

GeneralStructure generalStructure(const BundleProblem& problem,
                                  GeneralFill fill = GeneralFill::Reduced);

}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_PBA_SRC_BUNDLE_GENERAL_STRUCTURE_H
