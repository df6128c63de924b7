#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

#include "sparse/block_cholesky.h"

namespace gslam {
namespace {

using detail::BlockCholesky;
using detail::BlockIndex;
using detail::BlockPair;

// A positive definite matrix of blocks with a random pattern, sparse and dense.
struct BlockMatrix {
  BlockMatrix(std::size_t blocks, std::size_t size, double density, unsigned seed)
      : n(blocks), d(size), random(seed), diagonal(n * d * d), dense(index(n, 0), index(n, 0)) {
    std::uniform_real_distribution<double> uniform(0, 1);
    dense.setZero();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool is_chain = i == j + 1 && i % 17 != 0;
        if (is_chain || uniform(random) < density) addPair(i, j);
      }
    }
    for (Eigen::Index i = 0; i < dense.rows(); ++i) {
      dense(i, i) = dense.row(i).cwiseAbs().sum() + 0.1;
    }
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t r = 0; r < d; ++r) {
        for (std::size_t c = 0; c < d; ++c) {
          diagonal[i * d * d + r * d + c] = dense(index(i, r), index(i, c));
        }
      }
    }
  }

  Eigen::Index index(std::size_t block, std::size_t k) const {
    return static_cast<Eigen::Index>(block * d + k);
  }

  void addPair(std::size_t i, std::size_t j) {
    std::normal_distribution<double> normal;
    if (random() % 2 == 0) std::swap(i, j);
    pairs.emplace_back(static_cast<BlockIndex>(i), static_cast<BlockIndex>(j));
    for (std::size_t r = 0; r < d; ++r) {
      for (std::size_t c = 0; c < d; ++c) {
        const double value = normal(random);
        beside.push_back(value);
        dense(index(i, r), index(j, c)) = dense(index(j, c), index(i, r)) = value;
      }
    }
  }

  std::size_t n, d;
  std::mt19937 random;
  std::vector<BlockPair> pairs;
  std::vector<double> diagonal, beside;
  Eigen::MatrixXd dense;
};

void expectSameAsDense(const BlockMatrix& m) {
  BlockCholesky cholesky(m.n, m.d, m.pairs);
  ASSERT_TRUE(cholesky.factorize(m.diagonal.data(), m.beside.data(), 2));
  const Eigen::VectorXd b = Eigen::VectorXd::Random(m.dense.rows());
  Eigen::VectorXd x = b;
  cholesky.solve(x.data());
  EXPECT_LT((m.dense * x - b).norm(), 1e-12 * b.norm());
  std::vector<double> block(m.d * m.d);
  for (std::size_t i = 0; i < m.n; i += 1 + m.n / 5) {
    cholesky.inverseBlock(i, block.data());
    for (std::size_t c = 0; c < m.d; ++c) {
      Eigen::VectorXd column = Eigen::VectorXd::Unit(m.dense.rows(), m.index(i, c));
      const Eigen::VectorXd unit = column;
      cholesky.solve(column.data());
      EXPECT_LT((m.dense * column - unit).norm(), 1e-12);
      for (std::size_t r = 0; r < m.d; ++r) {
        EXPECT_NEAR(block[r * m.d + c], column[m.index(i, r)], 1e-11);
      }
    }
  }
}

class PoseGraphCholesky : public ::testing::TestWithParam<Simd> {};

TEST_P(PoseGraphCholesky, solves_as_a_dense_decomposition_does) {
  const ScopedSimd simd(GetParam());
  for (const std::size_t size : {1u, 2u, 3u, 6u, 7u}) {
    for (const std::size_t blocks : {1u, 2u, 5u, 30u}) {
      for (const double density : {0.0, 0.03, 0.5}) {
        expectSameAsDense(BlockMatrix(blocks, size, density, static_cast<unsigned>(blocks + size)));
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PoseGraphCholesky, ::testing::ValuesIn(availableSimd()));

TEST(pose_graph_cholesky, an_indefinite_matrix_is_refused) {
  BlockMatrix m(30, 3, 0.1, 5);
  BlockCholesky cholesky(m.n, m.d, m.pairs);
  m.diagonal[17 * 9] = -1;
  EXPECT_FALSE(cholesky.factorize(m.diagonal.data(), m.beside.data(), 1));
  m.diagonal[17 * 9] = std::nan("");
  EXPECT_FALSE(cholesky.factorize(m.diagonal.data(), m.beside.data(), 2));
}

TEST(pose_graph_cholesky, threads_do_not_change_a_bit) {
  const BlockMatrix m(100, 6, 0.03, 3);
  std::vector<double> first;
  for (const unsigned threads : {1u, 2u, 3u, 8u}) {
    BlockCholesky cholesky(m.n, m.d, m.pairs);
    ASSERT_TRUE(cholesky.factorize(m.diagonal.data(), m.beside.data(), threads));
    std::vector<double> x(m.n * m.d, 1.0);
    cholesky.solve(x.data());
    if (first.empty()) first = x;
    EXPECT_EQ(x, first);
  }
}

}  // namespace
}  // namespace gslam
