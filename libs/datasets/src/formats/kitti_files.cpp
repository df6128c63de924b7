#include "kitti_files.h"

#include <gslam/base/error.h>

#include <algorithm>

#include "../reading/sort_unique.h"
#include "sequences.h"

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

// Chooses a left camera and, where wanted, the right one.
class Chooser {
 public:
  Chooser(const FileTree& tree, const std::vector<std::string>& folders, bool stereo,
          Remarks& remarks)
      : tree_(tree), folders_(folders), stereo_(stereo), remarks_(remarks) {}

  bool has(std::size_t camera) const { return tree_.hasFolder(folders_[camera]); }

  void addPair(std::size_t left) {
    if (!has(left)) {
      throw FileError(tree_.nameOf(folders_[left]), "is no folder, but its images are asked for");
    }
    cameras.push_back(left);
    if (!stereo_) return;
    if (has(left + 1)) {
      cameras.push_back(left + 1);
    } else {
      remarks_.say("there is no " + folders_[left + 1] + ", and so no stereo");
    }
  }

  std::vector<std::size_t> cameras;

 private:
  const FileTree& tree_;
  const std::vector<std::string>& folders_;
  bool stereo_;
  Remarks& remarks_;
};

}  // namespace

const char* kittiCameraName(std::size_t camera) {
  static const char* const kNames[] = {"left", "right", "colour_left", "colour_right"};
  return kNames[camera];
}

std::vector<std::size_t> chooseKittiCameras(const FileTree& tree,
                                            const std::vector<std::string>& folders,
                                            const Svar& parameters, Remarks& remarks) {
  const std::string which = parameters.get<std::string>("cameras", "auto");
  Chooser chooser(tree, folders, parameters.get<bool>("stereo", true), remarks);
  if (which == "grey" || (which == "auto" && chooser.has(0))) {
    chooser.addPair(0);
  } else if (which == "colour" || which == "auto") {
    chooser.addPair(2);
  } else if (which == "all") {
    if (chooser.has(0) || !chooser.has(2)) chooser.addPair(0);
    if (chooser.has(2)) chooser.addPair(2);
  } else {
    throw ArgumentError("cameras",
                        "is '" + which + "', expected 'grey', 'colour', 'all' or 'auto'");
  }
  return chooser.cameras;
}

std::vector<NumberedFile> numberedFiles(const FileTree& tree, const std::string& folder,
                                        const std::function<bool(const std::string&)>& is_wanted,
                                        Remarks& remarks) {
  std::vector<NumberedFile> files;
  for (const std::string& name : tree.files(folder)) {
    std::size_t number = 0;
    if (!is_wanted(name)) continue;
    if (numberIn(name, number)) {
      files.push_back({number, joined(folder, name)});
    } else {
      remarks.skip("files without a number in their names", joined(folder, name));
    }
  }
  sortUnique(
      files, [](const NumberedFile& file) { return file.number; },
      [&](const NumberedFile& twin) {
        remarks.skip("files whose number another one has", twin.name);
      });
  return files;
}

const NumberedFile* findNumber(const std::vector<NumberedFile>& files, std::size_t number) {
  const auto found = std::lower_bound(
      files.begin(), files.end(), number,
      [](const NumberedFile& file, std::size_t wanted) { return file.number < wanted; });
  return found == files.end() || found->number != number ? nullptr : &*found;
}

void sayCounts(const std::vector<NumberedFile>& files, const std::string& list, std::size_t count,
               const std::string& what, Remarks& remarks) {
  if (count == files.size()) return;
  remarks.say(list + " has " + countText(count, what) + " for " + countText(files.size(), "file") +
              ": each takes that of the number in its name");
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
