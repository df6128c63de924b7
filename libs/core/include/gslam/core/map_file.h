#ifndef GSLAM_CORE_MAP_FILE_H
#define GSLAM_CORE_MAP_FILE_H

#include <gslam/base/detail/new_file.h>
#include <gslam/base/span.h>
#include <gslam/core/detail/map_reader.h>
#include <gslam/core/detail/map_writer.h>
#include <gslam/core/map.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Maps as files: everything that a map has, on every machine the same.
///
/// Format
/// ------
///
/// Numbers are little-endian: u8 to u64 without sign, i16 to i64 in two's complement, f32 and f64
/// as IEEE 754 says. Nothing is aligned.
///
///     file     = "GSLAMMAP"  u32 version = 1  u32 0  section*
///     section  = u8[4] tag  u32 0  u64 length  u8[length] payload  u64 checksum
///     checksum = XXH64, seed 0, of all bytes of the section before it, the tag included
///
/// The last section is `END `; the file ends with it. A reader skips sections whose tag it does not
/// know; what must be known raises the version. A tag may come again, with more of the same.
/// Sections stand in the order below.
///
///     HEAD   u32 keyframes  u32 points  u32 edges            the ids that come next
///     RIG    u32 n  n * { text name  u8 kind  f64 rate  f64 depth_scale  pose T_body_camera
///            camera }  u8 has_imu  pose T_body_imu  f64 rate  f64 gyro_noise  f64 accel_noise
///            f64 gyro_bias_walk  f64 accel_bias_walk  u8 has_gnss  f64[3] antenna
///     KEYF   u32 n  n * { u32 id  u64 frame  i64 stamp  pose T_world_body
///            u32 m  m * { f32 u  f32 v  f32 size  f32 angle  f32 response  i16 octave
///            u16 camera }  image descriptors  u32 k  k * { text name  u8 kind  i64 exposure
///            f64 depth_scale  pose T_body_camera  camera  image } }
///     PNTS   u32 n  n * { u32 id  f64[3] position  f32[3] normal  u8[4] red green blue alpha
///            u32 label  u8 kind  u8[3] 0 }
///     SHAP   u32 n  n * { u32 point  f64[4] qx qy qz qw of R_world_shape  f64[3] size }
///     DESC   u32 n  u32[n] points  image of n rows, one a point
///     OBSV   u32 n  n * { u32 point  u32 m  m * { u32 keyframe  u32 feature } }
///     EDGE   u32 n  n * { u32 id  u32 from  u32 to  u8 kind  u8[3] 0  pose T_from_to  f64 scale
///            f64[36] information, row by row }
///     END    u64 number of the sections before this one
///
///     text   = u32 length  u8[length] UTF-8
///     pose   = f64[7] tx ty tz qx qy qz qw, read to the bit where the norm of q is 1 within 1e-6
///     camera = text model, empty for none; otherwise followed by
///              i32 width  i32 height  u32 n  f64[n] parameters, in the order of Camera
///     image  = u32 width  u32 height  u16 channels  u8 type  u8 0
///              rows of width * channels numbers of the type, without gaps; 0 x 0: no image
///
/// `RIG ` and `END ` have a space at their end. Kinds and types are the numbers of ImageKind,
/// PointKind, EdgeKind and PixelType; what each field means stands at the record of the same name.
/// A point has observations once at most, a feature sees one point at most, and all that an element
/// names by its id stands before it.

namespace gslam {
inline namespace v1 {
namespace detail {

struct BytesSink {
  std::vector<std::uint8_t> bytes;
  void write(const std::uint8_t* data, std::size_t count) {
    bytes.insert(bytes.end(), data, data + count);
  }
};

}  // namespace detail

/// Writes a map into a file, in one step: others see the old file or the new, and a failure leaves
/// the old one as it was. Maps that are equal give the same bytes.
///
/// A symbolic link stays one, and what it leads to is replaced; a file that is there keeps its
/// mode. What is no ordinary file, such as a pipe, is written to as it is.
/// @throws FileError when it cannot be written, ArgumentError when a rotation is not finite
inline void saveMap(const std::string& path, const Map& map) {
  detail::NewFile file(path);
  detail::MapWriter<detail::NewFile>(map, file).write();
  file.commit();
}

/// Reads a map that saveMap() wrote. No count in it is believed: what it takes is about what the
/// map takes, whatever the file says. A map takes more where its ids are far apart: up to 200 times
/// the file and 16 MB; who reads files of strangers bounds their size by that.
/// @throws FileError when it cannot be read, ParseError when it is no map, has another version, is
///   damaged or not complete; it names the file and the byte
inline Map loadMap(const std::string& path) {
  detail::ByteSource source(path);
  return detail::MapReader(source).read();
}

/// What saveMap() writes, in memory.
/// @throws ArgumentError as saveMap()
inline std::vector<std::uint8_t> mapToBytes(const Map& map) {
  detail::BytesSink sink;
  detail::MapWriter<detail::BytesSink>(map, sink).write();
  return std::move(sink.bytes);  // a member is not moved by itself
}

/// What loadMap() reads, from memory.
/// @param bytes   all of a file
/// @param source  what stands for the file's name in errors
/// @throws ParseError as loadMap()
inline Map mapFromBytes(Span<const std::uint8_t> bytes, const std::string& source = "map") {
  detail::ByteSource in(bytes.data(), bytes.size(), source);
  return detail::MapReader(in).read();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MAP_FILE_H
