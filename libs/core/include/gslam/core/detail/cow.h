// Storage that copies share until one of them writes to it.
#ifndef GSLAM_CORE_DETAIL_COW_H
#define GSLAM_CORE_DETAIL_COW_H

#include <atomic>
#include <memory>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {

// Who may write a node in place: the one whose token it carries. A copy takes the token from both
// sides, so that each gets a new one when it writes next; what carries the old one stays as it is
// for good.
//
// A count of references cannot say this: it is read without order, and another thread may be about
// to copy. A counter cannot name tokens: each plugin would have its own. So a token is an address,
// which stays taken as long as a node carries it.
class CowOwner {
 public:
  using Token = std::shared_ptr<const char>;

  CowOwner() noexcept : is_shared_(true) {}
  // Many threads may copy from one that nobody writes to.
  CowOwner(const CowOwner& other) noexcept : is_shared_(true) {
    other.is_shared_.store(true, std::memory_order_relaxed);
  }
  CowOwner(CowOwner&& other) noexcept
      : token_(std::move(other.token_)),
        is_shared_(other.is_shared_.load(std::memory_order_relaxed)) {
    other.is_shared_.store(true, std::memory_order_relaxed);
  }
  CowOwner& operator=(const CowOwner& other) noexcept { return *this = CowOwner(other); }
  CowOwner& operator=(CowOwner&& other) noexcept {
    if (this == &other) return *this;
    token_ = std::move(other.token_);
    is_shared_.store(other.is_shared_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    other.is_shared_.store(true, std::memory_order_relaxed);
    return *this;
  }
  ~CowOwner() = default;

  // The token of who writes now.
  const Token& token() {
    if (is_shared_.load(std::memory_order_relaxed)) {
      token_ = std::make_shared<const char>('\0');
      is_shared_.store(false, std::memory_order_relaxed);
    }
    return token_;
  }

 private:
  Token token_;
  mutable std::atomic<bool> is_shared_;
};

struct MapLayout;

// A value on the heap, shared by copies, or none.
template <class T>
class Cow {
 public:
  // Null where there is none. It is the same value until the next edit().
  const T* get() const noexcept { return node_ ? &node_->value : nullptr; }

  // The value for its owner alone; makes one where there is none.
  T& edit(CowOwner& owner) {
    const CowOwner::Token& token = owner.token();
    if (node_ == nullptr) {
      node_ = std::make_shared<Node>(token);
    } else if (node_->token != token) {
      node_ = std::make_shared<Node>(token, node_->value);
    }
    return node_->value;
  }

  void reset() noexcept { node_.reset(); }

 private:
  friend struct MapLayout;

  struct Node {
    explicit Node(const CowOwner::Token& writer) : token(writer), value() {}
    Node(const CowOwner::Token& writer, const T& copied) : token(writer), value(copied) {}
    CowOwner::Token token;
    T value;
  };

  std::shared_ptr<Node> node_;
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_CORE_DETAIL_COW_H
