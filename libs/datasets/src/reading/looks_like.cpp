#include "looks_like.h"

#include <gslam/core/detail/shared_library.h>
#include <gslam/datasets/formats.h>

#include <algorithm>
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

bool endsWith(const std::string& name, const std::string& ending) {
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

bool hasFileLike(Files tree, Folder folder, const std::string& begin, const std::string& end) {
  const std::vector<std::string>& files = tree.files(folder);
  return std::any_of(files.begin(), files.end(), [&](const std::string& name) {
    return name.size() >= begin.size() + end.size() && name.compare(0, begin.size(), begin) == 0 &&
           endsWith(name, end);
  });
}

const std::string* firstImage(Files tree, Folder folder) {
  const std::vector<std::string>& files = tree.files(folder);
  const auto found = std::find_if(files.begin(), files.end(), isImageName);
  return found == files.end() ? nullptr : &*found;
}

bool isKittiSequence(Files tree, Folder folder) {
  const bool has_images =
      tree.hasFolder(joined(folder, "image_0")) || tree.hasFolder(joined(folder, "image_2"));
  return has_images &&
         (tree.has(joined(folder, "calib.txt")) || tree.has(joined(folder, "times.txt")));
}

bool isKittiRaw(Files tree, Folder folder) {
  for (const char* camera : {"image_00", "image_01", "image_02", "image_03"}) {
    if (tree.hasFolder(joined(folder, std::string(camera) + "/data"))) return true;
  }
  return false;
}

bool isIclOriginal(Files tree, Folder folder) {
  return hasFileLike(tree, folder, "scene_", ".depth");
}

bool isIcl(Files tree, Folder folder) {
  const bool is_tum_style = tree.has(joined(folder, "associations.txt")) &&
                            !tree.has(joined(folder, "rgb.txt")) &&
                            tree.hasFolder(joined(folder, "depth"));
  return is_tum_style || isIclOriginal(tree, folder);
}

bool isTum(Files tree, Folder folder) {
  return tree.has(joined(folder, "rgb.txt"));
}

bool isTumMono(Files tree, Folder folder) {
  const bool has_images =
      tree.hasFolder(joined(folder, "images")) || tree.has(joined(folder, "images.zip"));
  return has_images && tree.has(joined(folder, "camera.txt"));
}

// The folder around mav0 counts, not mav0 itself.
std::string aslBody(Files tree, Folder folder) {
  const std::string inside = joined(folder, "mav0");
  return tree.hasFolder(inside) ? inside : folder;
}

bool isAsl(Files tree, Folder folder) {
  return tree.has(joined(aslBody(tree, folder), "cam0/data.csv"));
}

bool isTumVi(Files tree, Folder folder) {
  if (!isAsl(tree, folder)) return false;
  return tree.has(joined(folder, "dso/camchain.yaml")) ||
         tree.hasFolder(joined(aslBody(tree, folder), "mocap0"));
}

bool isDroneMap(Files tree, Folder folder) {
  if (hasFileLike(tree, folder, "", ".npudronemap")) return true;
  return tree.has(joined(folder, "config.cfg")) &&
         (tree.has(joined(folder, "trajectory.txt")) || tree.has(joined(folder, "frames.txt")));
}

bool isSevenScenes(Files tree, Folder folder) {
  return hasFileLike(tree, folder, "frame-", ".color.png") ||
         hasFileLike(tree, folder, "frame-", ".color.jpg");
}

bool isStrecha(Files tree, Folder folder) {
  return hasFileLike(tree, folder, "", ".camera") ||
         hasFileLike(tree, joined(folder, "images"), "", ".camera") ||
         hasFileLike(tree, joined(folder, "gt_dense_cameras"), "", ".camera") ||
         hasFileLike(tree, joined(folder, "gt_dense_cameras_fullres"), "", ".camera");
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

struct Look {
  const char* format;
  int depth;  // most folders below the one that the user names
  bool (*is_it)(Files tree, Folder folder);
};

// Those that ask for more come first. What is nearer to the root wins over what is deeper.
const Look kLooks[] = {{"folder", 1, isFolder},
                       {"tumvi", 1, isTumVi},
                       {"euroc", 1, isAsl},
                       {"kittiraw", 2, isKittiRaw},
                       {"kitti", 3, isKittiSequence},
                       {"icl", 1, isIcl},
                       {"tum", 1, isTum},
                       {"tummono", 1, isTumMono},
                       {"dronemap", 1, isDroneMap},
                       {"7scenes", 1, isSevenScenes},
                       {"strecha", 1, isStrecha}};

std::string formatOfTree(Files tree) {
  for (int depth = 0; depth <= 3; ++depth) {
    for (const Look& look : kLooks) {
      if (depth <= look.depth && findFolder(tree, depth, look.is_it).is_found) return look.format;
    }
  }
  // What is left has only images.
  const Place images = findFolder(tree, 1, isImages);
  if (!images.is_found) return "";
  return isPhotos(tree, images.folder) ? "photos" : "cvmono";
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
