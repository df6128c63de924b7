// What a SLAM system in a child process and its host tell each other.
#ifndef GSLAM_CORE_DETAIL_ISOLATION_MESSAGES_H
#define GSLAM_CORE_DETAIL_ISOLATION_MESSAGES_H

#include <gslam/core/build_facts.h>
#include <gslam/core/detail/exception_text.h>
#include <gslam/core/detail/message_bytes.h>
#include <gslam/core/frame.h>
#include <gslam/core/registry.h>
#include <gslam/core/rig.h>
#include <gslam/core/slam.h>
#include <gslam/svar/json.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

constexpr std::uint32_t kIsolationProtocol = 1;
constexpr std::uint32_t kMessageMagic = 0x4D534947;  // "GISM"

enum class MessageKind : std::uint32_t {
  // From the host.
  create = 1,
  configure,
  feed,
  map,
  finish,
  quit,
  // From the child: the end of what was asked for, and what comes before it.
  done = 100,
  thrown,
  pose,
  log
};

struct MessageHead {
  std::uint32_t magic;
  MessageKind kind;
  std::uint64_t size;  // of what follows, bytes
};

// A plugin's exception, as far as it crosses to another process.
struct ThrownMessage {
  enum Kind : std::uint32_t { other, argument, file, parse } kind = other;
  std::string what;
  std::string about;  // argument, path or source
  std::uint64_t line = 0, column = 0;
};

// Where an image is in shared memory, and what it is.
struct SharedImage {
  std::uint64_t offset = 0;  // in the slot
  std::uint64_t stride = 0;
  std::int32_t width = 0, height = 0;
  std::uint32_t channels = 1;
  PixelType type = PixelType::u8;
};

// A place for the pixels of a frame. It begins with a word that is 0 when it is free.
struct SharedSlot {
  std::uint64_t offset = 0;  // in the shared memory
  std::uint64_t size = 0;    // 0: none, there are no pixels
};

inline void writeBoolean(MessageWriter& out, bool value) {
  out.raw(std::uint8_t(value ? 1 : 0));
}

// What is known of a SLAM system before it is configured.
inline void writeFactory(MessageWriter& out, const SlamFactory& factory) {
  out.text(factory.name);
  out.text(factory.description);
  out.text(printJson(factory.parameters));
  out.text(printJson(factory.help));
  out.raw(std::int32_t(factory.needs.cameras));
  writeBoolean(out, factory.needs.depth);
  writeBoolean(out, factory.needs.imu);
  writeBoolean(out, factory.needs.gnss);
  writeBoolean(out, factory.needs.calibration);
}

inline SlamFactory readFactory(MessageReader& in) {
  SlamFactory factory;
  factory.name = in.text();
  factory.description = in.text();
  factory.parameters = parseJson(in.text(), "parameters");
  factory.help = parseJson(in.text(), "help");
  factory.needs.cameras = in.number<std::int32_t>();
  factory.needs.depth = in.boolean();
  factory.needs.imu = in.boolean();
  factory.needs.gnss = in.boolean();
  factory.needs.calibration = in.boolean();
  in.expectEnd();
  return factory;
}

inline void writeSensors(MessageWriter& out, const SensorRig& rig) {
  out.raw(std::uint64_t(rig.cameras.size()));
  for (const CameraSensor& one : rig.cameras) {
    out.text(one.name);
    out.raw(one.kind);
    out.raw(one.camera);
    out.raw(one.T_body_camera);
    out.raw(one.rate);
    out.raw(one.depth_scale);
  }
  writeBoolean(out, rig.has_imu);
  out.raw(rig.imu);
  writeBoolean(out, rig.has_gnss);
  out.raw(rig.gnss_antenna);
}

inline SensorRig readSensors(MessageReader& in) {
  SensorRig rig;
  rig.cameras.resize(in.count(sizeof(Camera)));
  for (CameraSensor& one : rig.cameras) {
    one.name = in.text();
    in.raw(one.kind);
    in.raw(one.camera);
    in.raw(one.T_body_camera);
    in.raw(one.rate);
    in.raw(one.depth_scale);
  }
  rig.has_imu = in.boolean();
  in.raw(rig.imu);
  rig.has_gnss = in.boolean();
  in.raw(rig.gnss_antenna);
  return rig;
}

