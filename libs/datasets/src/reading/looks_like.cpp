#include "looks_like.h"

#include <gslam/base/error.h>
#include <gslam/core/detail/field_reader.h>
#include <gslam/core/detail/shared_library.h>
#include <gslam/datasets/formats.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "photo_facts.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

using Files = const FileTree&;
using Folder = const std::string&;

bool hasFileLike(Files tree, Folder folder, const std::string& begin, const std::string& end) {
  const std::vector<std::string>& files = tree.files(folder);
  return std::any_of(files.begin(), files.end(), [&](const std::string& name) {
    return name.size() > begin.size() + end.size() && name.compare(0, begin.size(), begin) == 0 &&
           endsWith(name, end);
  });
}

const std::string* firstImage(Files tree, Folder folder) {
  const std::vector<std::string>& files = tree.files(folder);
  const auto found = std::find_if(files.begin(), files.end(), isImageName);
  return found == files.end() ? nullptr : &*found;
}

bool hasKittiImages(Files tree, Folder folder) {
  return tree.hasFolder(joined(folder, "image_0")) || tree.hasFolder(joined(folder, "image_2"));
}

bool isKittiSequence(Files tree, Folder folder) {
  return hasKittiImages(tree, folder) &&
         (tree.has(joined(folder, "calib.txt")) || tree.has(joined(folder, "times.txt")));
}

bool isKittiRaw(Files tree, Folder folder) {
  for (const char* camera : {"image_00", "image_01", "image_02", "image_03"}) {
    if (tree.hasFolder(joined(folder, std::string(camera) + "/data"))) return true;
  }
  return false;
}

// Whether the first line of a list has a frame's number for a stamp, as those that people make of
// ICL-NUIM for readers of TUM RGB-D: "0 rgb/0.png". TUM's names have decimals.
bool listsFrames(Files tree, Folder list) {
  constexpr std::size_t kHead = 4096;
  try {
    const std::vector<std::uint8_t> head = tree.read(list, kHead);
    const std::string text(head.begin(), head.end()), source = tree.nameOf(list);
    detail::FieldReader in(text, source, "a frame and its image");
    if (!in.nextLine()) return false;
    const std::string first = in.word();
    if (first != "0" && first != "1") return false;
    in.skipWord();
    return !in.isLineEnd() && in.word() == "rgb/" + first + ".png";
  } catch (const Error&) {
    return false;  // its reader will say what is wrong
  }
}

bool isIcl(Files tree, Folder folder) {
  const std::string list = joined(folder, "rgb.txt");
  if (isIclOriginal(tree, folder)) return true;
  if (tree.has(list)) {
    return hasFileLike(tree, folder, "", ".gt.freiburg") || listsFrames(tree, list);
  }
  return tree.has(joined(folder, "associations.txt")) && tree.hasFolder(joined(folder, "depth"));
}

bool mayBeIcl(Files tree, Folder folder) {
  return isIclOriginal(tree, folder) || tree.has(joined(folder, "associations.txt")) ||
         tree.has(joined(folder, "rgb.txt"));
}

bool isTum(Files tree, Folder folder) {
  return tree.has(joined(folder, "rgb.txt"));
}

bool hasTumMonoImages(Files tree, Folder folder) {
  return tree.hasFolder(joined(folder, "images")) || tree.has(joined(folder, "images.zip"));
}

bool isTumMono(Files tree, Folder folder) {
  return hasTumMonoImages(tree, folder) && tree.has(joined(folder, "camera.txt"));
}

// The folder around mav0 counts, not mav0 itself.
std::string aslBody(Files tree, Folder folder) {
  const std::string inside = joined(folder, "mav0");
  return tree.hasFolder(inside) ? inside : folder;
}

bool isAsl(Files tree, Folder folder) {
  return tree.has(joined(aslBody(tree, folder), "cam0/data.csv"));
}

// Whether there is a camN with a list or images, whatever N.
bool hasAslCameras(Files tree, Folder folder) {
  const std::string body = aslBody(tree, folder);
  const std::vector<std::string>& names = tree.folders(body);
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    const bool is_camera = name.compare(0, 3, "cam") == 0 && name.size() > 3 && name.size() <= 6 &&
                           name.find_first_not_of("0123456789", 3) == std::string::npos;
    const std::string camera = joined(body, name);
    return is_camera &&
           (tree.has(joined(camera, "data.csv")) || tree.hasFolder(joined(camera, "data")));
  });
}

