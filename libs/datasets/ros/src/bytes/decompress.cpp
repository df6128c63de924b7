#include "decompress.h"

#include <bzlib.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <memory>

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

// What comes out, in memory that doubles as it fills up.
class Output {
 public:
  explicit Output(std::uint64_t most) : most_(most) {
    if (most > kMostUnpacked) {
      throw Error("should unpack to " + std::to_string(most) + " bytes, more than " +
                  std::to_string(kMostUnpacked));
    }
    grow();
  }

  std::uint8_t* free() noexcept { return bytes_.data() + used_; }
  std::size_t room() const noexcept { return bytes_.size() - used_; }
  void use(std::size_t size) {
    used_ += size;
    if (room() == 0) grow();
  }

  std::vector<std::uint8_t> finish(bool must_be_full) {
    if (used_ > most_ || (must_be_full && used_ != most_)) {
      throw Error("unpacks to " + std::string(used_ > most_ ? "more than " : "") +
                  std::to_string(std::min<std::uint64_t>(used_, most_)) + " bytes, but should to " +
                  std::to_string(most_));
    }
    bytes_.resize(used_);
    return std::move(bytes_);
  }
  bool isTooMuch() const noexcept { return used_ > most_; }

 private:
  // One byte more than there may be, so that too much is seen.
  void grow() {
    const std::uint64_t wanted =
        std::max<std::uint64_t>(std::uint64_t(bytes_.size()) * 2, 1U << 16);
    bytes_.resize(static_cast<std::size_t>(std::min(wanted, most_ + 1)));
  }

  std::uint64_t most_;
  std::size_t used_ = 0;
  std::vector<std::uint8_t> bytes_;
};

std::vector<std::uint8_t> unpackZstd(Bytes packed, std::uint64_t most, bool must_be_full) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(),
                                                                        ZSTD_freeDCtx);
  if (!context) throw Error("cannot be unpacked: out of memory");
  Output output(most);
  ZSTD_inBuffer in = {packed.data(), packed.size(), 0};
  std::size_t hint = 0;
  while (in.pos < in.size || hint != 0) {
    ZSTD_outBuffer out = {output.free(), output.room(), 0};
    const std::size_t taken = in.pos;
    hint = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(hint) != 0) {
      throw Error(std::string("is no whole zstd data: ") + ZSTD_getErrorName(hint));
    }
    output.use(out.pos);
    if (output.isTooMuch()) break;
    if (in.pos == taken && out.pos == 0 && hint != 0) throw Error("ends within zstd data");
  }
  return output.finish(must_be_full);
}

}  // namespace

std::vector<std::uint8_t> unpackZstd(Bytes packed, std::uint64_t unpacked) {
  return unpackZstd(packed, unpacked, true);
}

std::vector<std::uint8_t> unpackZstd(Bytes packed) {
  return unpackZstd(packed, kMostUnpacked, false);
}

std::vector<std::uint8_t> unpackLz4(Bytes packed, std::uint64_t unpacked) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0U) {
    throw Error("cannot be unpacked: out of memory");
  }
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(
      raw, LZ4F_freeDecompressionContext);
  Output output(unpacked);
  std::size_t at = 0, hint = 0;
  while (at < packed.size() || hint != 0) {
    std::size_t out = output.room(), in = packed.size() - at;
    hint = LZ4F_decompress(context.get(), output.free(), &out, packed.data() + at, &in, nullptr);
    if (LZ4F_isError(hint) != 0U) {
      throw Error(std::string("is no whole LZ4 data: ") + LZ4F_getErrorName(hint));
    }
    at += in;
    output.use(out);
    if (output.isTooMuch()) break;
    if (in == 0 && out == 0 && hint != 0) throw Error("ends within LZ4 data");
  }
  return output.finish(true);
}

std::vector<std::uint8_t> unpackBzip2(Bytes packed, std::uint64_t unpacked) {
  bz_stream stream = {};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) {
    throw Error("cannot be unpacked: out of memory");
  }
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  constexpr std::size_t kMost = std::numeric_limits<unsigned>::max();
  if (packed.size() > kMost) throw Error("has more than 4 GiB of bzip2 data");
  Output output(unpacked);
  // bzip2 does not write through it: the API is older than const.
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));
  stream.avail_in = static_cast<unsigned>(packed.size());
  for (int result = BZ_OK; result != BZ_STREAM_END && !output.isTooMuch();) {
    const std::size_t room = std::min(output.room(), kMost);
    const unsigned in = stream.avail_in;
    stream.next_out = reinterpret_cast<char*>(output.free());
    stream.avail_out = static_cast<unsigned>(room);
    result = BZ2_bzDecompress(&stream);
    if (result != BZ_OK && result != BZ_STREAM_END) {
      throw Error("is no whole bzip2 data: error " + std::to_string(result));
    }
    const std::size_t out = room - stream.avail_out;
    output.use(out);
    const bool is_stuck = out == 0 && stream.avail_in == in;
    if (result == BZ_OK && is_stuck) throw Error("ends within bzip2 data");
  }
  return output.finish(true);
}

std::uint32_t crc32Of(Bytes bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(::crc32_z(crc, bytes.data(), bytes.size()));
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
