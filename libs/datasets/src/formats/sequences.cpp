#include "sequences.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

using IsSequence = std::function<bool(const std::string& folder)>;

// Folders that are sequences, by depth and name. Nothing inside of one is looked at.
std::vector<std::string> findSequences(const FileTree& tree, int depth, const IsSequence& is_it) {
  constexpr std::size_t kMostFolders = 1000;
  std::vector<std::string> found;
  std::vector<std::pair<std::string, int>> queue = {{"", 0}};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::pair<std::string, int> here = queue[i];
    if (is_it(here.first)) {
      found.push_back(here.first);
    } else if (here.second < depth) {
      for (const std::string& name : tree.folders(here.first)) {
        if (queue.size() == kMostFolders) break;
        queue.emplace_back(joined(here.first, name), here.second + 1);
      }
    }
  }
  return found;
}

std::string wantedSequence(const Svar& parameters) {
  const Svar value = parameters.get<Svar>("sequence", Svar());
  if (value.isNull()) return "";
  return value.is<std::int64_t>() ? std::to_string(value.as<std::int64_t>())
                                  : value.as<std::string>();
}

bool isDigits(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

bool isNamed(const FileTree& tree, const std::string& folder, const std::string& wanted) {
  const std::string name = folder.empty() ? tree.baseName() : nameIn(folder);
  std::size_t a = 0, b = 0;
  if (name == wanted || folder == wanted) return true;
  return isDigits(wanted) && numberIn(name, a) && numberIn(wanted, b) && a == b;
}

std::string listOf(const FileTree& tree, const std::vector<std::string>& folders) {
  constexpr std::size_t kMostNamed = 30;
  std::string list;
  for (std::size_t i = 0; i < folders.size() && i < kMostNamed; ++i) {
    list += (list.empty() ? "" : ", ") + (folders[i].empty() ? tree.baseName() : folders[i]);
  }
  return list + (folders.size() > kMostNamed ? ", ..." : "");
}

}  // namespace

std::string chooseSequence(const FileTree& tree, int depth, const IsSequence& is_it,
                           const Svar& parameters, const std::string& expected) {
  const std::vector<std::string> found = findSequences(tree, depth, is_it);
  if (found.empty()) throw FileError(tree.root(), "has no sequence, expected " + expected);
  const std::string wanted = wantedSequence(parameters);
  if (wanted.empty() && found.size() == 1) return found[0];
  const std::string list = "expected one of: " + listOf(tree, found);
  if (wanted.empty()) {
    throw ArgumentError("sequence", "is not given, and " + tree.root() + " has " +
                                        std::to_string(found.size()) + "; " + list);
  }
  for (const std::string& folder : found) {
    if (isNamed(tree, folder, wanted)) return folder;
  }
  throw ArgumentError("sequence",
                      "is '" + wanted + "', which " + tree.root() + " has not; " + list);
}

bool numberIn(const std::string& name, std::size_t& number) {
  const char* const digits = "0123456789";
  const std::size_t begin = name.find_first_of(digits);
  if (begin == std::string::npos) return false;
  const std::size_t first = std::min(name.find_first_not_of('0', begin), name.size());
  const std::size_t end = std::min(name.find_first_not_of(digits, begin), name.size());
  if (first < end && end - first > 9) return false;
  number = 0;
  for (std::size_t i = begin; i < end; ++i) {
    number = number * 10 + static_cast<std::size_t>(name[i] - '0');
  }
  return true;
}

ImageShape shapeOfFile(const FileTree& tree, const std::string& file) {
  return shapeOf(readImage(tree, file));
}

CameraSensor cameraOf(const std::string& name, const Camera& camera) {
  CameraSensor sensor;
  sensor.name = name;
  sensor.camera = camera;
  return sensor;
}

std::string countText(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
