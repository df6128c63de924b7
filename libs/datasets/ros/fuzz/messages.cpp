// Any bytes are a message of any type, or are refused with an error. The first byte chooses the
// serialization, the second the type.
#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <string>

#include "messages/camera.h"
#include "messages/decode.h"
#include "messages/image.h"

namespace {

using namespace gslam::ros;  // NOLINT(google-build-using-namespace): what is fuzzed

void decodeAny(std::uint8_t type, Bytes bytes, WireKind kind, const std::string& name) {
  switch (type % 10) {
    case 0:
      decodeRaw(decode<ImageMessage>(bytes, kind, name), type >= 128, name);
      break;
    case 1:
      decodeCompressed(decode<CompressedImageMessage>(bytes, kind, name), type >= 128, name);
      break;
    case 2:
      cameraOf(decode<CameraInfo>(bytes, kind, name), type >= 128, name);
      break;
    case 3:
      decode<ImuMessage>(bytes, kind, name);
      break;
    case 4:
      decode<NavSatFix>(bytes, kind, name);
      break;
    case 5:
      decode<TfMessage>(bytes, kind, name);
      break;
    case 6:
      decode<Odometry>(bytes, kind, name);
      break;
    case 7:
      decode<PoseStamped>(bytes, kind, name);
      break;
    case 8:
      decode<PoseWithCovarianceStamped>(bytes, kind, name);
      break;
    default:
      decode<PointStamped>(bytes, kind, name);
      break;
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer looks for this name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const WireKind kind = data[0] % 2 == 0 ? WireKind::ros1 : WireKind::cdr;
  try {
    decodeAny(data[1], Bytes(data + 2, size - 2), kind, "fuzz");
  } catch (const gslam::Error&) {  // NOLINT(bugprone-empty-catch): what most inputs get
  }
  return 0;
}
