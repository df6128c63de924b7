#ifndef GSLAM_SVAR_SHARED_H
#define GSLAM_SVAR_SHARED_H

#include <gslam/svar/bound.h>
#include <gslam/svar/svar.h>
#include <gslam/svar/watch.h>

#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

/// @file
/// A tree of values that threads read and write at the same time.

namespace gslam {
inline namespace v1 {
namespace detail {

/// What a rule does once a value that it allowed is there. Destroyed when no lock is held.
class SvarTaking {
 public:
  virtual ~SvarTaking() = default;
  virtual void take() noexcept = 0;
};

/// What must hold of the value at one path.
class SvarRule {
 public:
  enum Presence { must_be_there, may_be_missing };
  SvarRule(std::string path, Presence presence) : path_(std::move(path)), presence_(presence) {}
  virtual ~SvarRule() = default;
  const std::string& path() const noexcept { return path_; }
  bool mayBeMissing() const noexcept { return presence_ == may_be_missing; }
  /// What to do once the value is there; null for nothing.
  /// @throws SvarError where the value may not be there
  virtual std::unique_ptr<SvarTaking> check(const Svar& value) const = 0;

 private:
  const std::string path_;
  const Presence presence_;
};

}  // namespace detail

/// An object whose values threads read and write at the same time, with variables that follow one
/// value (bind()) and callbacks on changes (watch()).
///
/// What is in it is frozen (Svar::frozen()): a reader gets values that nobody changes any more, and
/// a writer replaces the objects on the way to what it changes. Reading takes a lock for as long as
/// copying one handle takes; writing takes time in proportion to the size of the objects on the
/// way, and to the number of bound variables.
///
/// All functions may be called by any threads at any time, also from callbacks; but not from the
/// SvarTraits<T>::fromSvar() of a bound type T, which runs under the lock. Each change is seen as a
/// whole or not at all. Paths, conversions and errors are those of Svar.
class SharedSvar {
 public:
  /// An empty object.
  SharedSvar() : SharedSvar(Svar::object()) {}
  /// A frozen copy.
  explicit SharedSvar(const Svar& initial) : root_(initial.frozen()) {}
  SharedSvar(const SharedSvar&) = delete;
  SharedSvar& operator=(const SharedSvar&) = delete;

  /// All that is in it now, as a frozen value that later changes do not reach.
  Svar snapshot() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return root_;
  }

  /// Whether something, be it null, stands at the path.
  bool contains(detail::Text path) const { return snapshot().contains(path); }
  /// As Svar::get().
  template <class T>
  T get(detail::Text path) const {
    return snapshot().get<T>(path);
  }
  /// As Svar::get() with a fallback for what is missing.
  template <class T>
  T get(detail::Text path, const typename std::common_type<T>::type& fallback) const {
    return snapshot().get<T>(path, fallback);
  }
  /// What stands at the path, frozen.
  /// @throws SvarError when nothing stands there
  Svar operator[](detail::Text path) const { return snapshot()[path]; }

  /// Puts a frozen copy of the value at the path, as Svar::set() does.
  /// @throws SvarError as Svar::set(), and when a bound variable could not take its new value;
  ///         nothing is changed then
  void set(detail::Text path, const Svar& value);
  /// Lays the other over what is there, as Svar::merged() does, all in one change.
  /// @throws SvarError when a bound variable could not take its new value; nothing is changed then
  void merge(const Svar& over);
  /// Removes what stands at the path. False where nothing stood there.
  /// @throws SvarError when a variable is bound there
  bool erase(detail::Text path);

  /// The variable that follows the value at the path. From now on only what is exactly a T may
  /// stand there: other values are refused where they are set. The reference is good as long as
  /// this, a copy of the variable for any time.
  /// @throws SvarError when nothing stands there or it is not exactly a T
  template <class T>
  const Bound<T>& bind(detail::Text path);
  /// The same; puts `initial` there where nothing is, in one step.
  /// @throws SvarError when what stands there is not exactly a T, or nothing can be put there;
  ///         nothing is changed then
  template <class T>
  const Bound<T>& bind(detail::Text path, const typename std::common_type<T>::type& initial);

  /// Calls back when the value at the path, or anything inside of it, has changed, come or gone,
  /// with the new value (null where it is gone), until the Watch is destroyed.
  ///
  /// Callbacks run one at a time and in the order of the changes, in a thread that writes, which
  /// holds no lock of this: mostly in the one that made the change and before its set() returns,
  /// but where another thread is just calling back, in that one. What a callback throws comes out
  /// of the function that called it, after all other callbacks have run; the change is made all the
  /// same.
  /// @param path      what to watch, be it there or not
  /// @param callback  anything that can be called with a Svar
  template <class F>
  GSLAM_NODISCARD Watch watch(detail::Text path, F callback);

 protected:
  /// The next tree while it is made. What it holds at the end is destroyed when the lock is
  /// released, for objects of the program may use the SharedSvar as they go.
  struct Change {
    Svar root;  ///< as it is now, then as it is to be, at the end as it was
    std::unique_ptr<detail::SvarRule> rule;                    ///< from now on; may be null
    std::vector<std::unique_ptr<detail::SvarTaking>> takings;  ///< of those who follow values
    std::vector<std::shared_ptr<detail::Watcher>> watchers;    ///< that have ended
  };

  /// Lets `make` change change.root and change.rule under the lock and makes it so; callbacks wait
  /// for callBack().
  /// @throws SvarError when a rule refuses, and what `make` throws; nothing is changed then
  template <class Make>
  void apply(Make make);
  /// Runs the callbacks that wait, unless somebody is at it.
  void callBack();
  /// From now on the value at the path of the rule must keep to it.
  /// @param rule     says what may stand there
  /// @param initial  put there where nothing is; may be null
  /// @throws SvarError when what is there does not; nothing is changed then
  void addRule(std::unique_ptr<detail::SvarRule> rule, const Svar* initial);

 private:
  template <class T>
  class BoundRule;
  struct Call {
    std::shared_ptr<detail::Watcher> watcher;
    Svar value;
  };

  template <class Make>
  void change(Make make);
  static Svar with(const Svar& root, detail::Text path, const Svar& value);
  void commit(Change& change);
  static const Svar* find(const Svar& root, const std::string& path);
  template <class T>
  const Bound<T>& bindOver(detail::Text path, const Svar* initial);
  template <class T>
  const Bound<T>* findBound(const std::string& path) const;
  std::vector<std::shared_ptr<detail::Watcher>> watchersAlive() const;
  std::vector<Call> callsFor(const Change& change) const;
  static std::exception_ptr callAll(const std::vector<Call>& calls);

  mutable std::mutex mutex_;  // guards all below
  Svar root_;
  std::vector<std::unique_ptr<detail::SvarRule>> rules_;
  std::vector<std::shared_ptr<detail::Watcher>> watchers_;
  std::vector<Call> calls_;
  bool calling_ = false;
};

}  // namespace v1
}  // namespace gslam

#include <gslam/svar/detail/shared_impl.h>

#endif  // GSLAM_SVAR_SHARED_H
