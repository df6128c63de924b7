#include "frame_log.h"

#include <gslam/base/error.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

namespace app {
namespace {

using gslam::FrameTime;

std::string headOf(const std::string& csv) {
  return csv.substr(0, csv.find('\n'));
}

std::string header() {
  return headOf(gslam::frameTimesCsv({})) + ",unreadable\n";
}

// The line of a frame, which is behind the header.
std::string lineOf(const FrameTime& frame) {
  const std::string csv = gslam::frameTimesCsv({frame});
  return headOf(csv.substr(csv.find('\n') + 1)) + ",0\n";
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = line.find(',', begin);
    fields.push_back(line.substr(begin, end - begin));
    if (end == std::string::npos) return fields;
    begin = end + 1;
  }
}

std::string unreadableLine() {
  return std::string(split(header()).size() - 1, ',') + "1\n";
}

gslam::TrackingState stateCalled(const std::string& name) {
  using gslam::TrackingState;
  for (const TrackingState state :
       {TrackingState::starting, TrackingState::tracking, TrackingState::guessed}) {
    if (name == gslam::trackingStateName(state)) return state;
  }
  return TrackingState::lost;
}

// The fields of one line, by the names of their columns.
class Line {
 public:
  Line(const std::vector<std::string>& names, const std::string& text, const std::string& path,
       std::size_t number)
      : fields_(split(text)) {
    if (fields_.size() != names.size()) {
      throw gslam::ParseError(path, number, 0,
                              "has " + std::to_string(fields_.size()) + " fields, expected " +
                                  std::to_string(names.size()));
    }
    for (std::size_t i = 0; i < names.size(); ++i) places_[names[i]] = i;
  }

  std::string text(const char* name) const {
    const auto place = places_.find(name);
    return place == places_.end() ? "" : fields_[place->second];
  }
  double number(const char* name) const { return std::strtod(text(name).c_str(), nullptr); }
  std::int64_t whole(const char* name) const {
    return std::strtoll(text(name).c_str(), nullptr, 10);
  }
  std::uint64_t count(const char* name) const {
    return std::strtoull(text(name).c_str(), nullptr, 10);
  }

 private:
  std::vector<std::string> fields_;
  std::map<std::string, std::size_t> places_;
};

FrameTime frameOf(const Line& line) {
  FrameTime frame;
  frame.frame = line.count("frame");
  frame.stamp = line.whole("stamp_ns");
  frame.delivered = line.whole("delivered_ns");
  frame.is_dropped = line.count("dropped") != 0;
  frame.has_result = !line.text("wall_ms").empty();
  frame.wall_ms = line.number("wall_ms");
  frame.feed_ms = line.number("feed_ms");
  frame.cpu_ms = line.number("cpu_ms");
  frame.allocations = line.count("allocations");
  frame.allocated_bytes = line.count("allocated_bytes");
  frame.has_allocations = !line.text("allocations").empty();
  frame.cpu_ms_before = line.number("cpu_ms_before");
  frame.allocations_before = line.count("allocations_before");
  frame.allocated_bytes_before = line.count("allocated_bytes_before");
  frame.state = stateCalled(line.text("state"));
  frame.corrections = line.count("corrections");
  return frame;
}

}  // namespace

FrameLog::FrameLog(const std::string& path) : file_(path) {
  file_.append(header());
}

void FrameLog::add(const FrameTime& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  file_.append(lineOf(frame));
}

void FrameLog::addUnreadable() {
  const std::lock_guard<std::mutex> lock(mutex_);
  file_.append(unreadableLine());
}

FrameRecords readFrames(const std::string& path) {
  FrameRecords records;
  std::ifstream in(path);
  std::string text;
  if (!std::getline(in, text)) return records;
  const std::vector<std::string> names = split(text);
  std::map<std::uint64_t, FrameTime> by_id;
  for (std::size_t number = 2; std::getline(in, text) && !in.eof();
       ++number) {                               // a last line without end
    const Line line(names, text, path, number);  // was cut off
    if (line.count("unreadable") != 0) {
      ++records.unreadable;
    } else {
      const FrameTime frame = frameOf(line);
      by_id[frame.frame] = frame;
    }
  }
  for (const auto& frame : by_id) records.frames.push_back(frame.second);
  return records;
}

void writeFrames(const std::string& path, const FrameRecords& records) {
  std::string text = header();
  for (const FrameTime& frame : records.frames) text += lineOf(frame);
  for (std::size_t i = 0; i < records.unreadable; ++i) text += unreadableLine();
  const std::string whole = path + ".new";
  {
    LineFile file(whole);
    file.append(text);
    file.check();
  }
  if (std::rename(whole.c_str(), path.c_str()) != 0) {
    throw gslam::FileError(path, "cannot be written", errno);
  }
}

}  // namespace app
