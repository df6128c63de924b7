#include "remarks.h"

#include <algorithm>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

constexpr std::size_t kMostNamed = 10;

}  // namespace

void Remarks::say(const std::string& sentence) {
  for (const Entry& entry : entries_) {
    if (entry.count == 0 && entry.text == sentence) return;
  }
  entries_.emplace_back();
  entries_.back().text = sentence;
}

void Remarks::skip(const std::string& things, const std::string& which) {
  auto entry = std::find_if(entries_.begin(), entries_.end(),
                            [&](const Entry& one) { return one.count > 0 && one.text == things; });
  if (entry == entries_.end()) {
    entries_.emplace_back();
    entry = entries_.end() - 1;
    entry->text = things;
  }
  ++entry->count;
  if (entry->first.size() < kMostNamed) {
    entry->first.push_back(which);
  } else {
    entry->last = which;
  }
}

std::size_t Remarks::skipped(const std::string& things) const noexcept {
  for (const Entry& entry : entries_) {
    if (entry.count > 0 && entry.text == things) return entry.count;
  }
  return 0;
}

std::vector<std::string> Remarks::sentences() const {
  std::vector<std::string> all;
  for (const Entry& entry : entries_) {
    if (entry.count == 0) {
      all.push_back(entry.text);
      continue;
    }
    std::string text = "skipped " + std::to_string(entry.count) + " " + entry.text + ": ";
    for (std::size_t i = 0; i < entry.first.size(); ++i) {
      text += (i == 0 ? "" : ", ") + entry.first[i];
    }
    if (entry.count > entry.first.size() + 1) text += ", ...";
    if (entry.count > entry.first.size()) text += ", " + entry.last;
    all.push_back(std::move(text));
  }
  return all;
}

std::string Remarks::asReason() const {
  std::string text;
  for (const std::string& sentence : sentences()) text += "\n  " + sentence;
  return text;
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