bool isTumVi(Files tree, Folder folder) {
  if (!isAsl(tree, folder)) return false;
  return tree.has(joined(folder, "dso/camchain.yaml")) ||
         tree.hasFolder(joined(aslBody(tree, folder), "mocap0"));
}

bool mayBeDroneMap(Files tree, Folder folder) {
  return tree.has(joined(folder, "trajectory.txt")) || tree.has(joined(folder, "frames.txt"));
}

bool isDroneMap(Files tree, Folder folder) {
  if (hasFileLike(tree, folder, "", ".npudronemap")) return true;
  return tree.has(joined(folder, "config.cfg")) && mayBeDroneMap(tree, folder);
}

bool isSevenScenes(Files tree, Folder folder) {
  const std::vector<std::string>& files = tree.files(folder);
  return std::any_of(files.begin(), files.end(), isSevenScenesColour);
}

bool isStrecha(Files tree, Folder folder) {
  return hasFileLike(tree, strechaCameraFolder(tree, folder), "", ".camera");
}

bool isFolder(Files tree, Folder folder) {
  return tree.has(joined(folder, "dataset.yaml"));
}

bool isImages(Files tree, Folder folder) {
  return firstImage(tree, folder) != nullptr;
}

// The first, the last or one between: a receiver has no position at first.
bool isPhotos(Files tree, Folder folder) {
  std::vector<std::string> images;
  for (const std::string& name : tree.files(folder)) {
    if (isImageName(name)) images.push_back(joined(folder, name));
  }
  if (images.empty()) return false;
  return hasPosition(tree, images.front()) || hasPosition(tree, images.back()) ||
         hasPosition(tree, images[images.size() / 2]);
}

// Those that ask for more come first. What is nearer to the root wins over what is deeper.
const Layout kLayouts[] = {{"folder", 1, isFolder, isFolder},
                           {"tumvi", 1, isTumVi, hasAslCameras},
                           {"euroc", 1, isAsl, hasAslCameras},
                           {"kittiraw", 2, isKittiRaw, isKittiRaw},
                           {"kitti", 3, isKittiSequence, hasKittiImages},
                           {"icl", 1, isIcl, mayBeIcl},
                           {"tum", 1, isTum, isTum},
                           {"tummono", 1, isTumMono, hasTumMonoImages},
                           {"dronemap", 1, isDroneMap, mayBeDroneMap},
                           {"7scenes", 2, isSevenScenes, isSevenScenes},
                           {"strecha", 1, isStrecha, isStrecha}};

std::string formatOfTree(Files tree) {
  for (int depth = 0; depth <= 3; ++depth) {
    for (const Layout& layout : kLayouts) {
      const bool is_looked_at = depth <= layout.depth;
      if (is_looked_at && findFolder(tree, depth, layout.is_sure).is_found) return layout.format;
    }
  }
  // What is left has only images.
  const Place images = findFolder(tree, 1, isImages);
  if (images.is_found) return isPhotos(tree, images.folder) ? "photos" : "cvmono";
  return packedSevenScenes(tree, "").empty() ? "" : "7scenes";  // its reader says what to do
}

bool hasEnding(const std::string& path, const std::vector<std::string>& endings) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string::npos) return false;
  std::string ending = path.substr(dot + 1);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::string formatOfFile(const std::string& path) {
  if (hasEnding(path, {"npudronemap"})) return "dronemap";
  if (hasEnding(path, {"mp4", "avi", "mov", "mkv", "webm", "m4v", "mpg", "mpeg", "wmv", "ogv"})) {
    return "cvmono";
  }
  return "";
}

}  // namespace

const Layout& layoutOf(const std::string& format) {
  const auto found = std::find_if(std::begin(kLayouts), std::end(kLayouts),
                                  [&](const Layout& one) { return one.format == format; });
  if (found != std::end(kLayouts)) return *found;
  throw ArgumentError("format", "is '" + format + "', which has no layout");
}

