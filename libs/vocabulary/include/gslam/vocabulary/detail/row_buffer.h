// Memory for rows, which the system gives when it is written.
#ifndef GSLAM_VOCABULARY_DETAIL_ROW_BUFFER_H
#define GSLAM_VOCABULARY_DETAIL_ROW_BUFFER_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>

namespace gslam {
inline namespace v1 {
namespace detail {

class RowBuffer {
 public:
  RowBuffer(std::size_t rows, std::size_t stride) : rows_(rows), stride_(stride) {
    if (rows > (std::numeric_limits<std::size_t>::max() - kAlignment) / stride) {
      throw std::bad_alloc();
    }
    memory_.reset(new std::uint8_t[rows * stride + kAlignment]);
    const std::size_t over = reinterpret_cast<std::uintptr_t>(memory_.get()) % kAlignment;
    data_ = memory_.get() + (over == 0 ? 0 : kAlignment - over);
  }

  std::size_t rows() const noexcept { return rows_; }
  std::size_t stride() const noexcept { return stride_; }
  std::uint8_t* row(std::size_t i) noexcept { return data_ + i * stride_; }
  const std::uint8_t* row(std::size_t i) const noexcept { return data_ + i * stride_; }

 private:
  static constexpr std::size_t kAlignment = 64;

  std::size_t rows_;
  std::size_t stride_;
  std::unique_ptr<std::uint8_t[]> memory_;
  std::uint8_t* data_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_ROW_BUFFER_H
