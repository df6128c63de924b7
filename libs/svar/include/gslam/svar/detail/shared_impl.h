// Function bodies of shared.h, which says what they do.
#ifndef GSLAM_SVAR_DETAIL_SHARED_IMPL_H
#define GSLAM_SVAR_DETAIL_SHARED_IMPL_H

#include <gslam/svar/detail/svar_parts.h>
#include <gslam/svar/shared.h>

#include <cmath>

namespace gslam {
inline namespace v1 {
namespace detail {

inline Svar SvarParts::thawed(const Svar& value, Text path) {
  Svar copy(value);
  Svar* at = &copy;
  PathReader reader(path);
  while (at != nullptr && at->isContainer()) {
    at->detach(false);
    at = at->child(reader.name());
    if (reader.isLast()) break;
    reader.next();
  }
  return copy;
}

inline void SvarParts::seal(const Svar& value) {
  std::vector<const Svar*> todo(1, &value);
  while (!todo.empty()) {
    const Svar& next = *todo.back();
    todo.pop_back();
    if (next.isFrozen()) continue;
    next.setFrozen();
    next.forEachContainer([&todo](const Svar& part) { todo.push_back(&part); });
  }
}

inline bool SvarParts::same(const Svar& a, const Svar& b) {
  std::vector<std::pair<const Svar*, const Svar*>> todo(1, {&a, &b});
  while (!todo.empty()) {
    const Svar& one = *todo.back().first;
    const Svar& other = *todo.back().second;
    todo.pop_back();
    if (one.type() != other.type()) return false;
    if (one.type() == SvarType::real) {
      const bool both_nan = std::isnan(real(one)) && std::isnan(real(other));
      const bool same_sign = std::signbit(real(one)) == std::signbit(real(other));
      if (!both_nan && !(one == other && same_sign)) return false;
    } else if (!one.isContainer() || one.data_ == other.data_) {
      if (one != other) return false;
    } else if (one.size() != other.size()) {
      return false;
    } else if (one.type() == SvarType::array) {
      for (std::size_t i = 0; i < one.size(); ++i) {
        todo.emplace_back(&elements(one)[i], &elements(other)[i]);
      }
    } else {
      for (const Svar::Member& part : members(one)) {
        const Svar* const there = member(other, part.first);
        if (there == nullptr) return false;
        todo.emplace_back(&part.second, there);
      }
    }
  }
  return true;
}

/// Makes room for that many more, at least doubling, so that putting them there cannot fail.
template <class T>
void makeRoom(std::vector<T>& list, std::size_t count) {
  const std::size_t needed = list.size() + count;
  if (needed <= list.capacity()) return;
  list.reserve(needed < 2 * list.capacity() ? 2 * list.capacity() : needed);
}

}  // namespace detail

// --- changing

template <class Make>
void SharedSvar::apply(Make make) {
  Change change;  // before the lock, so that it outlives it
  const std::lock_guard<std::mutex> lock(mutex_);
  change.root = root_;
  make(change);
  commit(change);
}

template <class Make>
void SharedSvar::change(Make make) {
  apply(std::move(make));
  callBack();
}

// All rules are asked, and all memory is there, before anything changes.
inline void SharedSvar::commit(Change& change) {
  for (const std::unique_ptr<detail::SvarRule>& rule : rules_) {
    const Svar* const before = find(root_, rule->path());
    const Svar* const after = find(change.root, rule->path());
    if (after == nullptr && rule->mayBeMissing()) continue;
    if (after == nullptr) throw SvarError(rule->path(), "cannot be removed: it is in use");
    if (before != nullptr && detail::SvarParts::same(*before, *after)) continue;
    change.takings.push_back(rule->check(*after));
  }
  change.watchers = watchersAlive();
  std::vector<Call> calls = callsFor(change);
  detail::makeRoom(calls_, calls.size());
  detail::makeRoom(rules_, 1);

  root_.swap(change.root);
  watchers_.swap(change.watchers);
  for (Call& call : calls) calls_.push_back(std::move(call));
  if (change.rule != nullptr) rules_.push_back(std::move(change.rule));
  for (const std::unique_ptr<detail::SvarTaking>& one : change.takings) {
    if (one != nullptr) one->take();
  }
}

// The tree with another value, which must be frozen, at the path.
inline Svar SharedSvar::with(const Svar& root, detail::Text path, const Svar& value) {
  Svar next = detail::SvarParts::thawed(root, path);
  next.set(path, value);
  detail::SvarParts::seal(next);
  return next;
}

inline void SharedSvar::set(detail::Text path, const Svar& value) {
  const Svar frozen = value.frozen();
  change([&](Change& made) { made.root = with(made.root, path, frozen); });
}

inline void SharedSvar::merge(const Svar& over) {
  change([&](Change& made) { made.root = made.root.merged(over).frozen(); });
}

inline bool SharedSvar::erase(detail::Text path) {
  bool erased = false;
  change([&](Change& made) {
    Svar next = detail::SvarParts::thawed(made.root, path);
    erased = next.erase(path);
    detail::SvarParts::seal(next);
    made.root = next;
  });
  return erased;
}

inline const Svar* SharedSvar::find(const Svar& root, const std::string& path) {
  return detail::SvarParts::find(root, path);
}

// --- bound variables

template <class T>
class SharedSvar::BoundRule : public detail::SvarRule {
 public:
  BoundRule(const std::string& path, const Bound<T>& variable)
      : SvarRule(path, must_be_there), variable_(variable) {}
  std::unique_ptr<detail::SvarTaking> check(const Svar& value) const override {
    return std::unique_ptr<detail::SvarTaking>(
        new Taking(variable_, detail::partAs<T>(value, path())));
  }
  const Bound<T>& variable() const noexcept { return variable_; }

 private:
  class Taking : public detail::SvarTaking {
   public:
    Taking(const Bound<T>& variable, T next)
        : variable_(variable), next_(detail::SharedValue<T>::make(std::move(next))) {}
    void take() noexcept override { variable_.store(next_); }

   private:
    const Bound<T> variable_;
    typename Bound<T>::Made next_;  // then what was there before
  };

  const Bound<T> variable_;
};

template <class T>
const Bound<T>& SharedSvar::bind(detail::Text path) {
  return bindOver<T>(path, nullptr);
}

template <class T>
const Bound<T>& SharedSvar::bind(detail::Text path,
                                 const typename std::common_type<T>::type& initial) {
  const Svar value = Svar(initial).frozen();
  return bindOver<T>(path, &value);
}

template <class T>
const Bound<T>& SharedSvar::bindOver(detail::Text path, const Svar* initial) {
  const Bound<T>* bound = nullptr;
  change([&](Change& made) {
    bound = findBound<T>(path.str());
    if (bound != nullptr) return;
    if (initial != nullptr && !made.root.contains(path)) {
      made.root = with(made.root, path, *initial);
    }
    const Bound<T> variable(made.root.get<T>(path));
    std::unique_ptr<BoundRule<T>> rule(new BoundRule<T>(path.str(), variable));
    bound = &rule->variable();
    made.rule = std::move(rule);
  });
  return *bound;
}

template <class T>
const Bound<T>* SharedSvar::findBound(const std::string& path) const {
  for (const std::unique_ptr<detail::SvarRule>& rule : rules_) {
    const BoundRule<T>* const same = dynamic_cast<const BoundRule<T>*>(rule.get());
    if (same != nullptr && same->path() == path) return &same->variable();
  }
  return nullptr;
}

inline void SharedSvar::addRule(std::unique_ptr<detail::SvarRule> rule, const Svar* initial) {
  const Svar value = initial != nullptr ? initial->frozen() : Svar();
  change([&](Change& made) {
    const std::string& path = rule->path();
    if (initial != nullptr && find(made.root, path) == nullptr) {
      made.root = with(made.root, path, value);
    }
    const Svar* const there = find(made.root, path);
    if (there != nullptr) rule->check(*there);
    made.rule = std::move(rule);
  });
}

// --- callbacks

template <class F>
Watch SharedSvar::watch(detail::Text path, F callback) {
  snapshot().contains(path);  // refuses a malformed path
  const std::shared_ptr<detail::Watcher> watcher =
      std::make_shared<detail::Watcher>(path.str(), Svar::function(std::move(callback)));
  std::vector<std::shared_ptr<detail::Watcher>> former;  // destroyed without the lock
  const std::lock_guard<std::mutex> lock(mutex_);
  if (watchers_.size() == watchers_.capacity()) {
    former = watchersAlive();
    watchers_.swap(former);
  }
  watchers_.push_back(watcher);
  return Watch(watcher);
}

// Those whose Watch is there still.
inline std::vector<std::shared_ptr<detail::Watcher>> SharedSvar::watchersAlive() const {
  std::vector<std::shared_ptr<detail::Watcher>> alive;
  for (const std::shared_ptr<detail::Watcher>& watcher : watchers_) {
    if (watcher.use_count() > 1) alive.push_back(watcher);
  }
  return alive;
}

inline std::vector<SharedSvar::Call> SharedSvar::callsFor(const Change& change) const {
  std::vector<Call> calls;
  for (const std::shared_ptr<detail::Watcher>& watcher : change.watchers) {
    const Svar* const was = find(root_, watcher->path());
    const Svar* const is = find(change.root, watcher->path());
    if (was == is) continue;
    if (was != nullptr && is != nullptr && detail::SvarParts::same(*was, *is)) continue;
    calls.push_back({watcher, is != nullptr ? *is : Svar()});
  }
  return calls;
}

inline void SharedSvar::callBack() {
  std::exception_ptr problem;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    if (calling_) return;  // who is at it makes our calls, too
    calling_ = true;
    while (!calls_.empty()) {
      std::vector<Call> calls;
      calls.swap(calls_);
      lock.unlock();
      const std::exception_ptr one = callAll(calls);
      if (problem == nullptr) problem = one;
      lock.lock();
    }
    calling_ = false;
  }
  if (problem != nullptr) std::rethrow_exception(problem);
}

// Gives the first exception, if any.
inline std::exception_ptr SharedSvar::callAll(const std::vector<Call>& calls) {
  std::exception_ptr problem;
  for (const Call& call : calls) {
    try {
      call.watcher->call(call.value);
    } catch (...) {
      if (problem == nullptr) problem = std::current_exception();
    }
  }
  return problem;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SHARED_IMPL_H
