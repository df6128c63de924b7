#ifndef GSLAM_CORE_MEMORY_DATASET_H
#define GSLAM_CORE_MEMORY_DATASET_H

#include <gslam/base/error.h>
#include <gslam/core/dataset.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// @file
/// A dataset whose frames are in memory.

namespace gslam {
inline namespace v1 {

/// Frames that are in memory already: for tests, and for programs that have frames of their own.
class MemoryDataset : public Dataset {
 public:
  /// @param info    its `frame_count` and stamps are set to those of the frames
  /// @param frames  in order, none null; each goes out as it is
  /// @throws ArgumentError when one is null, or the ids do not count up from 0
  MemoryDataset(DatasetInfo info, std::vector<std::shared_ptr<const Frame>> frames)
      : info_(std::move(info)), frames_(std::move(frames)) {
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const std::string name = "frame " + std::to_string(i);
      if (frames_[i] == nullptr) throw ArgumentError(name, "is null");
      if (frames_[i]->id != i) {
        throw ArgumentError(name, "has the id " + std::to_string(frames_[i]->id) +
                                      ", expected ids that count up from 0");
      }
    }
    info_.frame_count = frames_.size();
    info_.first_stamp = frames_.empty() ? 0 : frames_.front()->stamp;
    info_.last_stamp = frames_.empty() ? 0 : frames_.back()->stamp;
    info_.is_live = false;
  }

  const DatasetInfo& info() const override { return info_; }

  std::shared_ptr<const Frame> next() override {
    return next_ < frames_.size() ? frames_[next_++] : nullptr;
  }

  void seek(std::size_t index) override {
    if (index > frames_.size()) {
      throw ArgumentError("index", "is " + std::to_string(index) + ", but there are " +
                                       std::to_string(frames_.size()) + " frames");
    }
    next_ = index;
  }

 private:
  DatasetInfo info_;
  std::vector<std::shared_ptr<const Frame>> frames_;
  std::size_t next_ = 0;
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_MEMORY_DATASET_H
