#include "folder.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/svar_formats/yaml.h>

#include <algorithm>

#include "../bytes/byte_source.h"
#include "file_kind.h"
#include "text.h"

namespace gslam {
inline namespace v1 {
namespace ros {
namespace {

constexpr const char* kMetadata = "metadata.yaml";
constexpr const char* kRoot = "rosbag2_bagfile_information";
constexpr std::uint64_t kMostMetadata = 64U << 20;

bool isFile(const std::string& path) {
  return detail::fileKind(path) == detail::FileKind::file;
}

std::string pathIn(const std::string& folder, const std::string& name) {
  return folder.empty() || folder.back() == '/' ? folder + name : folder + "/" + name;
}

// Files of a folder that has no metadata.
std::vector<std::string> recordingsIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const std::string& name : detail::namesIn(folder)) {
    const RecordingKind kind = fileKindOf(name);
    if (kind == RecordingKind::none || kind == RecordingKind::bag) continue;
    if (isFile(pathIn(folder, name))) files.push_back(pathIn(folder, name));
  }
  return files;
}

std::string readText(const std::string& path) {
  const auto file = openFile(path);
  if (file->size() > kMostMetadata) throw FileError(path, "is too large for metadata");
  const auto bytes = file->read(0, file->size());
  return std::string(bytes.begin(), bytes.end());
}

// metadata.yaml of old versions has names with the folder's name before them.
std::string nameIn(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

// Its messages would come twice.
void checkTwins(std::vector<std::string> files, const std::string& metadata) {
  std::sort(files.begin(), files.end());
  const auto twin = std::adjacent_find(files.begin(), files.end());
  if (twin != files.end()) throw FileError(metadata, "names the file " + *twin + " twice");
}

void checkCompression(const Svar& root, const std::string& metadata, RecordingFolder& result) {
  const std::string mode = lower(root.get<std::string>("compression_mode", ""));
  const std::string format = root.get<std::string>("compression_format", "");
  if (mode.empty() || mode == "none" || mode == "storage") return;
  if (mode == "file") {
    throw FileError(metadata, "says that the files are compressed as a whole, by '" + format +
                                  "': unpack them, and take the line compression_mode out of it");
  }
  if (mode != "message" || format != "zstd") {
    throw FileError(metadata, "says compression_mode '" + mode + "' and compression_format '" +
                                  format + "', expected messages by zstd, or none");
  }
  result.are_messages_packed = true;
}

}  // namespace

RecordingFolder readFolder(const std::string& folder) {
  RecordingFolder result;
  const std::string metadata = pathIn(folder, kMetadata);
  if (!isFile(metadata)) {
    result.files = recordingsIn(folder);
    if (result.files.empty()) {
      throw FileError(folder,
                      "is no recording, expected metadata.yaml, or files that end in .db3 "
                      "or .mcap");
    }
    result.remarks.push_back(metadata + " does not exist: all recordings in the folder were taken");
    return result;
  }
  const Svar yaml = parseYaml(readText(metadata), metadata);
  try {
    const Svar root = yaml.get<Svar>(kRoot);
    for (const Svar& name : root.get<Svar>("relative_file_paths")) {
      result.files.push_back(pathIn(folder, nameIn(name.as<std::string>())));
    }
    checkCompression(root, metadata, result);
    const Svar count = root["message_count"];
    result.has_count = count.is<std::size_t>();
    if (result.has_count) result.message_count = count.as<std::size_t>();
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(metadata, std::string("is no metadata of ROS 2: ") + error.what());
  }
  if (result.files.empty()) throw FileError(metadata, "names no file in relative_file_paths");
  checkTwins(result.files, metadata);
  return result;
}

bool isRecordingFolder(const std::string& folder) {
  const std::string metadata = pathIn(folder, kMetadata);
  if (!isFile(metadata)) return !recordingsIn(folder).empty();
  try {
    const auto file = openFile(metadata);
    const auto bytes = file->read(0, std::min<std::uint64_t>(file->size(), 4096));
    return std::string(bytes.begin(), bytes.end()).find(kRoot) != std::string::npos;
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace ros
}  // namespace v1
}  // namespace gslam
