#include "features/pyramid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace visual {

Pyramid::Pyramid(const Levels& levels, int sheets) : levels_(levels) {
  double left = 0;
  for (int i = 0; i < levels.count(); ++i) left += levels.information(i);
  for (int first = 0; first < levels.count(); --sheets) {
    const double share = left / std::max(1, sheets);
    int end = first;
    // A level more where that is nearer to the share than a level less.
    for (double have = 0; end < levels.count(); ++end) {
      const double next = levels.information(end);
      if (sheets > 1 && end > first && have + next / 2 > share) break;
      have += next;
      left -= next;
    }
    sheets_.push_back({first, end, cv::Mat()});
    first = end;
  }
}

void Pyramid::build(const cv::Mat& grey) {
  if (grey.size() != level(0).size()) layOut(grey.size());
  constexpr int kMirror = cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED;
  for (int i = 0; i < count(); ++i) {
    Place& place = places_[std::size_t(i)];
    if (i == 0) {
      grey.copyTo(place.image);
    } else {
      // Each from the one before: what is averaged over two pixels is smooth enough for the next.
      cv::resize(level(i - 1), place.image, place.image.size(), 0, 0, cv::INTER_LINEAR);
    }
    cv::copyMakeBorder(place.image, place.padded, kPad, kPad, kPad, kPad, kMirror);
  }
}

void Pyramid::layOut(const cv::Size& size) {
  for (int i = 0; i < count(); ++i) {
    const double factor = levels_.factor(i);
    places_[std::size_t(i)].on_sheet.width = std::max(1, int(std::lround(size.width / factor)));
    places_[std::size_t(i)].on_sheet.height = std::max(1, int(std::lround(size.height / factor)));
  }
  for (Sheet& sheet : sheets_) layOut(sheet);
}

// On shelves, as books: the first level of a shelf makes its height, those after it are smaller.
void Pyramid::layOut(Sheet& sheet) {
  struct Shelf {
    int top, used;
  };
  std::vector<Shelf> shelves;
  const int width = place(sheet.first).width + 2 * kPad;
  int height = 0;
  for (int i = sheet.first; i < sheet.end; ++i) {
    cv::Rect& at = places_[std::size_t(i)].on_sheet;
    auto shelf = std::find_if(shelves.begin(), shelves.end(), [&](const Shelf& one) {
      return one.used + at.width + 2 * kPad <= width;
    });
    if (shelf == shelves.end()) {
      shelf = shelves.insert(shelf, {height, 0});
      height += at.height + 2 * kPad;
    }
    at.x = shelf->used + kPad;
    at.y = shelf->top + kPad;
    shelf->used += at.width + 2 * kPad;
  }
  sheet.image = cv::Mat::zeros(height, width, CV_8UC1);
  for (int i = sheet.first; i < sheet.end; ++i) {
    Place& at = places_[std::size_t(i)];
    const cv::Rect around(at.on_sheet.x - kPad, at.on_sheet.y - kPad, at.on_sheet.width + 2 * kPad,
                          at.on_sheet.height + 2 * kPad);
    at.image = sheet.image(at.on_sheet);
    at.padded = sheet.image(around);
  }
}

}  // namespace visual
