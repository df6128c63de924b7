// Instantiates the templates and kernels of GSLAM::base; compiled alone under every compiler and
// standard by tests/headers.
#include <gslam/base.h>

#include "dot_kernel.h"

template class gslam::Span<int>;
template class gslam::Span<const double>;
template class gslam::SimdKernel<dot_kernel::Function>;

float instantiateBase(const float* a, std::size_t n);

float instantiateBase(const float* a, std::size_t n) {
  GSLAM_LOG(info) << "instantiated";
  gslam::parallelFor(0, n, [](std::size_t) {});
  const float sum = gslam::parallelReduce(
      0, n, 0.0f, [a](std::size_t first, std::size_t) { return a[first]; },
      [](float x, float y) { return x + y; });
  return sum + dot_kernel::dot().active()(a, a, n) +
         gslam::ThreadPool::shared().submit([] { return 1.0f; }).get();
}
