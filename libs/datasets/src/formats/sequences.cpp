#include "sequences.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "../reading/looks_like.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

std::string wantedSequence(const Svar& parameters) {
  const Svar value = parameters.get<Svar>("sequence", Svar());
  if (value.isNull()) return "";
  return value.is<std::int64_t>() ? std::to_string(value.as<std::int64_t>())
                                  : value.as<std::string>();
}

bool isDigits(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// The number in a name, behind some words where they are given.
bool numberBehind(const std::string& name, const std::string& words, std::size_t& number) {
  const std::size_t place = name.find(words);
  return place != std::string::npos && numberIn(name.substr(place + words.size()), number);
}

using Folders = std::vector<std::string>;

// Those that a user means by a word: the one of this path, or else all of this name, or else all of
// this number.
Folders meantBy(const FileTree& tree, const Folders& folders, const std::string& wanted,
                const std::string& number_behind) {
  if (std::find(folders.begin(), folders.end(), wanted) != folders.end()) return {wanted};
  Folders named, numbered;
  std::size_t a = 0, b = 0;
  const bool is_number = isDigits(wanted) && numberIn(wanted, a);
  for (const std::string& folder : folders) {
    const std::string name = folder.empty() ? tree.baseName() : nameIn(folder);
    if (name == wanted) named.push_back(folder);
    const bool is_same = is_number && numberBehind(name, number_behind, b) && a == b;
    if (is_same) numbered.push_back(folder);
  }
  return named.empty() ? numbered : named;
}

// The one that is meant; "" with `is_found` false where there is none.
Place choose(const FileTree& tree, const Folders& found, const std::string& wanted,
             const std::string& number_behind) {
  const Folders meant = wanted.empty() ? found : meantBy(tree, found, wanted, number_behind);
  if (meant.empty()) return {};
  if (meant.size() == 1) return {true, meant[0]};
  const std::string count = std::to_string(meant.size());
  const std::string problem =
      wanted.empty() ? "is not given, and " + tree.root() + " has " + count
                     : "is '" + wanted + "', which may be " + count + " of " + tree.root();
  throw ArgumentError("sequence", problem + "; expected one of: " + namesOfSequences(tree, meant));
}

}  // namespace

std::string chooseSequence(const FileTree& tree, const std::string& format, const Svar& parameters,
                           const std::string& expected, const std::string& number_behind) {
  const Layout& layout = layoutOf(format);
  const std::string wanted = wantedSequence(parameters);
  Folders found;
  for (const Layout::Predicate is_it : {layout.is_sure, layout.is_enough}) {
    found = findSequences(tree, layout.depth,
                          [&](const std::string& folder) { return is_it(tree, folder); });
    const Place place = choose(tree, found, wanted, number_behind);
    if (place.is_found) return place.folder;
  }
  if (found.empty()) throw FileError(tree.root(), "has no sequence, expected " + expected);
  throw ArgumentError("sequence",
                      "is '" + wanted + "', which " + tree.root() +
                          " has not; expected one of: " + namesOfSequences(tree, found));
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