// All of a frame but its pixels, of which `images` says where they are.
inline void writeFrame(MessageWriter& out, const Frame& frame, const SharedSlot& slot,
                       const std::vector<SharedImage>& images) {
  out.raw(frame.id);
  out.raw(frame.stamp);
  out.raw(slot);
  out.raw(std::uint64_t(frame.images.size()));
  for (std::size_t i = 0; i < frame.images.size(); ++i) {
    const CameraImage& one = frame.images[i];
    out.raw(images[i]);
    out.raw(one.camera);
    out.raw(one.T_body_camera);
    out.raw(one.exposure);
    out.raw(one.depth_scale);
    out.raw(one.kind);
    out.text(one.name);
  }
  out.list(frame.imu);
  out.raw(frame.imu_calibration);
  out.list(frame.gnss);
  writeBoolean(out, frame.has_prior);
  out.raw(frame.prior);
}

// `attach(slot, images, frame)` gives it its pixels.
template <class Attach>
void readFrame(MessageReader& in, Frame& frame, const Attach& attach) {
  SharedSlot slot;
  in.raw(frame.id);
  in.raw(frame.stamp);
  in.raw(slot);
  const std::size_t count = in.count(sizeof(SharedImage) + sizeof(Camera));
  std::vector<SharedImage> images(count);
  frame.images.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    CameraImage& one = frame.images[i];
    in.raw(images[i]);
    in.raw(one.camera);
    in.raw(one.T_body_camera);
    in.raw(one.exposure);
    in.raw(one.depth_scale);
    in.raw(one.kind);
    one.name = in.text();
  }
  frame.imu = in.list<ImuSample>();
  in.raw(frame.imu_calibration);
  frame.gnss = in.list<GnssSample>();
  frame.has_prior = in.boolean();
  in.raw(frame.prior);
  in.expectEnd();
  attach(slot, images, frame);
}

inline void writePose(MessageWriter& out, const TrackedPose& pose) {
  out.raw(pose.frame);
  out.raw(pose.stamp);
  out.raw(pose.T_world_body);
  out.raw(static_cast<std::uint8_t>(pose.state));
}

inline TrackedPose readPose(MessageReader& in) {
  TrackedPose pose;
  in.raw(pose.frame);
  in.raw(pose.stamp);
  in.raw(pose.T_world_body);
  const std::uint8_t state = in.number<std::uint8_t>();
  if (state > static_cast<std::uint8_t>(TrackingState::lost)) {
    throw Error("a message has a tracking state " + std::to_string(state) + ", which there is not");
  }
  pose.state = static_cast<TrackingState>(state);
  in.expectEnd();
  return pose;
}

inline void writeThrown(MessageWriter& out, const ThrownMessage& thrown) {
  out.raw(thrown.kind);
  out.text(thrown.what);
  out.text(thrown.about);
  out.raw(thrown.line);
  out.raw(thrown.column);
}

inline ThrownMessage readThrown(MessageReader& in) {
  ThrownMessage thrown;
  const std::uint32_t kind = in.number<std::uint32_t>();
  thrown.kind =
      kind <= ThrownMessage::parse ? static_cast<ThrownMessage::Kind>(kind) : ThrownMessage::other;
  thrown.what = in.text();
  thrown.about = in.text();
  in.raw(thrown.line);
  in.raw(thrown.column);
  in.expectEnd();
  return thrown;
}

// The exception that is being handled.
inline ThrownMessage currentException() {
  ThrownMessage thrown;
  try {
    throw;
  } catch (const ArgumentError& error) {
    thrown.kind = ThrownMessage::argument;
    thrown.what = error.what();
    thrown.about = error.argument();
  } catch (const FileError& error) {
    thrown.kind = ThrownMessage::file;
    thrown.what = error.what();
    thrown.about = error.path();
  } catch (const ParseError& error) {
    thrown.kind = ThrownMessage::parse;
    thrown.what = error.what();
    thrown.about = error.source();
    thrown.line = error.line();
    thrown.column = error.column();
  } catch (...) {
    thrown.what = exceptionText();
  }
  return thrown;
}

// A text without the beginning that a constructor puts there again.
inline std::string withoutStart(const std::string& text, std::size_t size) {
  return text.substr(std::min(size, text.size()));
}

[[noreturn]] inline void rethrow(const ThrownMessage& thrown) {
  switch (thrown.kind) {
    case ThrownMessage::argument:
      throw ArgumentError(thrown.about, withoutStart(thrown.what, thrown.about.size() + 1));
    case ThrownMessage::file:
      throw FileError(thrown.about, withoutStart(thrown.what, thrown.about.size() + 2));
    case ThrownMessage::parse: {
      const std::size_t line = std::size_t(thrown.line), column = std::size_t(thrown.column);
      const std::string bare = ParseError(thrown.about, line, column, "").what();
      throw ParseError(thrown.about, line, column, withoutStart(thrown.what, bare.size()));
    }
    case ThrownMessage::other:
      break;
  }
  throw Error(thrown.what);
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_ISOLATION_MESSAGES_H
