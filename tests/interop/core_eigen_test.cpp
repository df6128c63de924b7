// Images as matrices of Eigen: the same elements in the same places.
#include <gslam/core/eigen.h>
#include <gslam/geometry/eigen.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace {

using gslam::ArgumentError;
using gslam::Image;
using gslam::PixelType;
using gslam::toImage;
using gslam::viewAsImage;
using gslam::viewChannelAsEigen;
using gslam::viewImageAsEigen;

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <class T>
Image countedImage(PixelType type, int channels) {
  Image image(5, 4, type, channels);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      for (int c = 0; c < channels; ++c) image.at<T>(x, y, c) = T(100 * c + 10 * y + x);
    }
  }
  return image;
}

TEST(CoreEigen, AnImageIsAMatrix) {
  Image image = countedImage<float>(PixelType::f32, 1);
  auto matrix = viewImageAsEigen<float>(image);
  ASSERT_EQ(matrix.rows(), 4);
  ASSERT_EQ(matrix.cols(), 5);
  EXPECT_EQ(matrix(2, 3), 23);
  EXPECT_EQ(matrix.data(), image.row<float>(0));
  matrix *= 2;
  EXPECT_EQ(image.at<float>(3, 2), 46);
  const Image same = image;
  EXPECT_EQ(viewImageAsEigen<float>(same).sum(), matrix.sum());
  EXPECT_EQ(viewImageAsEigen<float>(same).data(), matrix.data());
}

TEST(CoreEigen, ViewsHaveStrides) {
  const Image image = countedImage<std::uint16_t>(PixelType::u16, 1);
  Image part = image.view(1, 2, 3, 2);
  auto matrix = viewImageAsEigen<std::uint16_t>(part);
  ASSERT_EQ(matrix.rows(), 2);
  EXPECT_EQ(matrix(0, 0), 21);
  EXPECT_EQ(matrix(1, 2), 33);
  matrix.setZero();
  EXPECT_EQ(image.at<std::uint16_t>(3, 3), 0);
  EXPECT_EQ(image.at<std::uint16_t>(4, 3), 34);
  EXPECT_EQ(image.at<std::uint16_t>(0, 3), 30);
}

TEST(CoreEigen, ChannelsAreMatrices) {
  Image image = countedImage<std::int32_t>(PixelType::i32, 3);
  for (int c = 0; c < 3; ++c) {
    const auto matrix = viewChannelAsEigen<std::int32_t>(image, c);
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 5; ++x) ASSERT_EQ(matrix(y, x), 100 * c + 10 * y + x);
    }
  }
  viewChannelAsEigen<std::int32_t>(image, 1).setZero();
  const Image same = image.view(1, 1, 3, 3);
  EXPECT_EQ(viewChannelAsEigen<std::int32_t>(same, 1).cwiseAbs().sum(), 0);
  EXPECT_EQ(viewChannelAsEigen<std::int32_t>(same, 2)(1, 1), 222);
}

TEST(CoreEigen, TypesAndChannelsAreChecked) {
  Image image = countedImage<float>(PixelType::f32, 3);
  const Image same = image;
  EXPECT_THROW(viewImageAsEigen<float>(image), ArgumentError);
  EXPECT_THROW(viewImageAsEigen<float>(same), ArgumentError);
  EXPECT_THROW(viewChannelAsEigen<double>(image, 0), ArgumentError);
  EXPECT_THROW(viewChannelAsEigen<double>(same, 0), ArgumentError);
  EXPECT_THROW(viewChannelAsEigen<float>(image, 3), ArgumentError);
  EXPECT_THROW(viewChannelAsEigen<float>(same, -1), ArgumentError);
  Image none;
  EXPECT_EQ(viewImageAsEigen<std::uint8_t>(none).size(), 0);
  EXPECT_EQ(viewChannelAsEigen<std::uint8_t>(none, 0).size(), 0);
}

TEST(CoreEigen, AMatrixIsMovedIntoAnImage) {
  RowMajor matrix = RowMajor::Random(3, 7);
  const RowMajor copy = matrix;
  const float* const data = matrix.data();
  Image image = toImage(std::move(matrix));
  EXPECT_EQ(static_cast<const void*>(image.bytes()), data);
  EXPECT_EQ(image.width(), 7);
  EXPECT_EQ(image.height(), 3);
  EXPECT_EQ(image.owner().use_count(), 1);
  EXPECT_EQ(viewImageAsEigen<float>(image), copy);
}

TEST(CoreEigen, WhatCannotBeMovedIsCopied) {
  Eigen::MatrixXd by_columns = Eigen::MatrixXd::Random(3, 4);
  const Eigen::MatrixXd copy = by_columns;
  const Image moved = toImage(std::move(by_columns));
  EXPECT_EQ(viewImageAsEigen<double>(moved), copy);
  const Image fixed = toImage(Eigen::Matrix3f::Identity());
  EXPECT_EQ(fixed.at<float>(1, 1), 1);
  EXPECT_EQ(fixed.at<float>(1, 2), 0);
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> small;
  small.setConstant(3);
  EXPECT_EQ(toImage(std::move(small)).at<double>(3, 3), 3);
  const Eigen::ArrayXXi array = Eigen::ArrayXXi::Constant(2, 2, 5);
  EXPECT_EQ(toImage(array).at<std::int32_t>(1, 0), 5);
  EXPECT_EQ(toImage(copy.block(1, 1, 2, 2) * 2).at<double>(1, 0), 2 * copy(1, 2));
  EXPECT_EQ(toImage(copy.transpose()).at<double>(2, 3), copy(2, 3));
  EXPECT_TRUE(toImage(Eigen::MatrixXf()).empty());
  EXPECT_TRUE(toImage(RowMajor()).empty());
  EXPECT_TRUE(toImage(RowMajor(0, 5)).empty());
}

TEST(CoreEigen, AMatrixIsSeenAsAnImage) {
  RowMajor matrix = RowMajor::Random(3, 7);
  Image image = viewAsImage(matrix);
  EXPECT_EQ(static_cast<const void*>(image.bytes()), matrix.data());
  EXPECT_EQ(image.owner(), nullptr);
  image.at<float>(6, 2) = 4711;
  EXPECT_EQ(matrix(2, 6), 4711);
  Eigen::Array<std::uint8_t, 2, 3, Eigen::RowMajor> array;
  array.setConstant(9);
  EXPECT_EQ(viewAsImage(array).at<std::uint8_t>(2, 1), 9);
  Eigen::Matrix<double, 1, Eigen::Dynamic> row(5);
  row.setConstant(2);
  EXPECT_EQ(viewAsImage(row).width(), 5);
  EXPECT_EQ(viewAsImage(row).at<double>(4, 0), 2);
}

}  // namespace
