#include "features/even_choice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace visual {

const std::vector<std::uint32_t>& EvenChoice::choose(const std::vector<Spot>& spots,
                                                     const SpotArea& area, std::size_t wanted) {
  chosen_.clear();
  if (spots.size() <= wanted) {
    chosen_.resize(spots.size());
    std::iota(chosen_.begin(), chosen_.end(), 0U);
    return chosen_;
  }
  if (wanted == 0) return chosen_;
  sortIntoCells(spots, area, wanted);
  const auto is_better = [&spots](std::uint32_t a, std::uint32_t b) {
    return spots[a].response != spots[b].response ? spots[a].response > spots[b].response : a < b;
  };
  for (std::uint32_t rank = 0; chosen_.size() < wanted; ++rank) {
    round_.clear();
    for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) {
      const std::uint32_t at = begin_[cell] + rank;
      if (at < begin_[cell + 1]) round_.push_back(by_cell_[at]);
    }
    const std::size_t room = wanted - chosen_.size();
    if (round_.size() > room) {
      std::nth_element(round_.begin(), round_.begin() + std::ptrdiff_t(room), round_.end(),
                       is_better);
      round_.resize(room);
    }
    chosen_.insert(chosen_.end(), round_.begin(), round_.end());
  }
  std::sort(chosen_.begin(), chosen_.end());
  return chosen_;
}

void EvenChoice::sortIntoCells(const std::vector<Spot>& spots, const SpotArea& area,
                               std::size_t wanted) {
  const double side = std::sqrt(area.width * area.height / double(wanted));
  const int columns = std::max(1, int(std::lround(area.width / side)));
  const int rows = std::max(1, int(std::lround(area.height / side)));
  const auto cellAlong = [](double at, double size, int count) {
    return std::clamp(int(std::floor(at / size * count)), 0, count - 1);
  };
  begin_.assign(std::size_t(columns) * std::size_t(rows) + 1, 0);
  cell_of_.resize(spots.size());
  for (std::size_t i = 0; i < spots.size(); ++i) {
    const int column = cellAlong(double(spots[i].u) - area.left, area.width, columns);
    const int row = cellAlong(double(spots[i].v) - area.top, area.height, rows);
    cell_of_[i] = std::uint32_t(row) * std::uint32_t(columns) + std::uint32_t(column);
    ++begin_[cell_of_[i]];
  }
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  by_cell_.resize(spots.size());
  // Filled from its end, which moves the begin of each cell to where it belongs.
  for (std::size_t i = spots.size(); i-- > 0;) {
    by_cell_[--begin_[cell_of_[i]]] = std::uint32_t(i);
  }
  for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) {
    std::sort(by_cell_.begin() + begin_[cell], by_cell_.begin() + begin_[cell + 1],
              [&spots](std::uint32_t a, std::uint32_t b) {
                return spots[a].response != spots[b].response
                           ? spots[a].response > spots[b].response
                           : a < b;
              });
  }
}

}  // namespace visual
