// Function bodies of shared.h, which says what they do.
#ifndef GSLAM_SVAR_DETAIL_SHARED_IMPL_H
#define GSLAM_SVAR_DETAIL_SHARED_IMPL_H

#include <gslam/svar/detail/svar_parts.h>
#include <gslam/svar/shared.h>

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

}  // namespace detail

// --- changing

// Makes the next tree of the present one under the lock, then calls back without it.
template <class MakeNext>
void SharedSvar::change(MakeNext make_next) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    commit(make_next(root_));
  }
  callBack();
}

// All rules are asked before anything changes.
inline void SharedSvar::commit(const Svar& next) {
  std::vector<std::pair<detail::SvarRule*, const Svar*>> changed;
  for (const std::unique_ptr<detail::SvarRule>& rule : rules_) {
    const Svar* const before = find(root_, rule->path());
    const Svar* const after = find(next, rule->path());
    if (after == nullptr && rule->mayBeMissing()) continue;
    if (after == nullptr) throw SvarError(rule->path(), "cannot be removed: it is in use");
    if (before != nullptr && *before == *after) continue;
    rule->check(*after);
    changed.emplace_back(rule.get(), after);
  }
  listCalls(root_, next);
  root_ = next;
  for (const auto& one : changed) one.first->take(*one.second);
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
  change([&](const Svar& root) { return with(root, path, frozen); });
}

inline void SharedSvar::merge(const Svar& over) {
  change([&](const Svar& root) { return root.merged(over).frozen(); });
}

inline bool SharedSvar::erase(detail::Text path) {
  bool erased = false;
  change([&](const Svar& root) {
    Svar next = detail::SvarParts::thawed(root, path);
    erased = next.erase(path);
    detail::SvarParts::seal(next);
    return next;
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
  void check(const Svar& value) const override { convert(value); }
  void take(const Svar& value) override { variable_.store(convert(value)); }
  const Bound<T>& variable() const noexcept { return variable_; }

 private:
  T convert(const Svar& value) const { return detail::partAs<T>(value, path()); }
  Bound<T> variable_;
};

template <class T>
const Bound<T>& SharedSvar::bind(detail::Text path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string name = path.str();
  for (const std::unique_ptr<detail::SvarRule>& rule : rules_) {
    BoundRule<T>* const same = dynamic_cast<BoundRule<T>*>(rule.get());
    if (same != nullptr && same->path() == name) return same->variable();
  }
  const Bound<T> variable(root_.get<T>(path));
  std::unique_ptr<BoundRule<T>> rule(new BoundRule<T>(name, variable));
  const Bound<T>& result = rule->variable();
  rules_.push_back(std::move(rule));
  return result;
}

template <class T>
const Bound<T>& SharedSvar::bind(detail::Text path,
                                 const typename std::common_type<T>::type& initial) {
  const Svar value = Svar(initial).frozen();
  change([&](const Svar& root) { return root.contains(path) ? root : with(root, path, value); });
  return bind<T>(path);
}

inline void SharedSvar::addRule(std::unique_ptr<detail::SvarRule> rule) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Svar* const there = find(root_, rule->path());
  if (there != nullptr) rule->check(*there);
  if (there == nullptr && !rule->mayBeMissing()) root_.get<Svar>(rule->path());  // throws
  rules_.push_back(std::move(rule));
}

inline void SharedSvar::addRule(std::unique_ptr<detail::SvarRule> rule, const Svar& initial) {
  const std::string path = rule->path();
  const Svar value = initial.frozen();
  change([&](const Svar& root) {
    const Svar* const there = find(root, path);
    rule->check(there != nullptr ? *there : value);
    Svar next = there != nullptr ? root : with(root, path, value);
    rules_.push_back(std::move(rule));
    return next;
  });
}

// --- callbacks

template <class F>
Watch SharedSvar::watch(detail::Text path, F callback) {
  snapshot().contains(path);  // refuses a malformed path
  const std::shared_ptr<detail::Watcher> watcher =
      std::make_shared<detail::Watcher>(path.str(), Svar::function(std::move(callback)));
  const std::lock_guard<std::mutex> lock(mutex_);
  watchers_.push_back(watcher);
  return Watch(watcher);
}

inline void SharedSvar::listCalls(const Svar& before, const Svar& after) {
  std::vector<std::shared_ptr<detail::Watcher>> alive;
  for (const std::shared_ptr<detail::Watcher>& watcher : watchers_) {
    if (watcher.use_count() == 1) continue;  // its Watch is gone
    alive.push_back(watcher);
    const Svar* const was = find(before, watcher->path());
    const Svar* const is = find(after, watcher->path());
    if (was == is || (was != nullptr && is != nullptr && *was == *is)) continue;
    calls_.push_back({watcher, is != nullptr ? *is : Svar()});
  }
  watchers_.swap(alive);
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
