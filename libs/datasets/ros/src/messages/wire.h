// Serialized messages: that of ROS 1, and CDR of ROS 2 in both byte orders.
//
// A message is a struct with a describe(wire, message) that names its fields in order; the wires
// read them. Sources: http://wiki.ros.org/msg (ROS 1: no alignment, strings without a zero); OMG,
// "DDS Interoperability Wire Protocol", 2.3, 10.2 and "DDS-XTypes" 1.3, 7.4 (CDR: numbers at
// multiples of their size behind a head of four bytes, strings with a zero).
#ifndef GSLAM_DATASETS_ROS_SRC_MESSAGES_WIRE_H
#define GSLAM_DATASETS_ROS_SRC_MESSAGES_WIRE_H

#include <gslam/base/error.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "../bytes/byte_reader.h"

namespace gslam {
inline namespace v1 {
namespace ros {

/// What the two have in common. `Kind` has number(), textBytes(), and is_ros1.
template <class Kind>
class Wire {
 public:
  /// Reads fields one after another.
  template <class... Fields>
  void operator()(Fields&... fields) {
    (void)std::initializer_list<int>{(read(fields), 0)...};
  }

 private:
  Kind& self() noexcept { return static_cast<Kind&>(*this); }

  template <class T, std::enable_if_t<std::is_arithmetic<T>::value, int> = 0>
  void read(T& value) {
    value = self().template number<T>();
  }
  void read(std::string& value) { value = ByteReader::textOf(self().textBytes()); }
  // Bytes are not copied: images are large.
  void read(Bytes& value) {
    const auto count = self().template number<std::uint32_t>();
    value = self().bytes(count);
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  template <class T>
  void read(std::vector<T>& values) {
    const auto count = self().template number<std::uint32_t>();
    // No element is smaller than a byte: so memory is bounded by that of the message.
    const std::size_t least = std::is_arithmetic<T>::value ? sizeof(T) : 1;
    if (count > self().left() / least) {
      self().fail("a list should have " + std::to_string(count) + " elements, but there are " +
                  std::to_string(self().left()) + " bytes left");
    }
    values.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      values.emplace_back();
      read(values.back());
    }
  }
  template <class T, std::enable_if_t<std::is_class<T>::value, int> = 0>
  void read(T& message) {
    describe(self(), message);
  }
};

/// Bytes of a message, and a name for errors, which must outlive it.
class WireBytes {
 public:
  WireBytes(Bytes bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  std::size_t left() const noexcept { return bytes_.size() - at_; }
  Bytes bytes(std::size_t size) {
    if (size > left()) {
      fail("ends early: expected " + std::to_string(size) + " bytes more, but there are " +
           std::to_string(left()));
    }
    const Bytes result(bytes_.data() + at_, size);
    at_ += size;
    return result;
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw ParseError(name_ + ", byte " + std::to_string(at_), 0, 0, problem);
  }

 protected:
  template <class T>
  T numberOf(const std::uint8_t* raw, bool is_swapped) const noexcept {
    std::uint8_t ordered[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      ordered[i] = raw[is_swapped ? sizeof(T) - 1 - i : i];
    }
    T value;
    std::memcpy(&value, ordered, sizeof(T));
    return value;
  }
  // Whether numbers in memory have their least byte first.
  static bool isLittleHost() noexcept {
    const std::uint16_t one = 1;
    std::uint8_t first = 0;
    std::memcpy(&first, &one, 1);
    return first == 1;
  }

  Bytes bytes_;
  const std::string& name_;
  std::size_t at_ = 0;
};

/// ROS 1.
class Ros1Wire : public WireBytes, public Wire<Ros1Wire> {
 public:
  static constexpr bool is_ros1 = true;
  using WireBytes::WireBytes;

  template <class T>
  T number() {
    return numberOf<T>(bytes(sizeof(T)).data(), !isLittleHost());
  }
  Bytes textBytes() { return bytes(number<std::uint32_t>()); }
};

/// CDR.
class CdrWire : public WireBytes, public Wire<CdrWire> {
 public:
  static constexpr bool is_ros1 = false;

  CdrWire(Bytes message, const std::string& name) : WireBytes(message, name) {
    const Bytes head = bytes(kHead);
    const bool is_plain = head[0] == 0 && (head[1] <= 1 || head[1] == 6 || head[1] == 7);
    if (!is_plain) {
      fail("the message is in representation " + std::to_string(head[0] * 256 + head[1]) +
           ", expected plain CDR: 0, 1, 6 or 7");
    }
    is_little_ = (head[1] & 1U) != 0;
    most_aligned_ = head[1] >= 6 ? 4 : 8;  // XCDR2 aligns to 4 at most
  }

  template <class T>
  T number() {
    const std::size_t unit = sizeof(T) < most_aligned_ ? sizeof(T) : most_aligned_;
    const std::size_t over = (at_ - kHead) % unit;
    if (over != 0) bytes(unit - over);
    return numberOf<T>(bytes(sizeof(T)).data(), is_little_ != isLittleHost());
  }
  // The zero at the end counts.
  Bytes textBytes() {
    const Bytes text = bytes(number<std::uint32_t>());
    const bool has_zero = text.size() > 0 && text[text.size() - 1] == 0;
    return has_zero ? Bytes(text.data(), text.size() - 1) : text;
  }

 private:
  static constexpr std::size_t kHead = 4;
  bool is_little_ = true;
  std::size_t most_aligned_ = 8;
};

}  // namespace ros
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_DATASETS_ROS_SRC_MESSAGES_WIRE_H
