// Function bodies of svar.h that go through the whole depth of a value. Each keeps a list of what
// is left to do in place of recursion, so that no depth overflows the stack.
#include <gslam/svar/svar.h>  // includes this file, so that it comes before the guard

#ifndef GSLAM_SVAR_DETAIL_SVAR_DEEP_H
#define GSLAM_SVAR_DETAIL_SVAR_DEEP_H

#include <gslam/svar/detail/svar_traits.h>

namespace gslam {
inline namespace v1 {

template <class F>
void Svar::forEachContainer(Array& parts, F f) {
  for (Svar& part : parts) {
    if (part.isContainer()) f(part);
  }
}

template <class F>
void Svar::forEachContainer(Object& parts, F f) {
  for (Member& part : parts.members()) {
    if (part.second.isContainer()) f(part.second);
  }
}

template <class F>
void Svar::forEachContainer(F f) const {
  if (type_ == SvarType::array) forEachContainer(asArray(), f);
  if (type_ == SvarType::object) forEachContainer(asObject(), f);
}

namespace detail {

template <class T>
void swapIfSame(T& a, T& b) noexcept {
  a.swap(b);
}
template <class T, class U>
void swapIfSame(T&, U&) noexcept {}

}  // namespace detail

// Left to themselves, destructors of nested parts would recurse as deep as the value is. So the
// outermost one on this thread lists the parts and destroys them one by one; those of the parts
// only add to its list. The elements of an outermost array need no other list than their own.
template <class Parts>
void Svar::releaseContainers(Parts& parts) noexcept {
  std::vector<Svar>*& outermost = pendingOnThisThread();
  std::vector<Svar> mine;
  if (outermost == nullptr) detail::swapIfSame(mine, parts);
  std::vector<Svar>* const list = outermost != nullptr ? outermost : &mine;
  try {
    forEachContainer(parts, [list](Svar& part) { list->push_back(std::move(part)); });
  } catch (...) {
    // No memory for the list: what is not in it is destroyed by recursion after all.
  }
  if (mine.empty()) return;
  outermost = &mine;
  while (!mine.empty()) {
    const Svar last = std::move(mine.back());
    mine.pop_back();
  }
  outermost = nullptr;
}

inline std::vector<Svar>*& Svar::pendingOnThisThread() noexcept {
  static thread_local std::vector<Svar>* pending = nullptr;
  return pending;
}

inline void Svar::detach(bool freeze) {
  if (type_ == SvarType::array) data_ = std::make_shared<Node<Array>>(asArray());
  if (type_ == SvarType::object) data_ = std::make_shared<Node<Object>>(asObject());
  if (freeze) setFrozen();
}

inline void Svar::setFrozen() const noexcept {
  if (type_ == SvarType::array) static_cast<Node<Array>*>(data_.get())->frozen = true;
  if (type_ == SvarType::object) static_cast<Node<Object>*>(data_.get())->frozen = true;
}

inline bool Svar::isFrozen() const noexcept {
  if (type_ == SvarType::array) return static_cast<Node<Array>*>(data_.get())->frozen;
  return type_ != SvarType::object || static_cast<Node<Object>*>(data_.get())->frozen;
}

// To be frozen, what is frozen already need not be copied.
inline Svar Svar::copied(bool freeze) const {
  Svar copy(*this);
  const auto has_to_be = [freeze](const Svar& s) {
    return s.isContainer() && !(freeze && s.isFrozen());
  };
  List todo;
  if (has_to_be(copy)) todo.push_back(&copy);
  while (!todo.empty()) {
    Svar* const next = const_cast<Svar*>(todo.back());  // the copy or a part of it
    todo.pop_back();
    next->detach(freeze);
    next->forEachContainer([&](Svar& part) {
      if (has_to_be(part)) todo.push_back(&part);
    });
  }
  return copy;
}

inline Svar Svar::clone() const {
  return copied(false);
}

inline Svar Svar::frozen() const {
  return copied(true);
}

namespace detail {

/// The first index below `count` for which `before` is false, or `count`; std::partition_point for
/// indices.
template <class Before>
std::size_t partitionPoint(std::size_t count, Before before) {
  std::size_t first = 0;
  while (count > 0) {
    const std::size_t half = count / 2;
    const bool right = before(first + half);
    if (right) first += half + 1;
    count = right ? count - half - 1 : half;
  }
  return first;
}

}  // namespace detail

// Whether this is, or contains, that array or object.
inline bool Svar::reaches(const void* container) const {
  if (!isContainer()) return false;
  List todo(1, this);
  List seen;
  while (!todo.empty()) {
    const Svar& next = *todo.back();
    todo.pop_back();
    if (next.data_.get() == container) return true;
    if (next.isShared() && !next.insertInto(seen)) continue;
    next.forEachContainer([&todo](const Svar& part) { todo.push_back(&part); });
  }
  return false;
}

// Into a list that is sorted by where the parts are. False where a handle of them is there already.
inline bool Svar::insertInto(List& sorted) const {
  const auto address = [](const Svar* s) {
    return reinterpret_cast<std::uintptr_t>(s->data_.get());
  };
  const std::size_t k = detail::partitionPoint(
      sorted.size(), [&](std::size_t i) { return address(sorted[i]) < address(this); });
  if (k < sorted.size() && address(sorted[k]) == address(this)) return false;
  sorted.insert(sorted.begin() + static_cast<std::ptrdiff_t>(k), this);
  return true;
}

inline bool Svar::equals(const Svar& other) const {
  List todo;  // a of a pair, then its b
  if (!equalHeads(*this, other, todo)) return false;
  while (!todo.empty()) {
    const Svar& b = *todo.back();
    todo.pop_back();
    const Svar& a = *todo.back();
    todo.pop_back();
    if (!equalParts(a, b, todo)) return false;
  }
  return true;
}

inline bool Svar::same(const Svar& a, const Svar& b) {
  if (a.type_ != SvarType::native) return a.data_ == b.data_;
  return a.asNative().same(b.asNative());
}

// All but the parts of arrays and objects, which are left to do.
inline bool Svar::equalHeads(const Svar& a, const Svar& b, List& todo) {
  if (a.type_ != b.type_) return false;
  switch (a.type_) {
    case SvarType::null:
      return true;
    case SvarType::boolean:
    case SvarType::integer:
      return a.number_.integer == b.number_.integer;
    case SvarType::real:
      return a.number_.real == b.number_.real;
    case SvarType::string:
    case SvarType::binary:
      return a.asString() == b.asString();
    case SvarType::function:
    case SvarType::native:
      return same(a, b);
    case SvarType::array:
    case SvarType::object:
      break;
  }
  if (a.data_ == b.data_) return true;
  todo.push_back(&a);
  todo.push_back(&b);
  return true;
}

inline bool Svar::equalParts(const Svar& a, const Svar& b, List& todo) {
  if (a.size() != b.size()) return false;
  if (a.type_ == SvarType::array) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!equalHeads(a.asArray()[i], b.asArray()[i], todo)) return false;
    }
    return true;
  }
  for (const Member& member : a.asObject().members()) {
    const Svar* const other = b.asObject().find(member.first);
    if (other == nullptr || !equalHeads(member.second, *other, todo)) return false;
  }
  return true;
}

