#include <gslam/geometry/mat.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <sstream>
#include <type_traits>

namespace {

using gslam::Mat;
using gslam::Vec;

template <class T>
class MatTest : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MatTest, Scalars, );

template <class M>
constexpr bool isPlainMat(std::size_t elements) {
  return std::is_trivial<M>::value && std::is_standard_layout<M>::value &&
         sizeof(M) == elements * sizeof(typename M::value_type) &&
         alignof(M) == alignof(typename M::value_type);
}
static_assert(isPlainMat<gslam::Mat3f>(9) && isPlainMat<gslam::Mat3d>(9), "");
static_assert(isPlainMat<Mat<double, 3, 4>>(12), "");

TYPED_TEST(MatTest, StoredRowByRow) {
  using T = TypeParam;
  Mat<T, 2, 3> m = {11, 12, 13, 21, 22, 23};
  EXPECT_EQ(m(0, 2), T(13));
  EXPECT_EQ(m(1, 0), T(21));
  EXPECT_EQ(m.data()[3], T(21));
  EXPECT_EQ(m.rows(), 2u);
  EXPECT_EQ(m.cols(), 3u);
  EXPECT_EQ(m.transpose(), (Mat<T, 3, 2>{11, 21, 12, 22, 13, 23}));
  m(1, 2) = 0;
  EXPECT_NE(m, (Mat<T, 2, 3>{11, 12, 13, 21, 22, 23}));
}

TYPED_TEST(MatTest, Products) {
  using T = TypeParam;
  const Mat<T, 2, 3> a = {1, 2, 3, 4, 5, 6};
  const Mat<T, 3, 2> b = {1, 0, -1, 2, 3, 1};
  EXPECT_EQ(a * b, (Mat<T, 2, 2>{8, 7, 17, 16}));
  EXPECT_EQ(a * (Vec<T, 3>{1, -1, 2}), (Vec<T, 2>{5, 11}));
  EXPECT_EQ(a * (Mat<T, 3, 3>::identity()), a);
  EXPECT_EQ((Mat<T, 2, 3>::identity()), (Mat<T, 2, 3>{1, 0, 0, 0, 1, 0}));
}

TYPED_TEST(MatTest, Prints) {
  std::ostringstream out;
  out << Mat<TypeParam, 2, 2>{1, 2.5, -3, 0};
  EXPECT_EQ(out.str(), "1 2.5\n-3 0");
}

}  // namespace
