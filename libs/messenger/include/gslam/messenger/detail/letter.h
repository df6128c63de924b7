// A message on its way through a topic.
#ifndef GSLAM_MESSENGER_DETAIL_LETTER_H
#define GSLAM_MESSENGER_DETAIL_LETTER_H

#include <memory>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

/// A message of a type that the topic knows. It is borrowed from the publisher until the first
/// subscriber wants to keep it; then it is put into shared storage, once for all.
class AnyLetter {
 public:
  AnyLetter() = default;
  virtual ~AnyLetter() = default;
  AnyLetter(const AnyLetter&) = delete;
  AnyLetter& operator=(const AnyLetter&) = delete;
  virtual std::shared_ptr<const void> shareAny() = 0;
  /// One that owns the message and may be read by several threads.
  virtual std::unique_ptr<AnyLetter> kept() = 0;
};

template <class T>
class Letter final : public AnyLetter {
 public:
  using Shared = std::shared_ptr<const T>;

  /// Shared already.
  explicit Letter(const Shared& message) noexcept : object_(message.get()), shared_(&message) {}
  /// Shared, and owned.
  struct Owned {};
  Letter(Owned, const Shared& message)
      : object_(message.get()), shared_(&stored_), stored_(message) {}
  /// To be copied by who keeps it.
  explicit Letter(const T& message) noexcept : object_(&message), store_(&copy) {}
  /// To be moved by who keeps it.
  explicit Letter(T&& message) noexcept : object_(&message), store_(&move) {}

  const T& object() const noexcept { return *object_; }

  const Shared& share() {
    if (shared_ == nullptr) {
      stored_ = store_(*object_);
      object_ = stored_.get();
      shared_ = &stored_;
    }
    return *shared_;
  }
  std::shared_ptr<const void> shareAny() override { return share(); }
  std::unique_ptr<AnyLetter> kept() override {
    return std::unique_ptr<AnyLetter>(new Letter(Owned(), share()));
  }

 private:
  static Shared copy(const T& message) { return std::make_shared<const T>(message); }
  static Shared move(const T& message) {
    return std::make_shared<const T>(std::move(const_cast<T&>(message)));  // it came as T&&
  }

  const T* object_;
  const Shared* shared_ = nullptr;
  Shared (*store_)(const T&) = nullptr;
  Shared stored_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_MESSENGER_DETAIL_LETTER_H
