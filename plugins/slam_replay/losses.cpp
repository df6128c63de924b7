#include "losses.h"

#include <gslam/base/error.h>
#include <gslam/core/stamp.h>

#include <algorithm>

namespace replay {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

[[noreturn]] void fail(const std::string& word) {
  throw gslam::ArgumentError("losses", "has '" + word +
                                           "', expected intervals such as 100-149, "
                                           "200-209:guessed, 2.5s-3s:none");
}

Answer answerCalled(const std::string& name, const std::string& word) {
  if (name == "none") return {false, gslam::TrackingState::lost, true};
  if (name == "nan") return {true, gslam::TrackingState::tracking, false};
  for (const auto state : {gslam::TrackingState::lost, gslam::TrackingState::guessed,
                           gslam::TrackingState::starting}) {
    if (name == gslam::trackingStateName(state)) return {true, state, true};
  }
  fail(word);
}

bool isDigits(const std::string& text) {
  return !text.empty() && text.size() <= 18 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// A frame, or a time with an s.
bool parseEnd(const std::string& text, std::int64_t& value, bool& is_time) {
  is_time = !text.empty() && text.back() == 's';
  try {
    if (is_time) {
      value = gslam::parseStamp(text.substr(0, text.size() - 1));
    } else {
      if (!isDigits(text)) return false;
      value = std::stoll(text);
    }
  } catch (const gslam::Error&) {
    return false;
  }
  return value >= 0;
}

}  // namespace

Losses::Losses(const std::string& text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = trimmed(text.substr(begin, end - begin));
    if (word.empty()) fail(word);
    intervals_.push_back(parse(word));
    begin = end + 1;
  }
}

Losses::Interval Losses::parse(const std::string& word) {
  const std::size_t colon = std::min(word.find(':'), word.size());
  const std::string range = word.substr(0, colon);
  Interval interval{};
  interval.answer = answerCalled(colon < word.size() ? word.substr(colon + 1) : "lost", word);
  const std::size_t dash = std::min(range.find('-'), range.size());
  bool is_end_time = false;
  if (!parseEnd(range.substr(0, dash), interval.first, interval.is_time)) fail(word);
  interval.last = interval.first;
  if (dash == range.size()) return interval;
  if (!parseEnd(range.substr(dash + 1), interval.last, is_end_time)) fail(word);
  if (is_end_time != interval.is_time || interval.last < interval.first) fail(word);
  return interval;
}

Answer Losses::answerTo(std::uint64_t frame, std::int64_t time) const {
  for (const Interval& interval : intervals_) {
    const std::int64_t at = interval.is_time ? time : static_cast<std::int64_t>(frame);
    if (at >= interval.first && at <= interval.last) return interval.answer;
  }
  return {};
}

}  // namespace replay
