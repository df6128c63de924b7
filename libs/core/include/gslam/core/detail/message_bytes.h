// Values as bytes and back, between two processes of one machine and one build.
#ifndef GSLAM_CORE_DETAIL_MESSAGE_BYTES_H
#define GSLAM_CORE_DETAIL_MESSAGE_BYTES_H

#include <gslam/base/error.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace detail {

// Values one after the other.
class MessageWriter {
 public:
  template <class T>
  void raw(const T& value) {
    static_assert(std::is_trivially_copyable<T>::value, "its bytes must be all there is of it");
    append(&value, sizeof(T));
  }
  void text(const std::string& value) {
    raw(std::uint64_t(value.size()));
    append(value.data(), value.size());
  }
  template <class T>
  void list(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable<T>::value, "its bytes must be all there is of it");
    raw(std::uint64_t(values.size()));
    append(values.data(), values.size() * sizeof(T));
  }
  const std::vector<char>& bytes() const noexcept { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    const char* const begin = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }

  std::vector<char> bytes_;
};

// Reads what a MessageWriter wrote. Whoever sends may be broken: nothing is read or allocated
// beyond the bytes that are there.
class MessageReader {
 public:
  explicit MessageReader(const std::vector<char>& bytes)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  template <class T>
  void raw(T& value) {
    static_assert(std::is_trivially_copyable<T>::value, "its bytes must be all there is of it");
    std::memcpy(static_cast<void*>(&value), take(sizeof(T)), sizeof(T));
  }
  template <class T>
  T number() {
    T value;
    raw(value);
    return value;
  }
  bool boolean() { return number<std::uint8_t>() != 0; }
  std::string text() {
    const std::size_t size = count(1);
    return std::string(take(size), size);
  }
  template <class T>
  std::vector<T> list() {
    static_assert(std::is_trivially_copyable<T>::value, "its bytes must be all there is of it");
    std::vector<T> values(count(sizeof(T)));
    const std::size_t size = values.size() * sizeof(T);
    const char* const begin = take(size);
    if (size != 0) std::memcpy(static_cast<void*>(values.data()), begin, size);
    return values;
  }
  // Number of things that follow, each of `least` bytes or more.
  std::size_t count(std::size_t least) {
    const std::uint64_t number_of = number<std::uint64_t>();
    if (number_of > std::uint64_t(end_ - at_) / least) fail();
    return std::size_t(number_of);
  }
  void expectEnd() const {
    if (at_ != end_) fail();
  }

 private:
  const char* take(std::size_t size) {
    if (size > std::size_t(end_ - at_)) fail();
    const char* const begin = at_;
    at_ += size;
    return begin;
  }
  [[noreturn]] static void fail() { throw Error("a message has another size than what it holds"); }

  const char* at_;
  const char* end_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_MESSAGE_BYTES_H
