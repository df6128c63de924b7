#include "image.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <vector>

#include "reading/decode.h"
#include "storage/text.h"
#include "wire.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

constexpr double kMillimetre = 0.001;

struct Encoding {
  const char* name;
  PixelType type;
  int channels;
  ImageKind kind;
};

// sensor_msgs/image_encodings.h.
const Encoding kEncodings[] = {{"mono8", PixelType::u8, 1, ImageKind::grey},
                               {"8UC1", PixelType::u8, 1, ImageKind::grey},
                               {"mono16", PixelType::u16, 1, ImageKind::grey},
                               {"16UC1", PixelType::u16, 1, ImageKind::depth},
                               {"32FC1", PixelType::f32, 1, ImageKind::depth},
                               {"rgb8", PixelType::u8, 3, ImageKind::rgb},
                               {"bgr8", PixelType::u8, 3, ImageKind::bgr},
                               {"8UC3", PixelType::u8, 3, ImageKind::bgr},
                               {"rgba8", PixelType::u8, 4, ImageKind::rgba},
                               {"bgra8", PixelType::u8, 4, ImageKind::bgra},
                               {"8UC4", PixelType::u8, 4, ImageKind::bgra},
                               {"rgb16", PixelType::u16, 3, ImageKind::rgb},
                               {"bgr16", PixelType::u16, 3, ImageKind::bgr},
                               {"rgba16", PixelType::u16, 4, ImageKind::rgba},
                               {"bgra16", PixelType::u16, 4, ImageKind::bgra},
                               {"bayer_rggb8", PixelType::u8, 1, ImageKind::bayer},
                               {"bayer_bggr8", PixelType::u8, 1, ImageKind::bayer},
                               {"bayer_gbrg8", PixelType::u8, 1, ImageKind::bayer},
                               {"bayer_grbg8", PixelType::u8, 1, ImageKind::bayer},
                               {"bayer_rggb16", PixelType::u16, 1, ImageKind::bayer},
                               {"bayer_bggr16", PixelType::u16, 1, ImageKind::bayer},
                               {"bayer_gbrg16", PixelType::u16, 1, ImageKind::bayer},
                               {"bayer_grbg16", PixelType::u16, 1, ImageKind::bayer}};

const Encoding& encodingOf(const std::string& encoding, const std::string& name) {
  std::string names;
  for (const Encoding& known : kEncodings) {
    if (encoding == known.name) return known;
    names += (names.empty() ? "" : ", ") + std::string(known.name);
  }
  throw ParseError(
      name, 0, 0,
      "the encoding of the image is '" + encoding.substr(0, 60) + "', expected one of " + names);
}

void setKind(DecodedImage& result, ImageKind kind, bool is_depth) {
  const PixelType type = result.image.type();
  const bool is_fine = type == PixelType::u16 || type == PixelType::f32;
  if (is_depth && kind == ImageKind::grey && is_fine) kind = ImageKind::depth;
  result.kind = kind;
  if (kind == ImageKind::depth) result.depth_scale = type == PixelType::f32 ? 1 : kMillimetre;
}

// Rows of the message to the rows of the image; bytes of a channel turned around where the other
// kind of processor wrote them.
void copyRows(const ImageMessage& message, Image& image) {
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  const bool is_big_host = first == 0;
  const std::size_t unit = pixelTypeSize(image.type());
  const bool is_turned = unit > 1 && (message.is_bigendian != 0) != is_big_host;
  const std::size_t row = image.rowBytes();
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* const from = message.data.data() + std::size_t(y) * message.step;
    std::uint8_t* const to = image.bytes(y);
    if (!is_turned) {
      std::memcpy(to, from, row);
      continue;
    }
    for (std::size_t x = 0; x < row; x += unit) {
      for (std::size_t i = 0; i < unit; ++i) to[x + i] = from[x + unit - 1 - i];
    }
  }
}

std::string sizeText(const ImageMessage& message) {
  return std::to_string(message.width) + " x " + std::to_string(message.height);
}

}  // namespace

