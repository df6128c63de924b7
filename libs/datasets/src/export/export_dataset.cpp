#include <gslam/base/error.h>
#include <gslam/datasets/export_dataset.h>

#include <map>
#include <memory>
#include <string>

#include "export_folder.h"
#include "layouts.h"
#include "source.h"

namespace gslam {
inline namespace v1 {
namespace {

using exporting::ExportFolder;
using exporting::Layout;
using exporting::Source;

constexpr std::size_t kMostUnexported = 100;  // in a row

struct KnownFormat {
  const char* name;
  const char* summary;
  std::unique_ptr<Layout> (*make)(Source&);
};

const KnownFormat kFormats[] = {
    {"tum", "TUM RGB-D: a colour camera, its depth, acceleration", &exporting::makeTum},
    {"euroc", "EuRoC MAV: grey cameras and an IMU, with calibrations", &exporting::makeEuroc},
    {"kitti", "KITTI odometry: a rectified grey pair", &exporting::makeKitti},
    {"icl", "ICL-NUIM, its form for TUM's tools: a colour camera, its depth", &exporting::makeIcl},
    {"tummono", "TUM monoVO: a grey camera with exposures", &exporting::makeTummono},
    {"tumvi", "TUM-VI: fisheye cameras of 16 bits and an IMU", &exporting::makeTumvi},
};

const KnownFormat& findFormat(const std::string& name) {
  std::string names;
  for (const KnownFormat& format : kFormats) {
    if (name == format.name) return format;
    names += (names.empty() ? "" : ", ") + std::string(format.name);
  }
  throw ArgumentError("format", "is '" + name + "', expected one of " + names);
}

// Takes frames to a layout, and counts what happens to them.
class Exporter {
 public:
  Exporter(Dataset& dataset, Source& source, Layout& layout, ExportFolder& folder,
           const ExportOptions& options)
      : dataset_(dataset), source_(source), layout_(layout), folder_(folder), options_(options) {}

  // When it fails, what is left are whole frames.
  void run(ExportReport& report) {
    try {
      runToTheEnd(report);
    } catch (...) {
      folder_.abandon();
      throw;
    }
  }

 private:
  void runToTheEnd(ExportReport& report) {
    layout_.begin(folder_);
    folder_.keep();
    for (std::size_t done = 0; done < options_.count;) {
      if (options_.stop != nullptr && options_.stop->load()) {
        report.is_stopped = true;
        break;
      }
      std::shared_ptr<const Frame> frame;
      if (read(frame) && frame == nullptr) break;
      ++done;
      if (frame != nullptr && write(*frame)) ++report.frames;
      folder_.keep();
      if (options_.progress) options_.progress(done, total());
    }
    layout_.finish();
    folder_.keep();
    if (report.frames == 0 && !first_failure_.empty()) {
      throw Error("no frame could be written: " + first_failure_);
    }
  }

  std::size_t total() const {
    const std::size_t count = source_.info().frame_count;
    return count < options_.count ? count : options_.count;
  }

  bool read(std::shared_ptr<const Frame>& frame) {
    try {
      frame = dataset_.next();
      return true;
    } catch (const Error& error) {
      fail(std::string("cannot be read: ") + error.what(), "cannot be read, such as ",
           error.what());
      return false;
    }
  }

  bool write(const Frame& frame) {
    layout_.writeSamples(frame);
    if (has_stamp_ && frame.stamp <= stamp_) {
      source_.notes.count("frames", "not later than the one before");
      return false;
    }
    try {
      layout_.prepare(frame);
    } catch (const Error& error) {
      const std::string name = "frame " + std::to_string(frame.id);
      fail(name + ": " + error.what(), "cannot be written, such as " + name + ": ", error.what());
      return false;
    }
    layout_.commit();
    has_stamp_ = true;
    stamp_ = frame.stamp;
    failures_ = 0;
    return true;
  }

  // Counts a frame that is left out; the first reason stands for all of its kind.
  void fail(const std::string& message, const std::string& kind, const char* reason) {
    if (first_failure_.empty()) first_failure_ = message;
    std::string& shown = reasons_[kind.substr(0, kind.find(','))];
    if (shown.empty()) shown = kind + reason;
    source_.notes.count("frames", shown);
    if (++failures_ < kMostUnexported) return;
    throw Error(std::to_string(kMostUnexported) + " frames in a row cannot be read or written; " +
                message);
  }

  Dataset& dataset_;
  Source& source_;
  Layout& layout_;
  ExportFolder& folder_;
  const ExportOptions& options_;
  bool has_stamp_ = false;
  std::int64_t stamp_ = 0;
  std::size_t failures_ = 0;  // in a row
  std::string first_failure_;
  std::map<std::string, std::string> reasons_;
};

}  // namespace

std::vector<ExportFormat> exportFormats() {
  std::vector<ExportFormat> formats;
  for (const KnownFormat& format : kFormats) formats.push_back({format.name, format.summary});
  return formats;
}

ExportReport exportDataset(Dataset& dataset, const std::string& folder, const std::string& format,
                           const ExportOptions& options) {
  const KnownFormat& known = findFormat(format);
  Source source(dataset.info(), format, options);
  const std::unique_ptr<Layout> layout = known.make(source);
  if (dataset.info().ground_truth.empty()) {
    source.notes.remark("the dataset has no ground truth");
  }
  ExportFolder files(folder);
  ExportReport report;
  Exporter(dataset, source, *layout, files, options).run(report);
  report.files = files.fileCount();
  report.bytes = files.byteCount();
  source.notes.moveTo(report);
  return report;
}

}  // namespace v1
}  // namespace gslam
