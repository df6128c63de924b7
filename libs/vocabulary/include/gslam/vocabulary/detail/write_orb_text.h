// Writes the text files of ORB-SLAM; read_orb_text.h describes them.
#ifndef GSLAM_VOCABULARY_DETAIL_WRITE_ORB_TEXT_H
#define GSLAM_VOCABULARY_DETAIL_WRITE_ORB_TEXT_H

#include <gslam/base/error.h>
#include <gslam/vocabulary/detail/digits.h>
#include <gslam/vocabulary/detail/tree_data.h>
#include <gslam/vocabulary/detail/tree_view.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// An order of nodes that has parents before their children, siblings as they are, because that
// decides ties, and leaves by their words: lines have neither ids nor words.
class OrbTextOrder {
 public:
  // @param data  breadth first, with ids and words
  explicit OrbTextOrder(const TreeData& data) : data_(data) {}

  // Indices. Where the ids allow it, a node gets the line of its id, and so keeps it.
  // @throws ArgumentError when there is no such order
  std::vector<std::uint32_t> find() {
    order_.assign(data_.ids.size(), 0);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      order_[data_.ids[i] - 1] = static_cast<std::uint32_t>(i);
    }
    if (isOrderOfIds()) return std::move(order_);
    return findByWords();
  }

 private:
  bool isAfterSibling(std::size_t i) const {
    return i != 0 && data_.parents[i] == data_.parents[i - 1];
  }

  bool isOrderOfIds() const {
    std::uint32_t next_word = 0;
    for (const std::uint32_t i : order_) {
      if (data_.parents[i] >= data_.ids[i]) return false;
      if (isAfterSibling(i) && data_.ids[i - 1] > data_.ids[i]) return false;
      if (data_.words[i] != kNone && data_.words[i] != next_word++) return false;
    }
    return true;
  }

  // Word by word, with as few other nodes as must be before each.
  std::vector<std::uint32_t> findByWords() {
    index_of_ = std::move(order_);
    order_.clear();
    is_placed_.assign(data_.ids.size(), false);
    std::vector<std::uint32_t> leaves(data_.ids.size(), kNone);
    for (std::size_t i = 0; i < data_.words.size(); ++i) {
      if (data_.words[i] != kNone) leaves[data_.words[i]] = static_cast<std::uint32_t>(i);
    }
    for (const std::uint32_t leaf : leaves) {
      if (leaf == kNone) break;
      placeParents(leaf);
      place(leaf);
    }
    return std::move(order_);
  }

  void placeParents(std::uint32_t i) {
    std::vector<std::uint32_t> path;
    while (data_.parents[i] != 0) {
      i = index_of_[data_.parents[i] - 1];
      path.push_back(i);
    }
    for (; !path.empty(); path.pop_back()) place(path.back());
  }

  // With the siblings in front of it.
  void place(std::uint32_t i) {
    std::uint32_t first = i;
    while (isAfterSibling(first)) --first;
    for (std::uint32_t at = first; at <= i; ++at) {
      if (is_placed_[at]) continue;
      if (at != i && data_.words[at] != kNone) {
        throw ArgumentError(
            "vocabulary",
            "cannot be written as ORB-SLAM's text: node " + std::to_string(data_.ids[at]) +
                " comes before its sibling " + std::to_string(data_.ids[i]) +
                ", but its word comes later, and lines have but one order");
      }
      is_placed_[at] = true;
      order_.push_back(at);
    }
  }

  const TreeData& data_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> index_of_;  // of each id, less one
  std::vector<bool> is_placed_;
};

// Decimals that are read as the same double; the fewest that "%g" has.
inline std::string exactDecimals(double value) {
  char text[40];
  for (int digits = 6; digits <= 17; digits += digits == 6 ? 9 : 1) {
    const int size = std::snprintf(text, sizeof text, "%.*g", digits, value);
    std::string decimals;
    for (const char* p = text; p != text + size; ++p) {
      const bool is_plain = digitOf(*p) <= 9 || *p == '-' || *p == '+' || *p == 'e';
      if (is_plain) decimals += *p;
      // What else is there is the point of the locale, which may be several bytes.
      if (!is_plain && decimals.find('.') == std::string::npos) decimals += '.';
    }
    double read = 0;
    const char* const begin = decimals.data();
    scanDouble(begin, begin + decimals.size(), read);
    if (read == value || digits == 17) return decimals;
  }
  return "0";  // never reached
}

class OrbTextWriter {
 public:
  // @param data  breadth first, with ids and words, of bytes
  explicit OrbTextWriter(const TreeData& data) : data_(data) {
    for (unsigned i = 0; i < 256; ++i) bytes_[i] = std::to_string(i) + " ";
  }

  // Gives pieces of text to `write(data, size)`. There is no end of the last line, of which
  // ORB-SLAM would make a node.
  template <class Write>
  void write(const Write& write) {
    const std::vector<std::uint32_t> order = OrbTextOrder(data_).find();
    std::vector<std::uint32_t> line_of(order.size() + 1, 0);  // of each id
    for (std::size_t i = 0; i < order.size(); ++i) {
      line_of[data_.ids[order[i]]] = static_cast<std::uint32_t>(i + 1);
    }
    text_ = std::to_string(data_.branching) + " " + std::to_string(data_.depth) + " " +
            std::to_string(static_cast<unsigned>(data_.scoring)) + " " +
            std::to_string(static_cast<unsigned>(data_.weighting));
    for (const std::uint32_t i : order) {
      appendNode(i, line_of[data_.parents[i]]);
      if (text_.size() < kPiece) continue;
      write(text_.data(), text_.size());
      text_.clear();
    }
    write(text_.data(), text_.size());
  }

 private:
  enum : std::size_t { kPiece = 1 << 20 };

  void appendNode(std::uint32_t i, std::uint32_t parent) {
    text_ += "\n" + std::to_string(parent);
    text_ += data_.words[i] == kNone ? " 0 " : " 1 ";
    const std::uint8_t* const row = &data_.descriptors[std::size_t(i) * data_.format.size];
    for (std::uint32_t at = 0; at < data_.format.size; ++at) text_ += bytes_[row[at]];
    text_ += decimalsOf(data_.weights[i]);
  }

  // Weights repeat: there are as many as images in the training.
  const std::string& decimalsOf(double weight) {
    if (decimals_.size() > 100000) decimals_.clear();
    std::string& decimals = decimals_[weight];
    if (decimals.empty()) decimals = exactDecimals(weight);
    return decimals;
  }

  const TreeData& data_;
  std::string bytes_[256];  // with a space behind
  std::unordered_map<double, std::string> decimals_;
  std::string text_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_WRITE_ORB_TEXT_H
