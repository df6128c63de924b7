// Blocks of the reduced matrix; part of fast_kernels.h for one target region, included once for
// each, so without an include guard, with GSLAM_DETAIL_VARIANT the name of a namespace. Compilers
// turn loops over j into vectors of what the region allows.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace pba {
namespace {
namespace GSLAM_DETAIL_VARIANT {

template <class T>
using Eight = typename EightOf<T>::Type;

template <class T>
inline void load(const T* from, Eight<T>& to) {
  std::memcpy(&to, from, sizeof(to));
}
template <class T>
inline void store(T* to, const Eight<T>& from) {
  std::memcpy(to, &from, sizeof(from));
}
template <class T>
inline void spread(T value, Eight<T>& to) {
  to = Eight<T>{} + value;
}

template <class T, std::size_t kFreedom>
void makeRecordsOf(const double* rows, std::size_t stride, std::size_t n, FastRecord<T>* records,
                   FastSide<T>* sides) {
  for (std::size_t k = 0; k < n; ++k) {
    const double* const column = rows + k;
    FastSide<T>& side = sides[k];
    FastRecord<T>& record = records[k];
    T half[6];
    for (std::size_t i = 0; i < 6; ++i) half[i] = static_cast<T>(column[(kHalf + i) * stride]);
    for (std::size_t i = 0; i < 3; ++i) side.root[i] = static_cast<T>(column[(kRoot + i) * stride]);
    for (std::size_t r = 0; r < 2; ++r) {
      side.residual[r] = column[(kResidual + r) * stride];
      side.reduced[r] = column[(kReduced + r) * stride];
      for (std::size_t c = 0; c < 8; ++c) {
        side.by_block[r][c] =
            c < kFreedom ? static_cast<T>(column[(kByBlock + r * kFreedom + c) * stride]) : T(0);
      }
      side.ninth[r] =
          kFreedom == 9 ? static_cast<T>(column[(kByBlock + r * kFreedom + 8) * stride]) : T(0);
    }
    Eight<T> j0, j1;
    load(side.by_block[0], j0);
    load(side.by_block[1], j1);
    for (std::size_t c = 0; c < 3; ++c) {
      store(record.v[c], j0 * half[c] + j1 * half[3 + c]);
      record.ninth[c] = side.ninth[0] * half[c] + side.ninth[1] * half[3 + c];
    }
  }
}

template <class T>
void makeRecords(const double* rows, std::size_t stride, std::size_t freedom, std::size_t n,
                 FastRecord<T>* records, FastSide<T>* sides) {
  freedom == 9 ? makeRecordsOf<T, 9>(rows, stride, n, records, sides)
               : makeRecordsOf<T, 6>(rows, stride, n, records, sides);
}

// block -= V_a V_b^T
template <class T, std::size_t kFreedom>
struct Subtractor {
  explicit Subtractor(const FastRecord<T>& record) : a(record) {}

  GSLAM_ALWAYS_INLINE void subtract(const FastRecord<T>& b, T* __restrict block,
                                    T* __restrict corner) const {
    constexpr std::size_t kRows = kFreedom < 8 ? kFreedom : 8;
    Eight<T> b0, b1, b2;
    load(b.v[0], b0);
    load(b.v[1], b1);
    load(b.v[2], b2);
    Eight<T> sums[kRows];  // all of it is loaded before any of it is stored
    for (std::size_t r = 0; r < kRows; ++r) load(block + 8 * r, sums[r]);
    for (std::size_t r = 0; r < kRows; ++r) {
      sums[r] -= b0 * a.v[0][r];
      sums[r] -= b1 * a.v[1][r];
      sums[r] -= b2 * a.v[2][r];
    }
    for (std::size_t r = 0; r < kRows; ++r) store(block + 8 * r, sums[r]);
    if (kFreedom < 9) return;
    Eight<T> row, column, line;
    load(block + 64, row);
    load(block + 72, column);
    row -= b0 * a.ninth[0];
    row -= b1 * a.ninth[1];
    row -= b2 * a.ninth[2];
    for (std::size_t c = 0; c < 3; ++c) {
      load(a.v[c], line);
      column -= line * b.ninth[c];
    }
    store(block + 64, row);
    store(block + 72, column);
    *corner -= a.ninth[0] * b.ninth[0] + a.ninth[1] * b.ninth[1] + a.ninth[2] * b.ninth[2];
  }

