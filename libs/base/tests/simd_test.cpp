#include <gmock/gmock.h>
#include <gslam/base/simd.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

#include "dot_kernel.h"

namespace {

using gslam::Simd;
using gslam::SimdKernel;
using testing::ElementsAre;
using testing::HasSubstr;

// Decides anew under a value of GSLAM_SIMD, and leaves everything as it was.
class Environment {
 public:
  explicit Environment(const char* value) : slot_(gslam::detail::activeSimdSlot().load()) {
    const char* const before = std::getenv("GSLAM_SIMD");
    if (before != nullptr) before_ = before;
    setenv("GSLAM_SIMD", value, 1);
    gslam::detail::activeSimdSlot().store(gslam::detail::kSimdUndecided);
  }
  ~Environment() {
    setenv("GSLAM_SIMD", before_.c_str(), 1);
    gslam::detail::activeSimdSlot().store(slot_);
  }

 private:
  std::string before_;
  int slot_;
};

TEST(Simd, EveryMachineRunsScalar) {
  EXPECT_EQ(gslam::availableSimd().front(), Simd::scalar);
  EXPECT_LE(gslam::availableSimd().size(), gslam::allSimd().size());
}

TEST(Simd, UnsetMeansTheBest) {
  const Environment environment("");
  EXPECT_EQ(gslam::activeSimd(), gslam::availableSimd().back());
}

TEST(Simd, EnvironmentForcesEachVariant) {
  for (Simd variant : gslam::availableSimd()) {
    const Environment environment(gslam::simdName(variant));
    EXPECT_EQ(gslam::activeSimd(), variant);
  }
}

TEST(Simd, UnknownNameInTheEnvironmentIsAnErrorThatListsTheKnown) {
  const Environment environment("AVX9000");
  try {
    gslam::activeSimd();
    FAIL() << "AVX9000 must be refused";
  } catch (const gslam::ArgumentError& error) {
    EXPECT_EQ(error.argument(), "GSLAM_SIMD");
    EXPECT_THAT(error.what(), HasSubstr("is \"AVX9000\", but this machine runs: scalar"));
  }
}

TEST(Simd, VariantOfAnotherMachineIsRefused) {
  const Simd foreign = GSLAM_ARM64 ? Simd::avx2 : Simd::neon;
  const Simd before = gslam::activeSimd();
  EXPECT_THROW(gslam::forceSimd(foreign), gslam::ArgumentError);
  EXPECT_THROW(gslam::forceSimd(static_cast<Simd>(9)), gslam::ArgumentError);
  EXPECT_EQ(gslam::activeSimd(), before);
}

TEST(Simd, ScopeRestores) {
  const Simd before = gslam::activeSimd();
  {
    const gslam::ScopedSimd scope(Simd::scalar);
    EXPECT_EQ(gslam::activeSimd(), Simd::scalar);
  }
  EXPECT_EQ(gslam::activeSimd(), before);
}

int one() {
  return 1;
}
int two() {
  return 2;
}

TEST(SimdKernel, FallsBackToThePlainerVariant) {
  const SimdKernel<int (*)()> sparse(one, nullptr, two, nullptr, nullptr);
  for (Simd variant : gslam::availableSimd()) {
    const gslam::ScopedSimd scope(variant);
    const bool wide = variant == Simd::avx2 || variant == Simd::avx512;
    EXPECT_EQ(sparse.active()(), wide ? 2 : 1) << gslam::simdName(variant);
  }
  EXPECT_EQ(sparse.exact(Simd::sse4), nullptr);
}

TEST(SimdKernel, ListsWhatIsWrittenAndRuns) {
  const SimdKernel<int (*)()> plain(one, nullptr, nullptr, nullptr, nullptr);
  EXPECT_THAT(plain.variants(), ElementsAre(Simd::scalar));
  EXPECT_EQ(dot_kernel::dot().variants(), gslam::availableSimd());
}

// Every variant, every length around the vector widths, aligned or not, against double.
TEST(SimdKernel, EveryVariantOfADotProductAgrees) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<float> a(200), b(200);
  for (float& value : a) value = uniform(random);
  for (float& value : b) value = uniform(random);
  for (Simd variant : dot_kernel::dot().variants()) {
    for (std::size_t offset = 0; offset < 3; ++offset) {
      for (std::size_t n = 0; n + offset <= a.size(); ++n) {
        double expected = 0, magnitude = 0;
        for (std::size_t i = offset; i < offset + n; ++i) {
          expected += static_cast<double>(a[i]) * static_cast<double>(b[i]);
          magnitude += std::abs(static_cast<double>(a[i]) * static_cast<double>(b[i]));
        }
        const double got = static_cast<double>(
            dot_kernel::dot().exact(variant)(a.data() + offset, b.data() + offset, n));
        const double bound = static_cast<double>(n) * 6e-8 * magnitude;
        ASSERT_NEAR(got, expected, bound) << gslam::simdName(variant) << " n = " << n;
      }
    }
  }
}

}  // namespace
