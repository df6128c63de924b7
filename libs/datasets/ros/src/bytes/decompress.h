// What recordings are compressed with.
#ifndef GSLAM_DATASETS_ROS_SRC_BYTES_DECOMPRESS_H
#define GSLAM_DATASETS_ROS_SRC_BYTES_DECOMPRESS_H

#include <gslam/datasets_ros/export.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "byte_reader.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// The largest block that is unpacked: recorders write blocks of some MB.
constexpr std::uint64_t kMostUnpacked = std::uint64_t(1) << 30;

/// @{
/// Unpacks all of a block. Memory grows with what comes out, not with what the file promises.
/// @param packed    LZ4 frames, zstd frames, or a bzip2 stream
/// @param unpacked  bytes that must come out
/// @throws Error without the name of a file when other bytes come out, or the block is damaged
GSLAM_DATASETS_ROS_EXPORT std::vector<std::uint8_t> unpackLz4(Bytes packed, std::uint64_t unpacked);
GSLAM_DATASETS_ROS_EXPORT std::vector<std::uint8_t> unpackZstd(Bytes packed,
                                                               std::uint64_t unpacked);
GSLAM_DATASETS_ROS_EXPORT std::vector<std::uint8_t> unpackBzip2(Bytes packed,
                                                                std::uint64_t unpacked);
/// @}

/// A zstd frame whose size is not said elsewhere.
GSLAM_DATASETS_ROS_EXPORT std::vector<std::uint8_t> unpackZstd(Bytes packed);

/// CRC-32 of zlib, as MCAP has it. `crc` is that of the bytes before.
GSLAM_DATASETS_ROS_EXPORT std::uint32_t crc32Of(Bytes bytes, std::uint32_t crc = 0);

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_BYTES_DECOMPRESS_H
