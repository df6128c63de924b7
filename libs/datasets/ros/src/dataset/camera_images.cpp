#include "camera_images.h"

#include <gslam/base/error.h>
#include <gslam/core/stamp.h>

#include <algorithm>
#include <tuple>

#include "messages/camera.h"
#include "messages/decode.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

DecodedImage decodeImage(const Recording& recording, const CameraTopic& topic,
                         const MessageRef& message, const reading::ImageShape* shape = nullptr) {
  const std::string name = nameOf(recording, message);
  const WireKind kind = wireKindOf(recording.topics()[message.topic]);
  const std::vector<std::uint8_t> bytes = recording.read(message);
  if (topic.is_compressed) {
    return decodeCompressed(decode<CompressedImageMessage>(Bytes(bytes), kind, name),
                            topic.is_depth, name, shape);
  }
  return decodeRaw(decode<ImageMessage>(Bytes(bytes), kind, name), topic.is_depth, name);
}

bool isSame(const CameraInfo& a, const CameraInfo& b) {
  const auto numbers = [](const CameraInfo& info) {
    return std::make_tuple(info.width, info.height, info.binning_x, info.binning_y, info.roi_x,
                           info.roi_y, info.roi_width, info.roi_height);
  };
  return numbers(a) == numbers(b) && a.distortion_model == b.distortion_model && a.d == b.d &&
         a.k == b.k && a.p == b.p;
}

// The first calibration counts; that it changes is said. Without stamps of headers, where little
// shall be read, only the last one is looked at.
void compareCalibrations(const Recording& recording, const CameraInfo& first,
                         std::vector<MessageRef> messages, bool by_header,
                         reading::Remarks& remarks) {
  if (!by_header) messages.erase(messages.begin(), messages.end() - 1);
  for (const MessageRef& message : messages) {
    const std::string& topic = recording.topics()[message.topic].name;
    try {
      if (isSame(first, readMessage<CameraInfo>(recording, message))) continue;
      remarks.skip("calibrations of " + topic + " that differ from the first one",
                   "at " + secondsText(message.stamp) + " s");
    } catch (const Error& error) {
      remarks.skip("calibrations of " + topic + " that cannot be read", error.what());
    }
  }
}

void readCalibration(const Recording& recording, CameraImages& camera, bool by_header,
                     reading::Remarks& remarks) {
  const std::string& topic = recording.topics()[camera.topic.images].name;
  if (camera.topic.info == kNoTopic) {
    remarks.say("camera '" + camera.sensor.name +
                "' has no calibration: there is no CameraInfo beside " + topic);
    return;
  }
  const std::vector<MessageRef> messages = recording.messages({camera.topic.info});
  if (messages.empty()) {
    remarks.say("camera '" + camera.sensor.name + "' has no calibration: " +
                recording.topics()[camera.topic.info].name + " has no message");
    return;
  }
  const auto info = readMessage<CameraInfo>(recording, messages[0]);
  const std::string name = nameOf(recording, messages[0]);
  const bool is_rectified = camera.topic.is_rectified;
  camera.sensor.camera = cameraOf(info, is_rectified, name);
  compareCalibrations(recording, info, messages, by_header, remarks);
  if (is_rectified && camera.sensor.camera.isValid() && info.p[0] != 0) {
    camera.offset = offsetOf(info);
    remarks.say("the images of " + topic + " were taken as rectified, because of its name: P of " +
                recording.topics()[camera.topic.info].name + " is the calibration");
  }
  if (!camera.sensor.camera.isValid()) {
    remarks.say("camera '" + camera.sensor.name + "' has no calibration: K is zero in " +
                recording.topics()[camera.topic.info].name);
  }
}

void checkSize(const Recording& recording, const CameraImages& camera, const Image& image) {
  const Camera& model = camera.sensor.camera;
  if (!model.isValid() || (model.width() == image.width() && model.height() == image.height())) {
    return;
  }
  throw FileError(recording.path(),
                  "the images of " + recording.topics()[camera.topic.images].name + " are " +
                      image.text() + ", but its calibration is for " +
                      std::to_string(model.width()) + " x " + std::to_string(model.height()) +
                      " pixels; camera_info=none goes without");
}

}  // namespace

std::vector<StampedImage> readStamps(const Recording& recording, std::size_t topic, bool by_header,
                                     reading::Remarks& remarks) {
  const std::string& name = recording.topics()[topic].name;
  std::vector<StampedImage> images;
  for (const MessageRef& message : recording.messages({topic})) {
    StampedImage image = {message.stamp, message};
    if (by_header) image.stamp = readHeader(recording, message).stamp;
    if (image.stamp == 0) {
      remarks.say("messages of " + name + " have no stamp: when they were received was taken");
      image.stamp = message.stamp;
    }
    images.push_back(image);
  }
  const auto earlier = [](const StampedImage& a, const StampedImage& b) {
    return a.stamp < b.stamp;
  };
  if (!std::is_sorted(images.begin(), images.end(), earlier)) {
    remarks.say("messages of " + name + " are out of order: they were sorted by their stamps");
    std::stable_sort(images.begin(), images.end(), earlier);
  }
  const auto end =
      std::unique(images.begin(), images.end(), [&](const StampedImage& a, const StampedImage& b) {
        if (a.stamp != b.stamp) return false;
        remarks.skip("messages of " + name + " with the stamp of another",
                     "at " + secondsText(b.stamp) + " s");
        return true;
      });
  images.erase(end, images.end());
  return images;
}

CameraImages readCamera(const Recording& recording, const CameraTopic& topic, bool by_header,
                        reading::Remarks& remarks) {
  CameraImages camera;
  camera.topic = topic;
  camera.sensor.name = topic.name;
  camera.images = readStamps(recording, topic.images, by_header, remarks);
  if (camera.images.empty()) {
    throw FileError(recording.path(),
                    "topic " + recording.topics()[topic.images].name + " has no image");
  }
  readCalibration(recording, camera, by_header, remarks);
  const MessageRef& first = camera.images[0].message;
  const DecodedImage image = decodeImage(recording, topic, first);
  checkSize(recording, camera, image.image);
  camera.frame_id = readHeader(recording, first).frame_id;
  camera.shape = reading::shapeOf(image.image);
  camera.sensor.kind = image.kind;
  camera.sensor.depth_scale = image.depth_scale;
  if (!image.note.empty()) {
    remarks.say("the colour filter of camera '" + topic.name + "' is " + image.note);
  }
  return camera;
}

Image loadImage(const Recording& recording, const CameraImages& camera, const MessageRef& message) {
  const DecodedImage image = decodeImage(recording, camera.topic, message, &camera.shape);
  const std::string name = nameOf(recording, message);
  reading::checkShape(image.image, camera.shape, name);
  if (image.kind != camera.sensor.kind) {
    throw FileError(name, std::string("is an image of kind ") + imageKindName(image.kind) +
                              ", expected " + imageKindName(camera.sensor.kind) +
                              " as the first of its camera");
  }
  return image.image;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
