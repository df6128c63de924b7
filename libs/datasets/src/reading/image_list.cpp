#include "image_list.h"

#include <gslam/base/error.h>
#include <gslam/core/associate.h>
#include <gslam/core/detail/field_reader.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

std::string placeOf(const ListedImage& image, const std::string& list) {
  if (image.line == 0) return image.file;
  return image.file + " (" + list + ":" + std::to_string(image.line) + ")";
}

std::vector<std::int64_t> stampsOfImages(const std::vector<ListedImage>& images) {
  std::vector<std::int64_t> stamps(images.size());
  std::transform(images.begin(), images.end(), stamps.begin(),
                 [](const ListedImage& image) { return image.stamp; });
  return stamps;
}

std::string milliseconds(std::int64_t nanoseconds) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g ms", double(nanoseconds) * 1e-6);
  return text;
}

constexpr std::size_t kNoPartner = static_cast<std::size_t>(-1);

// For each image of the first list the place of its partner in another one.
std::vector<std::size_t> partners(const std::vector<std::int64_t>& first,
                                  const std::vector<ListedImage>& other, std::int64_t tolerance) {
  std::vector<std::size_t> result(first.size(), kNoPartner);
  for (const StampPair& pair : associate(first, stampsOfImages(other), tolerance)) {
    result[pair.a] = pair.b;
  }
  return result;
}

void sayAlone(const std::vector<ListedImage>& images, const std::vector<bool>& is_used,
              const std::string& things, Remarks& remarks) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!is_used[i]) remarks.skip(things, images[i].file);
  }
}

}  // namespace

std::vector<ListedImage> readImageList(const FileTree& tree, const std::string& list,
                                       StampUnit unit, const std::string& folder) {
  const std::string text = tree.text(list), name = tree.nameOf(list);
  detail::FieldReader in(text, name, "a stamp and the name of an image");
  std::vector<ListedImage> images;
  while (in.nextLine()) {
    ListedImage image;
    image.line = in.line();
    image.stamp = in.stamp(stampUnitName(unit), 3 * static_cast<int>(unit));
    if (in.isLineEnd()) in.fail(in.place(), "the name of the image is missing after the stamp");
    image.file = joined(folder, in.word());
    images.push_back(std::move(image));
  }
  return images;
}

void tidy(std::vector<ListedImage>& images, const FileTree& tree, const std::string& list,
          Remarks& remarks) {
  const auto isMissing = [&](const ListedImage& image) {
    if (tree.has(image.file)) return false;
    remarks.skip("images that " + list + " lists and that do not exist", placeOf(image, list));
    return true;
  };
  images.erase(std::remove_if(images.begin(), images.end(), isMissing), images.end());
  const auto isBefore = [](const ListedImage& a, const ListedImage& b) {
    return a.stamp < b.stamp;
  };
  if (!std::is_sorted(images.begin(), images.end(), isBefore)) {
    remarks.say("the images of " + list + " are not in the order of their stamps: they are sorted");
    std::stable_sort(images.begin(), images.end(), isBefore);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (kept > 0 && images[kept - 1].stamp == images[i].stamp) {
      remarks.skip("images that have the stamp of another in " + list, placeOf(images[i], list));
    } else {
      if (kept != i) images[kept] = std::move(images[i]);
      ++kept;
    }
  }
  images.resize(kept);
}

ImageShape shapeOfFirst(const FileTree& tree, const std::vector<ListedImage>& images) {
  return images.empty() ? ImageShape() : shapeOf(readImage(tree, images.front().file));
}

std::vector<std::string> makeFrames(Sequence& sequence,
                                    const std::vector<std::vector<ListedImage>>& lists,
                                    std::int64_t tolerance) {
  const std::vector<CameraSensor>& cameras = sequence.info.sensors.cameras;
  const std::vector<std::int64_t> first = stampsOfImages(lists.at(0));
  std::vector<std::vector<std::size_t>> places;
  std::vector<std::vector<bool>> is_used;
  for (const std::vector<ListedImage>& list : lists) {
    places.push_back(partners(first, list, places.empty() ? 0 : tolerance));
    is_used.emplace_back(list.size(), false);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto lacks = std::find_if(places.begin(), places.end(),
                                    [i](const auto& one) { return one[i] == kNoPartner; });
    if (lacks != places.end()) continue;  // said below
    sequence.stamps.push_back(first[i]);
    for (std::size_t camera = 0; camera < lists.size(); ++camera) {
      const ListedImage& image = lists[camera][places[camera][i]];
      names.push_back(image.file);
      sequence.exposures.push_back(image.exposure);
      is_used[camera][places[camera][i]] = true;
    }
  }
  for (std::size_t camera = 0; camera < lists.size(); ++camera) {
    sayAlone(lists[camera], is_used[camera],
             "images of camera '" + cameras[camera].name +
                 "' without one of each other camera within " + milliseconds(tolerance),
             sequence.remarks);
  }
  if (!names.empty()) return names;
  throw Error("dataset '" + sequence.info.name +
              "' has no frame with an image of each camera within " + milliseconds(tolerance) +
              sequence.remarks.asReason());
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
