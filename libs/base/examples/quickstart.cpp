#include <gslam/base.h>

#include <cstdio>
#include <iostream>
#include <vector>

int main() {
  gslam::setLogSink(gslam::streamLogSink(std::cerr), gslam::LogLevel::warning);

  std::vector<double> squares(1000);
  gslam::parallelFor(0, squares.size(),
                     [&](std::size_t i) { squares[i] = static_cast<double>(i * i); });

  const gslam::Span<const double> all(squares);
  std::printf("last square: %.0f, SIMD variant: %s\n", all.last(1)[0],
              gslam::simdName(gslam::activeSimd()));
  try {
    all.at(1000);
  } catch (const gslam::Error& error) {
    GSLAM_LOG(warning) << error.what();
  }
}
