#include "topics.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <set>

#include "messages/messages.h"
#include "storage/text.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCompressed = "sensor_msgs/CompressedImage";
constexpr const char* kCameraInfo = "sensor_msgs/CameraInfo";
constexpr const char* kNone = "none";

// "/cam0/image_raw" to {"/cam0", "image_raw"}.
std::string folderOf(const std::string& topic) {
  const std::size_t slash = topic.rfind('/');
  return slash == std::string::npos ? "" : topic.substr(0, slash);
}
std::string lastOf(const std::string& topic) {
  return topic.substr(topic.rfind('/') + 1);
}

// The topic without the name of the transport at its end.
std::string baseOf(const std::string& topic) {
  const std::string last = lastOf(topic);
  return last == "compressed" || last == "compressedDepth" ? folderOf(topic) : topic;
}

// Whether a word of a name, between '/', '_', '-' and digits, is this one.
bool hasWord(const std::string& name, const std::string& word) {
  const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
  for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !is_letter(name[at - 1]);
    const bool ends = end == name.size() || !is_letter(name[end]);
    if (begins && ends) return true;
  }
  return false;
}

bool saysTruth(const std::string& topic) {
  const std::string name = lower(topic);
  for (const char* part : {"groundtruth", "ground_truth", "vicon", "optitrack", "mocap",
                           "motion_capture", "leica", "vrpn", "qualisys"}) {
    if (contains(name, part)) return true;
  }
  return hasWord(name, "gt") || hasWord(name, "truth");
}

// Names that a user gave: an array, or text with commas.
std::vector<std::string> namesOf(const Svar& value, const char* parameter) {
  std::vector<std::string> names;
  if (value.is<std::vector<std::string>>()) return value.as<std::vector<std::string>>();
  if (value.isNull()) return names;
  if (!value.is<std::string>()) {
    throw ArgumentError(parameter, "is no name of a topic, or list of such names");
  }
  std::string name;
  for (const char c : value.as<std::string>() + ",") {
    if (c != ',' && c != ' ') name += c;
    if (c != ',') continue;
    if (!name.empty()) names.push_back(name);
    name.clear();
  }
  return names;
}

class Chooser {
 public:
  Chooser(const Recording& recording, const Svar& parameters)
      : recording_(recording), parameters_(parameters) {}

  ChosenTopics run() {
    chooseCameras();
    result_.imu = chooseSensor("imu", "sensor_msgs/Imu");
    result_.gnss = chooseSensor("gnss", "sensor_msgs/NavSatFix");
    chooseTruth();
    chooseOdometry();
    for (std::size_t i = 0; i < recording_.topics().size(); ++i) {
      const bool is_transforms = typeOf(i) == "tf2_msgs/TFMessage" || typeOf(i) == "tf/tfMessage";
      const bool is_static = lastOf(recording_.topics()[i].name) == "tf_static";
      if (is_transforms && is_static) result_.transforms.push_back(i);
    }
    return std::move(result_);
  }

 private:
  std::string typeOf(std::size_t topic) const { return plainType(recording_.topics()[topic].type); }
  const std::string& nameOf(std::size_t topic) const { return recording_.topics()[topic].name; }
  bool hasMessages(std::size_t topic) const { return recording_.topics()[topic].count > 0; }

