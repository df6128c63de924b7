// The bytes that a vocabulary lies in: memory, or a file that is mapped.
#ifndef GSLAM_VOCABULARY_DETAIL_STORAGE_H
#define GSLAM_VOCABULARY_DETAIL_STORAGE_H

#include <gslam/vocabulary/detail/mapped_file.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

class Storage {
 public:
  static constexpr std::size_t kAlignment = 64;

  // Memory, all zeros.
  static std::shared_ptr<Storage> ofSize(std::size_t size) {
    std::shared_ptr<Storage> storage(new Storage);
    storage->memory_.reset(new std::uint8_t[size + kAlignment]());
    const std::size_t over = reinterpret_cast<std::uintptr_t>(storage->memory_.get()) % kAlignment;
    storage->data_ = storage->memory_.get() + (over == 0 ? 0 : kAlignment - over);
    storage->size_ = size;
    return storage;
  }
  static std::shared_ptr<const Storage> ofFile(MappedFile&& file) {
    std::shared_ptr<Storage> storage(new Storage);
    storage->size_ = file.size();
    storage->file_ = std::move(file);
    return storage;
  }

  const std::uint8_t* data() const noexcept {
    return data_ != nullptr ? data_ : static_cast<const std::uint8_t*>(file_.data());
  }
  std::uint8_t* data() noexcept { return data_; }  // null: a file
  std::size_t size() const noexcept { return size_; }
  bool isMapped() const noexcept {
    return GSLAM_DETAIL_HAS_MMAP != 0 && data_ == nullptr && size_ != 0;
  }

 private:
  Storage() = default;

  std::unique_ptr<std::uint8_t[]> memory_;
  std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
  MappedFile file_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_VOCABULARY_DETAIL_STORAGE_H
