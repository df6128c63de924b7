// Function bodies of svar.h: laying one value over another, and JSON patches (RFC 6902).
#ifndef GSLAM_SVAR_DETAIL_SVAR_PATCH_H
#define GSLAM_SVAR_DETAIL_SVAR_PATCH_H

#include <gslam/svar/detail/svar_parts.h>
#include <gslam/svar/svar.h>

namespace gslam {
inline namespace v1 {
namespace detail {

inline bool areObjects(const Svar& a, const Svar& b) {
  return a.type() == SvarType::object && b.type() == SvarType::object;
}

// --- merged()

/// Moves the members of one object into another; lists the pairs that are left to be merged.
inline void mergeMembers(Svar into, const Svar& over, std::vector<std::pair<Svar, Svar>>& todo) {
  SvarParts::Members& members = SvarParts::ownMembers(into);
  for (const Svar::Member& member : over.members()) {
    Svar* const there = members.find(member.first);
    if (there == nullptr) {
      members.insert(member.first, member.second);
    } else if (areObjects(*there, member.second)) {
      todo.emplace_back(*there, member.second);
    } else {
      *there = member.second;
    }
  }
}

// --- diff()

/// Collects the operations of a patch.
class PatchMaker {
 public:
  Svar make(const Svar& from, const Svar& to) {
    todo_.push_back({from, to, ""});
    while (!todo_.empty()) {
      const Pair next = todo_.back();
      todo_.pop_back();
      compare(next);
    }
    return patch_;
  }

 private:
  struct Pair {
    Svar from;
    Svar to;
    std::string path;
  };

  void compare(const Pair& pair) {
    if (areObjects(pair.from, pair.to)) {
      compareObjects(pair);
    } else if (pair.from.type() == SvarType::array && pair.to.type() == SvarType::array) {
      compareArrays(pair);
    } else if (pair.from != pair.to) {
      add("replace", pair.path, &pair.to);
    }
  }

  void compareObjects(const Pair& pair) {
    for (const Svar::Member& member : pair.from.members()) {
      const std::string path = pair.path + "/" + escapeName(member.first);
      const Svar* const now = SvarParts::member(pair.to, member.first);
      if (now == nullptr) {
        add("remove", path, nullptr);
      } else {
        todo_.push_back({member.second, *now, path});
      }
    }
    for (const Svar::Member& member : pair.to.members()) {
      if (SvarParts::member(pair.from, member.first) != nullptr) continue;
      add("add", pair.path + "/" + escapeName(member.first), &member.second);
    }
  }

  // Elements at both ends are kept; those between are compared one by one, then added or removed.
  void compareArrays(const Pair& pair) {
    const SvarParts::Elements& from = SvarParts::elements(pair.from);
    const SvarParts::Elements& to = SvarParts::elements(pair.to);
    std::size_t begin = 0;
    while (begin < from.size() && begin < to.size() && from[begin] == to[begin]) ++begin;
    std::size_t from_end = from.size();
    std::size_t to_end = to.size();
    while (from_end > begin && to_end > begin && from[from_end - 1] == to[to_end - 1]) {
      --from_end;
      --to_end;
    }
    const std::size_t both = from_end < to_end ? from_end : to_end;
    const auto path = [&pair](std::size_t i) { return pair.path + "/" + std::to_string(i); };
    for (std::size_t i = begin; i < both; ++i) todo_.push_back({from[i], to[i], path(i)});
    for (std::size_t i = from_end; i > both; --i) add("remove", path(i - 1), nullptr);
    for (std::size_t i = both; i < to_end; ++i) add("add", path(i), &to[i]);
  }

  void add(const char* op, const std::string& path, const Svar* value) {
    Svar operation = Svar::object({{"op", op}, {"path", path}});
    if (value != nullptr) operation.set("value", value->clone());
    patch_.push_back(operation);
  }

  std::vector<Pair> todo_;
  Svar patch_ = Svar::array();
};

// --- patched()

/// A value to which operations are applied one by one.
class PatchTarget {
 public:
  explicit PatchTarget(const Svar& value) : value_(value.clone()) {}
  const Svar& value() const { return value_; }

  void apply(const Svar& operation) {
    const std::string op = operation.get<std::string>("op");
    const std::string path = operation.get<std::string>("path");
    checkPointer(path);
    if (op == "add") {
      add(path, operation.get<Svar>("value").clone());
    } else if (op == "replace") {
      replace(path, operation.get<Svar>("value").clone());
    } else if (op == "remove") {
      remove(path);
    } else if (op == "test") {
      if (at(path) != operation.get<Svar>("value"))
        throw SvarError(path, "is not what \"test\" expects");
    } else if (op == "copy" || op == "move") {
      transfer(op, operation.get<std::string>("from"), path);
    } else {
      throw SvarError("op",
                      "expected add, remove, replace, move, copy or test, found \"" + op + "\"");
    }
  }

 private:
  static void checkPointer(const std::string& path) {
    if (!path.empty() && path[0] != '/') {
      throw SvarError(path, "expected a JSON pointer: empty, or with a / before each name");
    }
  }

  Svar at(const std::string& path) const { return path.empty() ? value_ : value_[path]; }

  void add(const std::string& path, const Svar& value) {
    if (path.empty()) {
      value_ = value;
      return;
    }
    const std::size_t last = path.rfind('/');
    Svar parent = at(path.substr(0, last));
    std::size_t index = 0;
    if (parent.type() != SvarType::array || !parseIndex(path.substr(last + 1), index)) {
      if (!parent.isNull()) return parent.set(path.substr(last), value);
      throw SvarError(path, "cannot be added to null");
    }
    SvarParts::Elements& elements = SvarParts::ownElements(parent);
    if (index > elements.size()) {
      throw SvarError(path, "cannot be added to an array of " + std::to_string(elements.size()));
    }
    elements.insert(elements.begin() + static_cast<std::ptrdiff_t>(index), value);
  }

  void replace(const std::string& path, const Svar& value) {
    at(path);  // throws where nothing stands there
    if (path.empty()) {
      value_ = value;
    } else {
      value_.set(path, value);
    }
  }

  void remove(const std::string& path) {
    at(path);
    if (path.empty()) throw SvarError("", "the whole value cannot be removed");
    value_.erase(path);
  }

  void transfer(const std::string& op, const std::string& from, const std::string& path) {
    checkPointer(from);
    if (op == "move" && path.size() > from.size() &&
        path.compare(0, from.size() + 1, from + "/") == 0) {
      throw SvarError(path, "cannot be moved into itself");
    }
    const Svar value = at(from).clone();
    if (op == "move" && path == from) return;
    if (op == "move") remove(from);
    add(path, value);
  }

  Svar value_;
};

}  // namespace detail

inline Svar Svar::merged(const Svar& over) const {
  if (!detail::areObjects(*this, over)) return over.clone();
  Svar result = clone();
  std::vector<std::pair<Svar, Svar>> todo(1, {result, over.clone()});
  while (!todo.empty()) {
    const std::pair<Svar, Svar> next = todo.back();
    todo.pop_back();
    detail::mergeMembers(next.first, next.second, todo);
  }
  return result;
}

inline Svar Svar::diff(const Svar& to) const {
  return detail::PatchMaker().make(*this, to);
}

inline Svar Svar::patched(const Svar& patch) const {
  detail::PatchTarget target(*this);
  std::size_t index = 0;
  for (const Svar& operation : patch) {
    try {
      target.apply(operation);
    } catch (const SvarError& error) {
      throw SvarError(std::to_string(index), "operation of a patch: " + std::string(error.what()));
    }
    ++index;
  }
  return target.value();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SVAR_PATCH_H
