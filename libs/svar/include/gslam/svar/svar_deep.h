// Function bodies of svar.h that go through the whole depth of a value. Each keeps a list of what
// is left to do in place of recursion, so that no depth overflows the stack.
#ifndef GSLAM_SVAR_SVAR_DEEP_H
#define GSLAM_SVAR_SVAR_DEEP_H

#include <gslam/svar/svar.h>

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

// Left to themselves, destructors of nested parts would recurse as deep as the value is. So the
// outermost one on this thread lists the parts and destroys them one by one; those of the parts
// only add to its list.
template <class Parts>
void Svar::releaseContainers(Parts& parts) noexcept {
  std::vector<Svar>*& outermost = pendingOnThisThread();
  std::vector<Svar> mine;
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

inline void Svar::detach() {
  if (type_ == SvarType::array) data_ = std::make_shared<Node<Array>>(asArray());
  if (type_ == SvarType::object) data_ = std::make_shared<Node<Object>>(asObject());
}

inline Svar Svar::clone() const {
  Svar copy(*this);
  List todo(1, &copy);
  while (!todo.empty()) {
    Svar* const next = const_cast<Svar*>(todo.back());  // the copy or a part of it
    todo.pop_back();
    next->detach();
    next->forEachContainer([&todo](Svar& part) { todo.push_back(&part); });
  }
  return copy;
}

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
      return a.asString() == b.asString();
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
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.type_ == SvarType::array) {
      if (!equalHeads(a.asArray()[i], b.asArray()[i], todo)) return false;
    } else {
      const Member& x = a.asObject().byName(i);
      const Member& y = b.asObject().byName(i);
      if (x.first != y.first || !equalHeads(x.second, y.second, todo)) return false;
    }
  }
  return true;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_SVAR_DEEP_H
