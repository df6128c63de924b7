// Random trees of values for round trips.
#ifndef GSLAM_SVAR_FORMATS_TESTS_RANDOM_VALUE_H
#define GSLAM_SVAR_FORMATS_TESTS_RANDOM_VALUE_H

#include <gslam/svar.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace random_value {

using gslam::Svar;
using Random = std::mt19937_64;

inline int below(Random& random, int end) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(end));
}

// Any double but NaN: all exponents are as likely.
inline double anyDouble(Random& random) {
  for (;;) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof(value));
    if (!std::isnan(value)) return value;
  }
}

// Words that mean something in a format, and pieces that are hard to write down.
inline std::string anyText(Random& random, bool with_controls) {
  static const char* const words[] = {
      "null",  "true",       "False", "yes",        "No",         "~",    "12",  "0x1F",
      "1.5",   ".inf",       "-.INF", ".nan",       "1e3",        "-",    "?",   ":",
      "---",   "...",        "<<",    "#text",      "@a",         "&a",   "*a",  "!!int",
      "%YAML", "2001-12-14", "1:30",  "key: value", "- item",     "a #b", "[1]", "{a: b}",
      "]]>",   "<a/>",       "&amp;", "svar:type",  "xmlns:svar", "item", "xml", "1_000",
      "0o7",   "007",        "+1",    "\"",         "'",          "it's", "|",   ">"};
  static const char* const pieces[] = {"a",
                                       "Z9",
                                       " ",
                                       "  ",
                                       "\"",
                                       "\\",
                                       "/",
                                       "\n",
                                       "\t",
                                       "\r",
                                       "\xC2\x85",
                                       "\xC2\xA0",
                                       "\xC3\xA9",
                                       "'",
                                       "\xE2\x80\xA8",
                                       ":",
                                       "#",
                                       ",",
                                       "&",
                                       "<",
                                       ">",
                                       "\xEF\xBB\xBF",
                                       "\xF0\x9F\x98\x80",
                                       "-",
                                       "\r\n",
                                       "]]>"};
  static const char* const controls[] = {"\x01", "\x1B", "\x7F", "\x04", "\x1F"};
  const int kind = below(random, 4);
  if (kind == 0) return words[below(random, static_cast<int>(sizeof(words) / sizeof(words[0])))];
  std::string text;
  for (int i = below(random, kind == 1 ? 60 : 8); i > 0; --i) {
    text += pieces[below(random, static_cast<int>(sizeof(pieces) / sizeof(pieces[0])))];
    if (with_controls && below(random, 20) == 0) text += controls[below(random, 5)];
  }
  if (with_controls && below(random, 20) == 0) text += '\0';
  return text;
}

inline Svar anyScalar(Random& random, bool with_controls) {
  switch (below(random, 8)) {
    case 6: {
      const std::string bytes = anyText(random, true);
      return Svar::binary(bytes.data(), bytes.size());
    }
    case 0:
      return nullptr;
    case 1:
      return below(random, 2) == 0;
    case 2:
      return below(random, 2000) - 1000;
    case 3:
      return static_cast<std::int64_t>(random());
    case 4:
      return anyDouble(random);
    case 5:
      return std::round(anyDouble(random) * 1e3) / 1e3;
    default:
      return anyText(random, with_controls);
  }
}

// Names are of any kind, too; set() would take dots in them for paths.
inline Svar anyTree(Random& random, int depth, bool with_controls) {
  const int kind = depth == 0 ? 2 : below(random, 4);
  if (kind > 1) return anyScalar(random, with_controls);
  const int size = below(random, 5) == 0 ? below(random, 30) : below(random, 5);
  if (kind == 0) {
    Svar made = Svar::array();
    for (int i = 0; i < size; ++i) made.push_back(anyTree(random, depth - 1, with_controls));
    return made;
  }
  std::vector<Svar::Member> members;
  for (int i = 0; i < size; ++i) {
    const std::string name = (below(random, 4) == 0 ? "@" : "") + anyText(random, with_controls);
    members.emplace_back(name, anyTree(random, depth - 1, with_controls));
  }
  gslam::detail::OrderedMap<Svar> map;
  map.assign(std::move(members));
  map.keepLast();
  return gslam::detail::SvarParts::object(std::move(map));
}

/// Arrays around a value.
inline Svar nested(int depth) {
  Svar value;
  for (int i = 0; i < depth; ++i) value = Svar::array({value});
  return value;
}

}  // namespace random_value

#endif  // GSLAM_SVAR_FORMATS_TESTS_RANDOM_VALUE_H