DecodedImage decodeRaw(const ImageMessage& message, bool is_depth, const std::string& name) {
  const Encoding& encoding = encodingOf(message.encoding, name);
  constexpr std::uint32_t kMost = 1U << 20;
  if (message.width == 0 || message.height == 0 || message.width > kMost ||
      message.height > kMost) {
    throw ParseError(name, 0, 0,
                     "the image has " + sizeText(message) + " pixels, expected 1 to " +
                         std::to_string(kMost) + " a side");
  }
  const std::uint64_t row =
      std::uint64_t(message.width) * unsigned(encoding.channels) * pixelTypeSize(encoding.type);
  // Some writers leave the gap behind the last row out.
  const std::uint64_t least = std::uint64_t(message.step) * (message.height - 1) + row;
  if (message.step < row || message.data.size() < least) {
    throw ParseError(name, 0, 0,
                     "the image has " + sizeText(message) + " pixels of " + encoding.name +
                         ", a step of " + std::to_string(message.step) + " and " +
                         std::to_string(message.data.size()) + " bytes, expected a step of " +
                         std::to_string(row) + " or more, and step times height bytes");
  }
  DecodedImage result;
  result.image = Image(int(message.width), int(message.height), encoding.type, encoding.channels);
  copyRows(message, result.image);
  setKind(result, encoding.kind, is_depth);
  if (encoding.kind == ImageKind::bayer) result.note = message.encoding;
  return result;
}

namespace {

struct DepthHead {
  std::int32_t format = 0;
  float a = 0, b = 0;  // depth = a / (stored - b)
};
template <class Wire>
void describe(Wire& wire, DepthHead& head) {
  wire(head.format, head.a, head.b);
}

// compressed_depth_image_transport stores floats as inverse depth of 16 bits; 0 is none.
Image depthOfInverse(const Image& stored, const DepthHead& head) {
  Image depth(stored.width(), stored.height(), PixelType::f32);
  for (int y = 0; y < stored.height(); ++y) {
    const std::uint16_t* const from = stored.row<std::uint16_t>(y);
    float* const to = depth.row<float>(y);
    for (int x = 0; x < stored.width(); ++x) {
      const float value = static_cast<float>(from[x]);
      to[x] = from[x] == 0 ? std::numeric_limits<float>::quiet_NaN() : head.a / (value - head.b);
    }
  }
  return depth;
}

// OpenCV reads many formats, and some of its readers were written without strangers in mind.
Image decodePicture(Bytes bytes, const std::string& format, const std::string& name,
                    const reading::ImageShape* shape) {
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  const auto begins = [&](std::initializer_list<std::uint8_t> with) {
    return data.size() >= with.size() && std::equal(with.begin(), with.end(), data.begin());
  };
  const bool is_png = begins({0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'});
  if (!is_png && !begins({0xFF, 0xD8, 0xFF})) {
    throw ParseError(name, 0, 0,
                     "the image of format '" + format.substr(0, 60) + "' is neither JPEG nor PNG");
  }
  return reading::decodeImage(data, name, shape);
}

DecodedImage decodeCompressedDepth(const CompressedImageMessage& message, const std::string& name,
                                   const reading::ImageShape* shape) {
  constexpr std::size_t kHead = 12;
  if (contains(message.format, "rvl")) {
    throw ParseError(name, 0, 0, "the format '" + message.format + "' (RVL) cannot be read");
  }
  if (message.data.size() < kHead) {
    throw ParseError(name, 0, 0, "compressed depth should begin with a head of 12 bytes");
  }
  // The head is a struct as it was in memory: little-endian, as all that record.
  Ros1Wire wire(Bytes(message.data.data(), kHead), name);
  DepthHead head;
  describe(wire, head);
  DecodedImage result;
  reading::ImageShape stored;  // of floats as well 16 bits
  if (shape != nullptr) {
    stored = *shape;
    stored.type = PixelType::u16;
  }
  result.image = decodePicture(Bytes(message.data.data() + kHead, message.data.size() - kHead),
                               message.format, name, shape == nullptr ? nullptr : &stored);
  if (result.image.type() != PixelType::u16 || result.image.channels() != 1) {
    throw ParseError(
        name, 0, 0, "compressed depth is " + result.image.text() + ", expected one channel of u16");
  }
  if (contains(message.format, "32FC1")) result.image = depthOfInverse(result.image, head);
  setKind(result, ImageKind::depth, true);
  return result;
}

}  // namespace

DecodedImage decodeCompressed(const CompressedImageMessage& message, bool is_depth,
                              const std::string& name, const reading::ImageShape* shape) {
  if (contains(message.format, "compressedDepth")) {
    return decodeCompressedDepth(message, name, shape);
  }
  DecodedImage result;
  result.image = decodePicture(message.data, message.format, name, shape);
  const bool is_stored_depth = message.format.compare(0, 5, "16UC1") == 0;
  ImageKind kind = reading::kindOf(result.image, name);
  if (contains(message.format, "bayer")) {
    kind = result.image.channels() == 1 ? ImageKind::bayer : kind;
    result.note = message.format;
  }
  setKind(result, kind, is_depth || is_stored_depth);
  return result;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
