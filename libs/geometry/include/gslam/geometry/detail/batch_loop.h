// The loop of a batch over its elements. Included once for each SIMD variant, see batch_variant.h.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace GSLAM_DETAIL_VARIANT {
// Registers from and to memory, from element i on. Without loops, which compilers keep at -O2, and
// with them the registers in memory.

template <std::size_t K>
struct ColumnsUpTo {
  template <class T, class From, class Register>
  static void load(const From& from, std::size_t i, Register* x) noexcept {
    ColumnsUpTo<K - 1>::template load<T>(from, i, x);
    x[K - 1] = Registers<T>::load(from.column[K - 1] + i);
  }
  template <class T, class To, class Register>
  static void store(const To& to, std::size_t i, const Register* y) noexcept {
    ColumnsUpTo<K - 1>::template store<T>(to, i, y);
    Registers<T>::store(to.column[K - 1] + i, y[K - 1]);
  }
};
template <>
struct ColumnsUpTo<0> {
  template <class T, class From, class Register>
  static void load(const From&, std::size_t, Register*) noexcept {}
  template <class T, class To, class Register>
  static void store(const To&, std::size_t, const Register*) noexcept {}
};

template <class View>
struct Memory;

template <class U, std::size_t K>
struct Memory<Columns<U, K>> {
  template <class Register>
  static void load(const Columns<U, K>& from, std::size_t i, Register* x) noexcept {
    ColumnsUpTo<K>::template load<typename std::remove_const<U>::type>(from, i, x);
  }
  template <class Register>
  static void store(const Columns<U, K>& to, std::size_t i, const Register* y) noexcept {
    ColumnsUpTo<K>::template store<U>(to, i, y);
  }
};

/// Rows of more than 4 numbers are taken as two of 4, which may overlap.
template <class U, std::size_t K>
struct Memory<Rows<U, K>> {
  using R = Registers<typename std::remove_const<U>::type>;
  using Register = typename R::Register;

  static void load(const Rows<U, K>& from, std::size_t i, Register* x) noexcept {
    R::load4(from.first + i * K, K, x);
    if (K > 4) R::load4(from.first + i * K + (K - 4), K, x + (K - 4));
  }
  static void store(const Rows<U, K>& to, std::size_t i, const Register* y) noexcept {
    R::store4(to.first + i * K, K, y);
    if (K > 4) R::store4(to.first + i * K + (K - 4), K, y + (K - 4));
  }
};
template <class U>
struct Memory<Rows<U, 3>> {
  using R = Registers<typename std::remove_const<U>::type>;
  using Register = typename R::Register;

  static void load(const Rows<U, 3>& from, std::size_t i, Register* x) noexcept {
    R::load3(from.first + i * 3, x);
  }
  static void store(const Rows<U, 3>& to, std::size_t i, const Register* y) noexcept {
    R::store3(to.first + i * 3, y);
  }
};

template <class A, class B>
struct Memory<Both<A, B>> {
  template <class Register>
  static void load(const Both<A, B>& from, std::size_t i, Register* x) noexcept {
    Memory<A>::load(from.a, i, x);
    Memory<B>::load(from.b, i, x + A::kNumbers);
  }
};

template <class Op>
bool isFar(const typename FormulaBase<Op>::Register* x) noexcept {
  if (Op::kIsFormulaForAll) return false;
  return !Formula<Op>::squaredAngle(x).areAtMost(nearSquare<typename Op::Scalar>());
}

/// Whole registers from element i on, up to where fewer are left, or one for which the formula does
/// not hold. Where it stopped is returned. Flattened, because compilers find the formulas too long
/// to inline, and registers would be handed over in memory.
template <class Op, class In, class Out>
GSLAM_DETAIL_FLATTEN std::size_t runNear(const Op& op, const In in, const Out out, std::size_t i,
                                         std::size_t n) noexcept {
  constexpr std::size_t width = Registers<typename Op::Scalar>::kWidth;
  const Formula<Op> formula(op);
  for (; i + width <= n; i += width) {
    typename Formula<Op>::Register x[Op::kFrom], y[Op::kTo];
    Memory<In>::load(in, i, x);
    if (isFar<Op>(x)) break;
    formula(x, y);
    Memory<Out>::store(out, i, y);
  }
  return i;
}

/// For which of the W elements of a view the formula does not hold.
template <class Op, std::size_t W, class View>
void findFar(const View& view, bool (&is_far)[W]) noexcept {
  using T = typename Op::Scalar;
  T x[Op::kFrom][W], element[Op::kFrom], square[W];
  for (std::size_t i = 0; i < W; ++i) {
    view.get(i, element);
    for (std::size_t k = 0; k < Op::kFrom; ++k) x[k][i] = element[k];
  }
  typename Registers<T>::Register numbers[Op::kFrom];
  for (std::size_t k = 0; k < Op::kFrom; ++k) numbers[k] = Registers<T>::load(x[k]);
  Registers<T>::store(square, Formula<Op>::squaredAngle(numbers).r);
  for (std::size_t i = 0; i < W; ++i) is_far[i] = !(square[i] <= nearSquare<T>());
}

/// A few elements, through a copy that fills registers. Each gets the same operations as in any
/// other place of a batch; those for which the formula does not hold get the functions of the
/// classes, and in their place zeros go into the formula.
template <class Op, class In, class Out>
void runApart(const Op& op, const In& in, const Out& out, std::size_t begin, std::size_t count) {
  using T = typename Op::Scalar;
  constexpr std::size_t width = Registers<T>::kWidth;
  const T zeros[Op::kFrom] = {};
  T element[Op::kFrom] = {}, result[Op::kTo];
  Room<In, width> from;
  Room<Out, width> to;
  for (std::size_t i = 0; i < width; ++i) {
    if (i < count) in.get(begin + i, element);  // else the last once more
    from.put(i, element);
  }
  bool is_far[width] = {};
  if (!Op::kIsFormulaForAll) {
    findFar<Op>(from.view(), is_far);
    for (std::size_t i = 0; i < width; ++i) {
      if (is_far[i]) from.put(i, zeros);
    }
  }
  runNear(op, from.view(), to.view(), 0, width);
  for (std::size_t i = 0; i < width && i < count; ++i) {
    to.view().get(i, result);
    if (is_far[i]) {
      in.get(begin + i, element);
      Op::one(element, result, begin + i);
    }
    out.set(begin + i, result);
  }
}

template <class Op, class In, class Out>
void run(const Op& op, const In& in, const Out& out, std::size_t n) {
  constexpr std::size_t width = Registers<typename Op::Scalar>::kWidth;
  std::size_t i = 0;
  while ((i = runNear(op, in, out, i, n)) < n) {
    const std::size_t count = n - i < width ? n - i : width;
    runApart(op, in, out, i, count);
    i += count;
  }
}

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
