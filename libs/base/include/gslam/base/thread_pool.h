#ifndef GSLAM_BASE_THREAD_POOL_H
#define GSLAM_BASE_THREAD_POOL_H

#include <gslam/base/workers.h>

#include <future>
#include <memory>
#include <type_traits>
#include <utility>

/// @file
/// A fixed set of worker threads, with futures of what they do.

namespace gslam {
inline namespace v1 {
namespace detail {

// What ThreadPool::submit() gives.
template <class Task>
struct Submitted {
  using Result = decltype(std::declval<typename std::decay<Task>::type&>()());
  using Future = std::future<Result>;
};

}  // namespace detail

template <class Task>
typename detail::Submitted<Task>::Future ThreadPool::submit(Task&& task) {
  using Result = typename detail::Submitted<Task>::Result;
  // Shared, because std::function wants what it holds to be copyable.
  auto packaged = std::make_shared<std::packaged_task<Result()>>(std::forward<Task>(task));
  std::future<Result> result = packaged->get_future();
  post([packaged] { (*packaged)(); });
  return result;
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_BASE_THREAD_POOL_H