  // Topics of a type that have messages.
  std::vector<std::size_t> ofType(const std::string& type) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < recording_.topics().size(); ++i) {
      if (typeOf(i) == type && hasMessages(i)) found.push_back(i);
    }
    return found;
  }

  std::size_t named(const std::string& name, const std::string& type, const char* parameter) const {
    const std::size_t topic = find(name, parameter);
    if (typeOf(topic) != type) failType(topic, type, parameter);
    return topic;
  }

  std::size_t find(const std::string& name, const char* parameter) const {
    try {
      return recording_.topic(name);
    } catch (const FileError& error) {
      throw ArgumentError(parameter, std::string("names no topic: ") + error.what());
    }
  }

  [[noreturn]] void failType(std::size_t topic, const std::string& type,
                             const char* parameter) const {
    throw ArgumentError(parameter, "names " + nameOf(topic) + ", which is of type " +
                                       recording_.topics()[topic].type + ", expected " + type);
  }

  // --- cameras -----------------------------------------------------------------------------------

  void chooseCameras() {
    const std::vector<std::string> names = namesOf(parameters_["images"], "images");
    if (names.size() == 1 && names[0] == kNone) return;
    std::vector<std::size_t> topics;
    for (const std::string& name : names) {
      const std::size_t topic = find(name, "images");
      if (!isImages(topic)) failType(topic, "sensor_msgs/Image or CompressedImage", "images");
      topics.push_back(topic);
    }
    result_.are_cameras_named = !names.empty();
    if (names.empty()) topics = allImages();
    constexpr std::size_t kMost = 256;
    if (topics.size() > kMost) {
      throw FileError(recording_.path(), "has " + std::to_string(topics.size()) +
                                             " topics of images, more than " +
                                             std::to_string(kMost) + ": name some in `images`");
    }
    for (const std::size_t topic : topics) addCamera(topic);
    pairInfos();
    makeNamesDiffer();
  }

  bool isImages(std::size_t topic) const {
    return typeOf(topic) == kImage || typeOf(topic) == kCompressed;
  }

  // Of a camera that is there raw and compressed, raw.
  std::vector<std::size_t> allImages() const {
    std::vector<std::size_t> result = ofType(kImage);
    std::set<std::string> bases;
    for (const std::size_t topic : result) bases.insert(baseOf(nameOf(topic)));
    for (const std::size_t topic : ofType(kCompressed)) {
      if (bases.insert(baseOf(nameOf(topic))).second) result.push_back(topic);
    }
    std::sort(result.begin(), result.end(),
              [&](std::size_t a, std::size_t b) { return nameOf(a) < nameOf(b); });
    return result;
  }

  void addCamera(std::size_t topic) {
    CameraTopic camera;
    camera.images = topic;
    camera.is_compressed = typeOf(topic) == kCompressed;
    camera.is_depth = saysDepth(nameOf(topic));
    camera.is_rectified = saysRectified(nameOf(topic));
    camera.name = cameraNameOf(nameOf(topic));
    result_.cameras.push_back(camera);
  }

  void pairInfos() {
    const std::vector<std::string> names = namesOf(parameters_["camera_info"], "camera_info");
    if (names.size() == 1 && names[0] == kNone) return;
    if (!names.empty() && names.size() != result_.cameras.size()) {
      throw ArgumentError("camera_info", "has " + std::to_string(names.size()) +
                                             " topics, expected one for each of " +
                                             std::to_string(result_.cameras.size()) + " cameras");
    }
    for (std::size_t i = 0; i < result_.cameras.size(); ++i) {
      CameraTopic& camera = result_.cameras[i];
      camera.info = names.empty() ? infoBeside(baseOf(nameOf(camera.images)))
                                  : named(names[i], kCameraInfo, "camera_info");
    }
  }

  // "/cam0/camera_info" beside "/cam0/image_raw", or "/cam0/image_raw/camera_info".
  std::size_t infoBeside(const std::string& images) const {
    for (const std::size_t topic : ofType(kCameraInfo)) {
      const std::string folder = folderOf(nameOf(topic));
      if (folder == folderOf(images) || folder == images) return topic;
    }
    return kNoTopic;
  }

  void makeNamesDiffer() {
    for (std::size_t i = 0; i < result_.cameras.size(); ++i) {
      const std::string name = result_.cameras[i].name;
      for (int number = 2; isNameBefore(i); ++number) {
        result_.cameras[i].name = name + "_" + std::to_string(number);
      }
    }
  }
  bool isNameBefore(std::size_t end) const {
    const auto last = result_.cameras.begin() + std::ptrdiff_t(end);
    return std::any_of(result_.cameras.begin(), last,
                       [&](const CameraTopic& other) { return other.name == last->name; });
  }

  // --- others ------------------------------------------------------------------------------------

  std::string parameter(const char* name) const {
    const std::vector<std::string> names = namesOf(parameters_[name], name);
    if (names.size() > 1) throw ArgumentError(name, "names several topics, expected one");
    return names.empty() ? "" : names[0];
  }

  std::size_t chooseSensor(const char* name, const char* type) const {
    const std::string wanted = parameter(name);
    if (wanted == kNone) return kNoTopic;
    if (!wanted.empty()) return named(wanted, type, name);
    const std::vector<std::size_t> found = ofType(type);
    return found.empty() ? kNoTopic : found[0];
  }

  PoseTopic poseTopic(const std::string& name, const char* parameter) const {
    try {
      return findPoseTopic(recording_, name);
    } catch (const FileError& error) {
      throw ArgumentError(parameter, std::string("names no topic with poses: ") + error.what());
    }
  }

  void chooseTruth() {
    const std::string wanted = parameter("ground_truth");
    if (wanted == kNone) return;
    if (!wanted.empty()) {
      result_.truth = poseTopic(wanted, "ground_truth");
      result_.has_truth = true;
      return;
    }
    for (std::size_t i = 0; i < recording_.topics().size() && !result_.has_truth; ++i) {
      if (!isPoseType(typeOf(i)) || !hasMessages(i) || !saysTruth(nameOf(i))) continue;
      if (typeOf(i) == "tf2_msgs/TFMessage" || typeOf(i) == "tf/tfMessage") continue;
      result_.truth.topic = i;
      result_.has_truth = true;
    }
  }

  void chooseOdometry() {
    const std::string wanted = parameter("odometry");
    if (wanted == kNone) return;
    if (!wanted.empty()) {
      result_.odometry = poseTopic(wanted, "odometry");
      result_.has_odometry = true;
      return;
    }
    if (!result_.cameras.empty()) return;
    for (const std::size_t topic : ofType("nav_msgs/Odometry")) {
      if (result_.has_truth && result_.truth.topic == topic) continue;
      result_.odometry.topic = topic;
      result_.has_odometry = true;
      return;
    }
  }

  const Recording& recording_;
  const Svar& parameters_;
  ChosenTopics result_;
};

}  // namespace