std::vector<std::string> findSequences(const FileTree& tree, int depth,
                                       const std::function<bool(const std::string&)>& is_it) {
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

std::string namesOfSequences(const FileTree& tree, const std::vector<std::string>& folders) {
  constexpr std::size_t kMostNamed = 30;
  std::string list;
  for (std::size_t i = 0; i < folders.size() && i < kMostNamed; ++i) {
    list += (list.empty() ? "" : ", ") + (folders[i].empty() ? tree.baseName() : folders[i]);
  }
  return list + (folders.size() > kMostNamed ? ", ..." : "");
}

std::string onlyFolder(const FileTree& tree, const std::string& format,
                       const std::string& expected) {
  const Layout& layout = layoutOf(format);
  std::vector<std::string> found;
  for (const Layout::Predicate is_it : {layout.is_sure, layout.is_enough}) {
    if (!found.empty()) break;
    found = findSequences(tree, layout.depth,
                          [&](const std::string& folder) { return is_it(tree, folder); });
  }
  if (found.empty()) throw FileError(tree.root(), expected);
  if (found.size() == 1) return found[0];
  const bool is_folder = detail::fileKind(tree.root()) == detail::FileKind::folder;
  throw FileError(tree.root(),
                  "has " + std::to_string(found.size()) + " sequences, expected one: " +
                      (is_folder ? "name the folder of" : "unpack it, and name the folder of") +
                      " one of " + namesOfSequences(tree, found));
}

bool isSevenScenesColour(const std::string& name) {
  return name.compare(0, 6, "frame-") == 0 &&
         (endsWith(name, ".color.png") || endsWith(name, ".color.jpg"));
}

std::vector<std::string> packedSevenScenes(const FileTree& tree, const std::string& folder) {
  std::vector<std::string> archives;
  for (const std::string& name : tree.files(folder)) {
    if (name.compare(0, 4, "seq-") == 0 && endsWith(name, ".zip")) archives.push_back(name);
  }
  return archives;
}

bool isIclOriginal(const FileTree& tree, const std::string& folder) {
  return hasFileLike(tree, folder, "scene_", ".depth");
}

std::string strechaCameraFolder(const FileTree& tree, const std::string& folder) {
  for (const char* name : {"", "images", "gt_dense_cameras", "gt_dense_cameras_fullres"}) {
    const std::string candidate = *name == '\0' ? folder : joined(folder, name);
    if (hasFileLike(tree, candidate, "", ".camera")) return candidate;
  }
  return folder;
}

Place findImageFolder(const FileTree& tree, Remarks& remarks) {
  Place place;
  std::string names;
  findFolder(tree, 1, [&](const FileTree& files, const std::string& folder) {
    if (!isImages(files, folder)) return false;
    if (!place.is_found) {
      place = {true, folder};
    } else {
      names += (names.empty() ? "" : ", ") + folder;
    }
    return false;
  });
  if (!names.empty()) {
    remarks.say("only the images of '" + tree.nameOf(place.folder) + "' are read, not those of " +
                names + ": name one of these to read it");
  }
  return place;
}

Place findFolder(const FileTree& tree, int depth,
                 const std::function<bool(const FileTree&, const std::string&)>& is_it) {
  constexpr std::size_t kMostFolders = 200;
  std::vector<std::pair<std::string, int>> queue = {{"", 0}};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::pair<std::string, int> here = queue[i];
    if (is_it(tree, here.first)) return {true, here.first};
    if (here.second == depth) continue;
    for (const std::string& name : tree.folders(here.first)) {
      if (queue.size() == kMostFolders) break;
      queue.emplace_back(joined(here.first, name), here.second + 1);
    }
  }
  return {};
}

bool isFolderOrArchive(const std::string& path) {
  return detail::fileKind(path) == detail::FileKind::folder || hasEnding(path, {"zip"});
}

std::function<bool(const std::string& path)> recognizesAs(const std::string& format) {
  return [format](const std::string& path) { return datasetFormatOf(path) == format; };
}

}  // namespace reading

std::string datasetFormatOf(const std::string& path) {
  using namespace reading;  // NOLINT(google-build-using-namespace): one function
  try {
    if (isFolderOrArchive(path)) return formatOfTree(*FileTree::open(path));
  } catch (const Error&) {
    return "cvmono";  // a broken archive, a forbidden folder: opening it will say why
  }
  return formatOfFile(path);
}

}  // namespace v1
}  // namespace gslam
