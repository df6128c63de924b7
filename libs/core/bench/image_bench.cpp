// Images: what copying their pixels costs beside memcpy, and what sharing them costs.
#include <benchmark/benchmark.h>
#include <gslam/core/image.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace {

using gslam::Image;
using gslam::PixelType;

Image vga() {
  return Image(752, 480, PixelType::u8);
}
Image colour() {
  return Image(1920, 1080, PixelType::u8, 3);
}

void setBytes(benchmark::State& state, const Image& image) {
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(
                                                   image.rowBytes() * std::size_t(image.height())));
}

void clone(benchmark::State& state, const Image& image) {
  for (auto _ : state) {
    const Image copy = image.clone();
    benchmark::DoNotOptimize(copy.bytes());
    benchmark::ClobberMemory();
  }
  setBytes(state, image);
}

// The same with the C library: new memory, one copy.
void cloneByHand(benchmark::State& state, const Image& image) {
  const std::size_t size = image.rowBytes() * std::size_t(image.height());
  for (auto _ : state) {
    void* const copy = std::malloc(size);
    std::memcpy(copy, image.bytes(), size);
    benchmark::DoNotOptimize(copy);
    benchmark::ClobberMemory();
    std::free(copy);
  }
  setBytes(state, image);
}

void copyHandle(benchmark::State& state) {
  const Image image = vga();
  for (auto _ : state) {
    const Image copy = image;
    benchmark::DoNotOptimize(copy.bytes());
  }
}

void copySharedPtr(benchmark::State& state) {
  const auto memory = std::make_shared<int>(1);
  for (auto _ : state) {
    const std::shared_ptr<int> copy = memory;
    benchmark::DoNotOptimize(copy.get());
  }
}

void makeView(benchmark::State& state) {
  const Image image = vga();
  for (auto _ : state) {
    const Image part = image.view(10, 10, 100, 100);
    benchmark::DoNotOptimize(part.bytes());
  }
}

void sumRows(benchmark::State& state) {
  const Image image = vga();
  for (auto _ : state) {
    std::uint32_t sum = 0;
    for (int y = 0; y < image.height(); ++y) {
      const std::uint8_t* const row = image.row<std::uint8_t>(y);
      for (int x = 0; x < image.width(); ++x) sum += row[x];
    }
    benchmark::DoNotOptimize(sum);
  }
  setBytes(state, image);
}

BENCHMARK_CAPTURE(clone, / gslam / 752x480, vga())->Name("image_clone/gslam/752x480");
BENCHMARK_CAPTURE(cloneByHand, / memcpy / 752x480, vga())->Name("image_clone/memcpy/752x480");
BENCHMARK_CAPTURE(clone, / gslam / 1920x1080x3, colour())->Name("image_clone/gslam/1920x1080x3");
BENCHMARK_CAPTURE(cloneByHand, / memcpy / 1920x1080x3, colour())
    ->Name("image_clone/memcpy/1920x1080x3");
BENCHMARK_CAPTURE(clone, / gslam / view, colour().view(100, 100, 1000, 800))
    ->Name("image_clone/gslam/view_1000x800x3");
BENCHMARK(copyHandle)->Name("image_share/gslam");
BENCHMARK(copySharedPtr)->Name("image_share/shared_ptr");
BENCHMARK(makeView)->Name("image_view/gslam");
BENCHMARK(sumRows)->Name("image_sum/gslam/752x480");

}  // namespace
