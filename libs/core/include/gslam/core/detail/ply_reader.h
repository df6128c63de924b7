// Points out of PLY that anybody may have written.
#ifndef GSLAM_CORE_DETAIL_PLY_READER_H
#define GSLAM_CORE_DETAIL_PLY_READER_H

#include <gslam/base/detail/little_endian.h>
#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/core/map_types.h>
#include <gslam/svar/detail/parse_number.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;
  bool is_list = false;
  PlyType count_type = PlyType::u8;  // of lists
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

inline std::size_t plyTypeSize(PlyType type) noexcept {
  static const std::uint8_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

// False where there is no such type.
inline bool plyTypeOf(const std::string& name, PlyType& type) {
  static const char* const kNames[][2] = {
      {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
      {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  for (std::size_t i = 0; i < 8; ++i) {
    if (name != kNames[i][0] && name != kNames[i][1]) continue;
    type = static_cast<PlyType>(i);
    return true;
  }
  return false;
}

// Where in the bytes a reader is, and numbers from there.
class PlyInput {
 public:
  PlyInput(Span<const std::uint8_t> bytes, const std::string& source)
      : place_(reinterpret_cast<const char*>(bytes.data())),
        end_(place_ + bytes.size()),
        source_(source) {}

  PlyFormat format = PlyFormat::ascii;

  std::size_t remaining() const noexcept { return static_cast<std::size_t>(end_ - place_); }

  // The next line of the header, in words.
  std::vector<std::string> words() {
    const char* const line_end = std::find(place_, end_, '\n');
    if (line_end == end_) fail("ends in its header, expected end_header");
    ++line_;
    std::vector<std::string> result;
    while (place_ != line_end) {
      const char* const word = std::find_if_not(place_, line_end, isSpace);
      place_ = std::find_if(word, line_end, isSpace);
      if (word != place_) result.emplace_back(word, place_);
    }
    ++place_;
    return result;
  }

  // Bytes have no lines, and errors no place among them.
  void beginBody() noexcept { line_ = format == PlyFormat::ascii ? line_ + 1 : 0; }

  double number(PlyType type) {
    if (format == PlyFormat::ascii) return wordAsNumber();
    switch (type) {
      case PlyType::i8:
        return binary<std::int8_t>();
      case PlyType::u8:
        return binary<std::uint8_t>();
      case PlyType::i16:
        return binary<std::int16_t>();
      case PlyType::u16:
        return binary<std::uint16_t>();
      case PlyType::i32:
        return binary<std::int32_t>();
      case PlyType::u32:
        return binary<std::uint32_t>();
      case PlyType::f32:
        return double(binary<float>());
      case PlyType::f64:
        break;
    }
    return binary<double>();
  }

  // The least that a number takes.
  std::size_t sizeOf(PlyType type) const noexcept {
    return format == PlyFormat::ascii ? 1 : plyTypeSize(type);
  }

  // Of binary files only.
  void skip(std::uint64_t count) {
    if (count > remaining()) fail("ends too early");
    place_ += count;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(source_, line_, 0, problem);
  }

 private:
  static bool isSpace(char c) noexcept {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
  }

  template <class Number>
  Number binary() {
    using Bits = typename BitsOf<sizeof(Number)>::Type;
    if (remaining() < sizeof(Number)) fail("ends too early");
    std::uint8_t bytes[sizeof(Number)];
    std::memcpy(bytes, place_, sizeof(Number));
    place_ += sizeof(Number);
    if (format == PlyFormat::big_endian) std::reverse(bytes, bytes + sizeof(Number));
    const Bits bits = loadLittle<Bits>(bytes);
    Number number;
    std::memcpy(&number, &bits, sizeof(Number));
    return number;
  }

  double wordAsNumber() {
    while (place_ != end_ && isSpace(*place_)) line_ += *place_++ == '\n' ? 1 : 0;
    const char* const word = place_;
    place_ = std::find_if(place_, end_, isSpace);
    if (word == place_) fail("ends too early");
    const ParsedNumber parsed = parseNumber(word, place_);
    if (parsed.end == place_ && parsed.status == NumberStatus::ok) {
      return parsed.is_integer ? double(parsed.integer) : parsed.real;
    }
    return oddNumber(std::string(word, place_));
  }

  // What is no number in JSON, but is one for many who write PLY: +1, .5, 5., 007, nan.
  double oddNumber(std::string word) const {
    const std::string shown = word.substr(0, 40);
    const bool has_sign = word[0] == '-' || word[0] == '+';
    const double sign = word[0] == '-' ? -1 : 1;
    if (has_sign) word.erase(0, 1);
    std::transform(word.begin(), word.end(), word.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (word == "inf" || word == "infinity") return sign * std::numeric_limits<double>::infinity();
    std::istringstream in(word);
    in.imbue(std::locale::classic());
    double value = 0;
    const bool begins_well =
        !word.empty() && (word[0] == '.' || (word[0] >= '0' && word[0] <= '9'));
    if (!begins_well || !(in >> value) || in.peek() != std::istringstream::traits_type::eof()) {
      fail("found '" + shown + "', expected a number");
    }
    return sign * value;
  }

  const char* place_;
  const char* end_;
  std::string source_;
  std::size_t line_ = 0;
};

class PlyReader {
 public:
  PlyReader(Span<const std::uint8_t> bytes, const std::string& source) : in_(bytes, source) {}

  // Those of the first element "vertex".
  std::vector<MapPoint> points() {
    readHeader();
    for (const PlyElement& element : elements_) {
      checkCount(element);
      if (element.name == "vertex") return readVertices(element);
      skipAll(element);
    }
    in_.fail("has no vertices");
  }

 private:
  void readHeader() {
    const std::vector<std::string> magic = in_.words();
    if (magic.size() != 1 || magic[0] != "ply") in_.fail("is no PLY file");
    bool has_format = false;
    for (;;) {
      const std::vector<std::string> words = in_.words();
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "format") {
        readFormat(words);
        has_format = true;
      } else if (words[0] == "element") {
        readElement(words);
      } else if (words[0] == "property") {
        readProperty(words);
      } else {
        in_.fail("found '" + words[0].substr(0, 40) + "', expected element or property");
      }
    }
    if (!has_format) in_.fail("does not say its format");
    in_.beginBody();
  }

  void readFormat(const std::vector<std::string>& words) {
    const std::string name = words.size() == 3 && words[2] == "1.0" ? words[1] : "";
    if (name == "ascii") {
      in_.format = PlyFormat::ascii;
    } else if (name == "binary_little_endian") {
      in_.format = PlyFormat::little_endian;
    } else if (name == "binary_big_endian") {
      in_.format = PlyFormat::big_endian;
    } else {
      in_.fail("has a format that is not ascii, binary_little_endian or binary_big_endian 1.0");
    }
  }

  void readElement(const std::vector<std::string>& words) {
    if (words.size() != 3) in_.fail("has an element without a name and a count");
    const ParsedNumber count = parseNumber(words[2].data(), words[2].data() + words[2].size());
    const bool is_count = count.end == words[2].data() + words[2].size() &&
                          count.status == NumberStatus::ok && count.is_integer &&
                          count.integer >= 0;
    if (!is_count) in_.fail("has a count that is no number, 0 or more");
    elements_.emplace_back();
    elements_.back().name = words[1];
    elements_.back().count = static_cast<std::uint64_t>(count.integer);
  }

  void readProperty(const std::vector<std::string>& words) {
    if (elements_.empty()) in_.fail("has a property before its first element");
    PlyProperty property;
    property.is_list = words.size() == 5 && words[1] == "list";
    const std::size_t type = property.is_list ? 3 : 1;
    const bool is_known = words.size() == type + 2 && plyTypeOf(words[type], property.type) &&
                          (!property.is_list || plyTypeOf(words[2], property.count_type));
    if (!is_known) in_.fail("has a property without a type that is known, and a name");
    property.name = words[type + 1];
    elements_.back().properties.push_back(property);
  }

  // So many there are bytes for; what takes no bytes would never end.
  void checkCount(const PlyElement& element) const {
    if (element.count == 0) return;
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties) {
      least += in_.sizeOf(property.is_list ? property.count_type : property.type);
    }
    if (least == 0)
      in_.fail("has elements '" + element.name.substr(0, 40) + "' without properties");
    if (element.count > in_.remaining() / least) {
      in_.fail("has a count of " + std::to_string(element.count) + " with " +
               std::to_string(in_.remaining()) + " bytes left");
    }
  }

  void skipAll(const PlyElement& element) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) skip(property);
    }
  }
  void skip(const PlyProperty& property) {
    if (!property.is_list) {
      in_.number(property.type);
      return;
    }
    const double count = in_.number(property.count_type);
    if (!(count >= 0 && count <= 4294967295.0)) in_.fail("has a list with a wrong length");
    const std::uint64_t size = static_cast<std::uint64_t>(count);
    if (in_.format != PlyFormat::ascii) return in_.skip(size * plyTypeSize(property.type));
    for (std::uint64_t i = 0; i < size; ++i) in_.number(property.type);
  }

  // Where the numbers of a vertex go.
  enum Role { kX, kY, kZ, kNx, kNy, kNz, kRed, kGreen, kBlue, kAlpha, kFrustum, kNone };

  static Role roleOf(const PlyProperty& property) {
    static const char* const kNames[] = {"x",   "y",     "z",    "nx",    "ny",     "nz",
                                         "red", "green", "blue", "alpha", "frustum"};
    std::string name = property.name;
    if (name.compare(0, 8, "diffuse_") == 0) name.erase(0, 8);
    for (int i = 0; i < kNone; ++i) {
      if (name == kNames[i]) return static_cast<Role>(i);
    }
    return kNone;
  }

  std::vector<MapPoint> readVertices(const PlyElement& element) {
    std::vector<Role> roles;
    for (const PlyProperty& property : element.properties) {
      roles.push_back(property.is_list ? kNone : roleOf(property));
    }
    const auto has = [&roles](Role role) {
      return std::find(roles.begin(), roles.end(), role) != roles.end();
    };
    if (!has(kX) || !has(kY) || !has(kZ)) in_.fail("has vertices without x, y and z");
    const bool is_colored = has(kRed) && has(kGreen) && has(kBlue);
    std::vector<MapPoint> points(static_cast<std::size_t>(element.count));
    std::size_t size = 0;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      points[size] = MapPoint();
      if (readVertex(element, roles, is_colored, points[size])) ++size;
    }
    points.resize(size);
    return points;
  }

  // False for what is no point, but the corner of a camera's pyramid.
  bool readVertex(const PlyElement& element, const std::vector<Role>& roles, bool is_colored,
                  MapPoint& point) {
    bool is_point = true;
    point.color.alpha = is_colored ? 255 : 0;
    for (std::size_t i = 0; i < roles.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (roles[i] == kNone) {
        skip(property);
        continue;
      }
      const double value = in_.number(property.type);
      if (roles[i] < kNx) {
        point.position[roles[i]] = value;
      } else if (roles[i] < kRed) {
        point.normal[std::size_t(roles[i] - kNx)] = static_cast<float>(value);
      } else if (roles[i] == kFrustum) {
        is_point = value == 0;
      } else if (is_colored) {
        setColor(point.color, roles[i], value * colorScale(property.type));
      }
    }
    return is_point;
  }

  // To 0 to 255 from what a type has.
  static double colorScale(PlyType type) noexcept {
    if (type >= PlyType::f32) return 255;
    return type == PlyType::u16 ? 1 / 257.0 : 1;
  }

  static void setColor(Color& color, Role role, double value) noexcept {
    const double rounded = value > 0 ? std::floor(std::min(value, 255.0) + 0.5) : 0;
    const std::uint8_t byte = static_cast<std::uint8_t>(rounded);
    if (role == kRed) color.red = byte;
    if (role == kGreen) color.green = byte;
    if (role == kBlue) color.blue = byte;
    if (role == kAlpha) color.alpha = byte;
  }

  PlyInput in_;
  std::vector<PlyElement> elements_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_PLY_READER_H
