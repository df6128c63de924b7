#ifndef GSLAM_VOCABULARY_GZIP_H
#define GSLAM_VOCABULARY_GZIP_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/vocabulary/detail/mapped_file.h>
#include <gslam/vocabulary/load.h>
#include <gslam/vocabulary/vocabulary.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// @file
/// Vocabularies that are compressed by gzip: orbvoc.yml.gz. Needs zlib, which who includes this
/// links (ZLIB::ZLIB, -lz); nothing else of GSLAM does.

namespace gslam {
inline namespace v1 {
namespace detail {

// Unpacks all members of a gzip file, one after the other.
class GzipReader {
 public:
  GzipReader(const std::uint8_t* data, std::size_t size, std::size_t most, const std::string& name)
      : data_(data), size_(size), most_(most), name_(name) {
    const int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_alone) != Z_OK) throw Error(name + ": zlib cannot be used");
  }
  ~GzipReader() { inflateEnd(&stream_); }
  GzipReader(const GzipReader&) = delete;
  GzipReader& operator=(const GzipReader&) = delete;

  std::vector<std::uint8_t> read() {
    do {
      readMember();
    } while (!isPadding());
    bytes_.resize(used_);
    return std::move(bytes_);
  }

 private:
  // As gzip does: zeros fill the blocks of a tape.
  bool isPadding() const noexcept {
    return std::all_of(data_ + offset_, data_ + size_, [](std::uint8_t byte) { return byte == 0; });
  }

  enum : std::size_t { kPiece = std::size_t(1) << 16 };

  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(name_, 0, 0, "byte " + std::to_string(offset_) + ": " + problem);
  }

  void readMember() {
    if (inflateReset(&stream_) != Z_OK) fail("zlib cannot be used");
    int state = Z_OK;
    while (state != Z_STREAM_END) {
      if (offset_ == size_) fail("the compressed data end too early");
      state = readPiece();
      if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) {
        fail(std::string("no data compressed by gzip: ") +
             (stream_.msg != nullptr ? stream_.msg : "they are damaged"));
      }
    }
  }

  // Room grows with what was unpacked, not with what a header promises.
  int readPiece() {
    if (bytes_.size() - used_ < kPiece) {
      if (used_ == most_) fail("there are more than " + std::to_string(most_) + " bytes in it");
      bytes_.resize(std::min(most_, std::max(bytes_.size() * 2, used_ + 4 * kPiece)));
    }
    const std::size_t most_input = std::size_t(1) << 30;  // zlib counts in 32 bits
    const auto input = static_cast<uInt>(std::min(size_ - offset_, most_input));
    const auto room = static_cast<uInt>(std::min(bytes_.size() - used_, most_input));
    stream_.next_in = const_cast<Bytef*>(data_ + offset_);  // which it does not change
    stream_.avail_in = input;
    stream_.next_out = bytes_.data() + used_;
    stream_.avail_out = room;
    const int state = inflate(&stream_, Z_NO_FLUSH);
    offset_ += input - stream_.avail_in;
    used_ += room - stream_.avail_out;
    return state;
  }

  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t most_;
  const std::string& name_;
  std::size_t offset_ = 0;  // in the data
  std::vector<std::uint8_t> bytes_;
  std::size_t used_ = 0;  // of `bytes_`
  z_stream stream_ = {};
};

}  // namespace detail

/// Loads a vocabulary of any kind that loadVocabulary() knows, compressed by gzip or not.
/// @param path  the file
/// @param most  bytes that may be in it, unpacked; the largest known are 0.2 GB
/// @throws FileError when it cannot be read; ParseError when it is damaged, or holds more
inline Vocabulary loadGzippedVocabulary(const std::string& path, std::size_t most = std::size_t(1)
                                                                                    << 31) {
  const detail::MappedFile file(path);
  const auto* const data = static_cast<const std::uint8_t*>(file.data());
  if (!detail::beginsWith(data, file.size(), "\x1F\x8B")) return loadVocabulary(path);
  const std::vector<std::uint8_t> bytes = detail::GzipReader(data, file.size(), most, path).read();
  return loadVocabulary(Span<const std::uint8_t>(bytes), path);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_GZIP_H