// Of all that is not inside; arrays and objects by their type and size.
inline std::uint64_t Svar::hashHead() const {
  const std::uint64_t type = static_cast<std::uint64_t>(type_);
  if (isContainer()) return detail::mixWords(type, size());
  if (type_ == SvarType::string || type_ == SvarType::binary) {
    return detail::hashBytes(asString().data(), asString().size(), type);
  }
  if (type_ == SvarType::native) {
    return detail::mixWords(type, reinterpret_cast<std::uintptr_t>(asNative().object().get()));
  }
  if (type_ == SvarType::function) {
    return detail::mixWords(type, reinterpret_cast<std::uintptr_t>(data_.get()));
  }
  if (type_ == SvarType::real) {
    const double real = number_.real == 0 ? 0.0 : number_.real;  // -0.0 equals 0.0
    return detail::mixWords(type,
                            detail::loadWord<std::uint64_t>(reinterpret_cast<const char*>(&real)));
  }
  return detail::mixWords(type, isNull() ? 0 : static_cast<std::uint64_t>(number_.integer));
}

// The sum over all parts of what each is and where: a sum does not depend on the order of members.
inline std::size_t Svar::hash() const {
  std::vector<std::pair<const Svar*, std::uint64_t>> todo(1, {this, 0});
  std::uint64_t sum = 0;
  while (!todo.empty()) {
    const Svar& value = *todo.back().first;
    const std::uint64_t place = todo.back().second;
    todo.pop_back();
    sum += detail::mixWords(place, value.hashHead());
    std::uint64_t index = 0;
    if (value.type_ == SvarType::array) {
      for (const Svar& part : value) todo.emplace_back(&part, detail::mixWords(place, ++index));
    }
    if (value.type_ == SvarType::object) {
      for (const Member& part : value.members()) {
        const std::string& name = part.first;
        todo.emplace_back(&part.second, detail::hashBytes(name.data(), name.size(), place + 1));
      }
    }
  }
  return static_cast<std::size_t>(sum);
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SVAR_DEEP_H
