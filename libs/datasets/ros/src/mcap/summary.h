// The summary at the end of an MCAP file, which tells where the chunks are.
#ifndef GSLAM_DATASETS_ROS_SRC_MCAP_SUMMARY_H
#define GSLAM_DATASETS_ROS_SRC_MCAP_SUMMARY_H

#include <string>
#include <vector>

#include "../bytes/byte_source.h"
#include "records.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace mcap {

struct NamedSchema {
  std::uint16_t id = 0;
  std::string name;
};

struct Summary {
  std::string problem;  ///< why it cannot be used; empty: it can
  std::vector<NamedSchema> schemas;
  std::vector<Channel> channels;
  std::vector<ChunkIndex> chunks;  ///< as they follow one another in the file
  bool has_statistics = false;
  Statistics statistics;
};

/// Reads it. A missing or broken one is no error: then the file is scanned.
Summary readSummary(const ByteSource& file);

/// All message indexes of a chunk. @throws FileError when they are not where the chunk index says
std::vector<MessageIndex> readMessageIndexes(const ByteSource& file, const ChunkIndex& chunk);

}  // namespace mcap
}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MCAP_SUMMARY_H