ChosenTopics chooseTopics(const Recording& recording, const Svar& parameters) {
  return Chooser(recording, parameters).run();
}

bool isUsed(const ChosenTopics& topics, std::size_t topic) {
  for (const CameraTopic& camera : topics.cameras) {
    if (camera.images == topic || camera.info == topic) return true;
  }
  const auto& fixed = topics.transforms;
  return topics.imu == topic || topics.gnss == topic ||
         (topics.has_truth && topics.truth.topic == topic) ||
         (topics.has_odometry && topics.odometry.topic == topic) ||
         std::find(fixed.begin(), fixed.end(), topic) != fixed.end();
}

bool saysRectified(const std::string& topic) {
  const std::string last = lower(lastOf(baseOf(topic)));
  return hasWord(last, "rect") || hasWord(last, "rectified");
}

bool saysDepth(const std::string& topic) {
  const std::string name = lower(topic);
  return hasWord(name, "depth") || hasWord(name, "depthmap") || hasWord(name, "compresseddepth");
}

std::string cameraNameOf(const std::string& topic) {
  std::string path = baseOf(topic);
  // What the last part says of the processing is no part of the camera's name.
  if (lastOf(path).compare(0, 5, "image") == 0 && !folderOf(path).empty()) path = folderOf(path);
  std::string name;
  for (const char c : path) {
    if (c != '/') name += c;
    if (c == '/' && !name.empty()) name += '_';
  }
  return name.empty() ? "camera" : name;
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
