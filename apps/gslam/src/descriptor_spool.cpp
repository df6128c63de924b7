#include "descriptor_spool.h"

#include <fcntl.h>
#include <gslam/base/error.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace app {

DescriptorSpool::DescriptorSpool(const std::string& beside) : name_(beside) {
  std::string path = beside + ".XXXXXX";
  file_ = mkostemp(path.data(), O_CLOEXEC);
  if (file_ < 0) throw gslam::FileError(beside, "cannot be written", errno);
  unlink(path.c_str());
}

DescriptorSpool::~DescriptorSpool() {
  if (memory_ != nullptr) munmap(memory_, size_);
  close(file_);
}

void DescriptorSpool::add(const gslam::Descriptors& image) {
  const std::size_t row = image.is_binary ? image.size : image.size * sizeof(float);
  gslam::Descriptors copy = image;
  copy.data = nullptr;  // until all are there
  copy.stride = row;
  if (image.stride == row) {
    write(image.row(0), image.count * row);
  } else {
    for (std::size_t i = 0; i < image.count; ++i) write(image.row(i), row);
  }
  images_.push_back(copy);
  count_ += image.count;
}

void DescriptorSpool::write(const std::uint8_t* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::write(file_, bytes + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      throw gslam::FileError(name_, "descriptors cannot be kept in a temporary file beside it",
                             errno);
    }
    done += static_cast<std::size_t>(count);
  }
  size_ += size;
}

gslam::Span<const gslam::Descriptors> DescriptorSpool::images() {
  if (memory_ != nullptr || size_ == 0) return images_;
  void* const memory = mmap(nullptr, size_, PROT_READ, MAP_SHARED, file_, 0);
  if (memory == MAP_FAILED) throw gslam::FileError(name_, "descriptors cannot be read", errno);
  memory_ = memory;
  const auto* at = static_cast<const std::uint8_t*>(memory_);
  for (gslam::Descriptors& image : images_) {
    image.data = at;
    at += image.count * image.stride;
  }
  return images_;
}

}  // namespace app
