// The kernels of panel_kernels.h for one target region; included once for each, so without an
// include guard, with GSLAM_PANEL_VARIANT the name of a namespace, GSLAM_PANEL_WIDTH the doubles of
// a register and GSLAM_PANEL_COLUMNS the columns of the largest tile.
namespace gslam {
inline namespace v1 {
namespace detail {
namespace GSLAM_PANEL_VARIANT {

typedef double Register __attribute__((vector_size(8 * GSLAM_PANEL_WIDTH)));

enum : std::size_t { kWidth = GSLAM_PANEL_WIDTH, kColumns = GSLAM_PANEL_COLUMNS };

// Handed on by reference, since registers that a caller may not have cannot be returned.
inline void load(const double* from, Register& value) {
  std::memcpy(&value, from, sizeof(value));
}
inline void store(const Register& value, double* to) {
  std::memcpy(to, &value, sizeof(value));
}

// A tile of R registers by C columns of `c (-)= a b^T`.
template <std::size_t R, std::size_t C>
inline void tile(const PanelProduct& p, std::size_t row, std::size_t column) {
  Register sums[C][R] = {};
  const double* a = p.a + row;
  const double* b = p.b + column;
  for (std::size_t k = 0; k < p.depth; ++k, a += p.stride, b += p.stride) {
    Register left[R];
    GSLAM_PANEL_UNROLL
    for (std::size_t r = 0; r < R; ++r) load(a + r * kWidth, left[r]);
    GSLAM_PANEL_UNROLL
    for (std::size_t c = 0; c < C; ++c) {
      const Register right = Register{} + b[c];
      GSLAM_PANEL_UNROLL
      for (std::size_t r = 0; r < R; ++r) sums[c][r] += left[r] * right;
    }
  }
  GSLAM_PANEL_UNROLL
  for (std::size_t c = 0; c < C; ++c) {
    double* const to = p.c + row + (column + c) * p.c_stride;
    GSLAM_PANEL_UNROLL
    for (std::size_t r = 0; r < R; ++r) {
      if (p.is_subtracted) {
        Register before;
        load(to + r * kWidth, before);
        sums[c][r] = before - sums[c][r];
      }
      store(sums[c][r], to + r * kWidth);
    }
  }
}

// Rows from the tile's diagonal on: what is above is not wanted.
template <std::size_t C>
inline void tileColumns(const PanelProduct& p, std::size_t column) {
  std::size_t row = column / kPanelPadding * kPanelPadding;
  for (; row + 3 * kWidth <= p.rows; row += 3 * kWidth) tile<3, C>(p, row, column);
  for (; row < p.rows; row += kWidth) tile<1, C>(p, row, column);
}

inline void multiply(const PanelProduct& p) {
  std::size_t column = 0;
  for (; column + kColumns <= p.columns; column += kColumns) tileColumns<kColumns>(p, column);
  if (kColumns > 4 && column + 4 <= p.columns) {
    tileColumns<4>(p, column);
    column += 4;
  }
  for (; column + 2 <= p.columns; column += 2) tileColumns<2>(p, column);
  if (column < p.columns) tileColumns<1>(p, column);
}

// x l^T = panel, for one register of rows at a time.
template <std::size_t N>
inline void divideColumns(const double* l, double* panel, std::size_t stride, std::size_t rows) {
  for (std::size_t row = 0; row < rows; row += kWidth) {
    Register x[N];
    GSLAM_PANEL_UNROLL
    for (std::size_t j = 0; j < N; ++j) load(panel + row + j * stride, x[j]);
    GSLAM_PANEL_UNROLL
    for (std::size_t j = 0; j < N; ++j) {
      x[j] *= l[j * kPanelPadding + j];
      store(x[j], panel + row + j * stride);
      // Those to the right are independent of each other.
      GSLAM_PANEL_UNROLL
      for (std::size_t k = j + 1; k < N; ++k) x[k] -= x[j] * l[k * kPanelPadding + j];
    }
  }
}

// `l`: a lower triangle, row by row, with the inverses of its diagonal.
inline void divide(const double* l, std::size_t n, double* panel, std::size_t stride,
                   std::size_t rows) {
  switch (n) {
    case 1:
      return divideColumns<1>(l, panel, stride, rows);
    case 2:
      return divideColumns<2>(l, panel, stride, rows);
    case 3:
      return divideColumns<3>(l, panel, stride, rows);
    case 4:
      return divideColumns<4>(l, panel, stride, rows);
    case 5:
      return divideColumns<5>(l, panel, stride, rows);
    case 6:
      return divideColumns<6>(l, panel, stride, rows);
    case 7:
      return divideColumns<7>(l, panel, stride, rows);
    default:
      return divideColumns<8>(l, panel, stride, rows);
  }
}

// y += a x, down the columns.
inline void addProduct(const double* a, std::size_t stride, std::size_t rows, std::size_t columns,
                       const double* x, double* y) {
  for (std::size_t row = 0; row < rows; row += kWidth) {
    Register sum;
    load(y + row, sum);
    for (std::size_t c = 0; c < columns; ++c) {
      Register left;
      load(a + row + c * stride, left);
      sum += left * x[c];
    }
    store(sum, y + row);
  }
}

inline double dot(const double* a, const double* x, std::size_t rows) {
  Register sum = {};
  std::size_t row = 0;
  for (; row + kWidth <= rows; row += kWidth) {
    Register left, right;
    load(a + row, left);
    load(x + row, right);
    sum += left * right;
  }
  double total = 0;
  for (std::size_t i = 0; i < kWidth; ++i) total += sum[i];
  for (; row < rows; ++row) total += a[row] * x[row];
  return total;
}

inline constexpr PanelKernels kKernels = {multiply, divide, addProduct, dot};

}  // namespace GSLAM_PANEL_VARIANT
}  // namespace detail
}  // namespace v1
}  // namespace gslam