  const FastRecord<T>& a;
};

// block += w0 w0^T + w1 w1^T, where w have ninth elements.
template <class T, std::size_t kFreedom>
GSLAM_ALWAYS_INLINE void addSquares(const Eight<T>& w0, const Eight<T>& w1, T ninth0, T ninth1,
                                    T* __restrict block) {
  constexpr std::size_t kRows = kFreedom < 8 ? kFreedom : 8;
  Eight<T> sum;
  for (std::size_t r = 0; r < kRows; ++r) {
    load(block + 8 * r, sum);
    sum += w0 * w0[r];
    sum += w1 * w1[r];
    store(block + 8 * r, sum);
  }
  if (kFreedom < 9) return;
  load(block + 64, sum);
  sum += w0 * ninth0;
  sum += w1 * ninth1;
  store(block + 64, sum);
  block[80] += ninth0 * ninth0 + ninth1 * ninth1;
}

#ifdef GSLAM_DETAIL_WIDE
// Two rows of a block in a register of 16 floats.
typedef float Sixteen __attribute__((vector_size(64)));

template <int kFirst>
GSLAM_ALWAYS_INLINE void spreadTwo(const Eight<float>& e, Sixteen& to) {
  constexpr int k = kFirst, l = kFirst + 1;
  to = __builtin_shufflevector(e, e, k, k, k, k, k, k, k, k, l, l, l, l, l, l, l, l);
}
GSLAM_ALWAYS_INLINE void join(const Eight<float>& low, const Eight<float>& high, Sixteen& to) {
  to = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
GSLAM_ALWAYS_INLINE void loadWide(const float* from, Sixteen& to) {
  std::memcpy(&to, from, sizeof(to));
}
GSLAM_ALWAYS_INLINE void storeWide(float* to, const Sixteen& from) {
  std::memcpy(to, &from, sizeof(from));
}

template <std::size_t kFreedom>
struct Subtractor<float, kFreedom> {
  static constexpr std::size_t kPairs = kFreedom == 9 ? 4 : kFreedom / 2;

  explicit Subtractor(const FastRecord<float>& record) : a(record) {
    for (std::size_t c = 0; c < 3; ++c) {
      Eight<float> line, ninth;
      load(record.v[c], line);
      spreadTwo<0>(line, spread_rows[0][c]);
      spreadTwo<2>(line, spread_rows[1][c]);
      spreadTwo<4>(line, spread_rows[2][c]);
      if (kFreedom < 9) continue;
      spreadTwo<6>(line, spread_rows[kPairs - 1][c]);
      spread(record.ninth[c], ninth);
      join(ninth, line, last[c]);
    }
  }

  GSLAM_ALWAYS_INLINE void subtract(const FastRecord<float>& b, float* __restrict block,
                                    float* __restrict corner) const {
    Sixteen sums[kPairs], lines[3];
    for (std::size_t c = 0; c < 3; ++c) {
      Eight<float> line;
      load(b.v[c], line);
      join(line, line, lines[c]);
    }
    for (std::size_t r = 0; r < kPairs; ++r) loadWide(block + 16 * r, sums[r]);
    for (std::size_t r = 0; r < kPairs; ++r) {
      for (std::size_t c = 0; c < 3; ++c) sums[r] -= lines[c] * spread_rows[r][c];
    }
    for (std::size_t r = 0; r < kPairs; ++r) storeWide(block + 16 * r, sums[r]);
    if (kFreedom < 9) return;
    Sixteen sum;  // the ninth row and the ninth column
    loadWide(block + 64, sum);
    for (std::size_t c = 0; c < 3; ++c) {
      Eight<float> line, ninth;
      load(b.v[c], line);
      spread(b.ninth[c], ninth);
      join(line, ninth, lines[c]);
      sum -= lines[c] * last[c];
    }
    storeWide(block + 64, sum);
    *corner -= a.ninth[0] * b.ninth[0] + a.ninth[1] * b.ninth[1] + a.ninth[2] * b.ninth[2];
  }

  const FastRecord<float>& a;
  Sixteen spread_rows[kPairs][3];
  Sixteen last[3];
};
#endif

template <class T>
GSLAM_ALWAYS_INLINE void addGradient(const FastSide<T>& side, const double* residual,
                                     double* __restrict gradient) {
  for (std::size_t c = 0; c < 8; ++c) {
    gradient[c] += static_cast<double>(side.by_block[0][c]) * residual[0] +
                   static_cast<double>(side.by_block[1][c]) * residual[1];
  }
  gradient[8] += static_cast<double>(side.ninth[0]) * residual[0] +
                 static_cast<double>(side.ninth[1]) * residual[1];
}

// The ninth column is the ninth row of these blocks.
template <std::size_t kFreedom, class T>
void flush(const T* __restrict part, double* __restrict sum) {
  const std::size_t count = kFreedom == 9 ? 72 : 8 * kFreedom;
  for (std::size_t i = 0; i < count; ++i) sum[i] += static_cast<double>(part[i]);
  if (kFreedom < 9) return;
  for (std::size_t i = 0; i < 8; ++i) sum[72 + i] = sum[64 + i];
  sum[80] += static_cast<double>(part[80]);
}

constexpr std::size_t kAhead = 6;  // observations that are fetched before they are wanted

template <class Object>
GSLAM_ALWAYS_INLINE void prefetch(const Object* object) {
#if GSLAM_HAS_VECTORS
  const char* const bytes = reinterpret_cast<const char*>(object);
  for (std::size_t i = 0; i < sizeof(Object); i += 64) __builtin_prefetch(bytes + i);
#else
  (void)object;
#endif
}

// The diagonal block of a row, its gradients, and what is left of it when its points are gone.
template <class T, std::size_t kFreedom, bool kIsWhole>
struct DiagonalSums {
  alignas(64) T diagonal[kMostBlock] = {};
  alignas(64) T outer[kMostBlock] = {};
  double gradient[9] = {}, reduced[9] = {};

  GSLAM_ALWAYS_INLINE void add(const FastRecord<T>& record, const FastSide<T>& side) {
    Eight<T> j0, j1, v[3];
    load(side.by_block[0], j0);
    load(side.by_block[1], j1);
    addSquares<T, kFreedom>(j0 * side.root[0] + j1 * side.root[1], j1 * side.root[2],
                            side.ninth[0] * side.root[0] + side.ninth[1] * side.root[1],
                            side.ninth[1] * side.root[2], diagonal);
    addGradient(side, side.residual, gradient);
    addGradient(side, side.reduced, reduced);
    for (std::size_t c = 0; c < 3; ++c) load(record.v[c], v[c]);
    const T* const ninth = record.ninth;
    if (kIsWhole) {
      addSquares<T, kFreedom>(v[0], v[1], ninth[0], ninth[1], outer);
      addSquares<T, kFreedom>(v[2], Eight<T>{}, ninth[2], T(0), outer);
      return;
    }
    Eight<T> squares;  // of the diagonal alone
    load(outer, squares);
    for (std::size_t c = 0; c < 3; ++c) squares += v[c] * v[c];
    store(outer, squares);
    outer[80] += ninth[0] * ninth[0] + ninth[1] * ninth[1] + ninth[2] * ninth[2];
  }

  // Two cameras of one body that see a point.
  void subtractOther(const Subtractor<T, kFreedom>& from, const FastRecord<T>& other) {
    alignas(64) T block[kMostBlock] = {};
    from.subtract(other, block, block + 80);
    const std::size_t size = kFreedom == 9 ? kMostBlock : 8 * kFreedom;
    for (std::size_t k = 0; k < size; ++k) diagonal[k] += block[k];
    if (kIsWhole) {
      for (std::size_t k = 0; k < size; ++k) outer[k] -= block[k];
      return;
    }
    for (std::size_t k = 0; k < 8 && k < kFreedom; ++k) outer[k] -= block[9 * k];
    outer[80] -= block[80];
  }

  void flushTo(const FastRow<T>& target) const {
    flush<kFreedom>(diagonal, target.diagonal);
    if (kIsWhole) {
      flush<kFreedom>(outer, target.outer);
    } else {
      for (std::size_t c = 0; c < 8; ++c) target.outer[9 * c] += static_cast<double>(outer[c]);
      target.outer[80] += static_cast<double>(outer[80]);
    }
    for (std::size_t c = 0; c < 9; ++c) {
      target.gradient[c] += gradient[c];
      target.reduced[c] += reduced[c];
    }
  }
};

template <class T, std::size_t kFreedom, bool kIsWhole>
void addRowOf(const FastRecord<T>* records, const FastSide<T>* sides, const std::uint32_t* row,
              std::size_t count, std::uint32_t window, const FastRow<T>& target) {
  DiagonalSums<T, kFreedom, kIsWhole> sums;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t a = row[i] - window;
    if (i + kAhead < count) {
      prefetch(&records[row[i + kAhead] - window]);
      prefetch(&sides[row[i + kAhead] - window]);
    }
    const FastRecord<T>& record = records[a];
    sums.add(record, sides[a]);
    const Subtractor<T, kFreedom> from(record);
    std::uint32_t b = a;
    while (b > 0 && records[b - 1].block == record.block && records[b - 1].end == record.end) --b;
    for (; b < record.end && records[b].block == record.block; ++b) {
      if (b != a) sums.subtractOther(from, records[b]);
    }
    if (target.blocks == nullptr) continue;
    for (; b < record.end; ++b) {
      const std::size_t slot = target.slot_of[records[b].block];
      from.subtract(records[b], target.blocks + slot * blockStride(kFreedom),
                    kFreedom == 9 ? target.corners + slot : nullptr);
    }
  }
  sums.flushTo(target);
}

template <class T>
void addRow(const FastRecord<T>* records, const FastSide<T>* sides, const std::uint32_t* row,
            std::size_t count, std::uint32_t window, std::size_t freedom,
            const FastRow<T>& target) {
  const auto add = freedom == 9
                       ? (target.is_whole ? &addRowOf<T, 9, true> : &addRowOf<T, 9, false>)
                       : (target.is_whole ? &addRowOf<T, 6, true> : &addRowOf<T, 6, false>);
  add(records, sides, row, count, window, target);
}

template <class T>
GSLAM_ALWAYS_INLINE T total(const Eight<T>& e) {
  return ((e[0] + e[1]) + (e[2] + e[3])) + ((e[4] + e[5]) + (e[6] + e[7]));
}

template <class T, std::size_t kFreedom>
void multiplyRowOf(const FastProduct<T>& p, std::size_t row) {
  constexpr std::size_t kRows = kFreedom < 8 ? kFreedom : 8;
  Eight<T> sums[kRows] = {}, last = {}, own = {};
  const T* const x_row = p.x + 16 * row;
  Eight<T> x8;
  load(x_row, x8);
  T corner = 0;
  for (std::size_t k = 0; k < p.count; ++k) {
    const T* const block = p.blocks + k * blockStride(kFreedom);
    const T* const x = p.x + 16 * std::size_t(p.columns[k]);
    T* const y = p.y + 16 * std::size_t(p.columns[k]);
    Eight<T> x_column, y_column, line;
    load(x, x_column);
    load(y, y_column);
    for (std::size_t r = 0; r < kRows; ++r) {
      load(block + 8 * r, line);
      sums[r] += line * x_column;
      y_column += line * x_row[r];
    }
    if (kFreedom == 9) {
      load(block + 64, line);
      last += line * x_column;
      y_column += line * x_row[8];
      Eight<T> y_last;
      load(y + 8, y_last);
      load(block + 72, line);
      own += line * x[8];
      y_last += line * x8;
      store(y + 8, y_last);
      corner += p.corners[k] * x[8];
      y[8] += p.corners[k] * x_row[8];
    }
    store(y, y_column);
  }
  T* const y_row = p.y + 16 * row;
  for (std::size_t r = 0; r < kRows; ++r) y_row[r] += total<T>(sums[r]) + own[r];
  if (kFreedom == 9) y_row[8] += total<T>(last) + corner;
}

template <class T>
void multiplyRow(const FastProduct<T>& product, std::size_t row, std::size_t freedom) {
  freedom == 9 ? multiplyRowOf<T, 9>(product, row) : multiplyRowOf<T, 6>(product, row);
}

constexpr FastKernels kKernels = {gather,       toCamera, plainPixel,   plainSlopes, jacobians,
                                  changes,      scale,    whiten,       products,    eliminate,
                                  factorPoints, pull,     modelDecrease};
template <class T>
constexpr FastBlockKernels<T> kBlockKernels = {makeRecords<T>, addRow<T>, multiplyRow<T>};

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace
}  // namespace pba
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
