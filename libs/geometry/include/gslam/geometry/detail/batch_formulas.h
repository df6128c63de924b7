// The formulas of a batch, and the loop over its elements. No include guard: batch_kernels.h
// includes this file once for each SIMD variant, inside the variant's target region, with
// GSLAM_DETAIL_VARIANT naming the namespace that has its registers. So each formula stands once.
//
// They are those of SO3 and SE3, with the same polynomials; where those use pairs of numbers and
// sums of even and odd powers to keep one processor busy with one element, here are plain Horner
// schemes, because several registers of elements are under way at any time.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace GSLAM_DETAIL_VARIANT {

/// A register of numbers, one of each element.
template <class T>
struct Lanes {
  using R = Registers<T>;
  typename R::Register r;

  static Lanes all(T value) noexcept { return {R::all(value)}; }

  Lanes operator+(Lanes b) const noexcept { return {r + b.r}; }
  Lanes operator-(Lanes b) const noexcept { return {r - b.r}; }
  Lanes operator*(Lanes b) const noexcept { return {r * b.r}; }
  Lanes operator/(Lanes b) const noexcept { return {r / b.r}; }
  Lanes operator-() const noexcept { return {R::timesSign(r, R::all(T(-1)))}; }
  Lanes magnitude() const noexcept { return {R::magnitude(r)}; }
  Lanes timesSign(Lanes other) const noexcept { return {R::timesSign(r, other.r)}; }
  bool areAtMost(T bound) const noexcept { return R::areAtMost(r, bound); }
};

// No friends inside the classes: g++ does not compile those for the target of the region.

/// a x + b
template <class T>
Lanes<T> multiplyAdd(Lanes<T> a, Lanes<T> x, Lanes<T> b) noexcept {
  return {Registers<T>::multiplyAdd(a.r, x.r, b.r)};
}
/// b - a x
template <class T>
Lanes<T> subtractProduct(Lanes<T> b, Lanes<T> a, Lanes<T> x) noexcept {
  return {Registers<T>::subtractProduct(b.r, a.r, x.r)};
}

template <class L>
struct Lanes3 {
  using Register = typename L::R::Register;
  L x, y, z;

  static Lanes3 of(const Register* from) noexcept { return {{from[0]}, {from[1]}, {from[2]}}; }
  void put(Register* to) const noexcept {
    to[0] = x.r;
    to[1] = y.r;
    to[2] = z.r;
  }

  Lanes3 operator-() const noexcept { return {-x, -y, -z}; }
  Lanes3 operator+(Lanes3 b) const noexcept { return {x + b.x, y + b.y, z + b.z}; }
  L squaredNorm() const noexcept { return multiplyAdd(z, z, multiplyAdd(y, y, x * x)); }
  Lanes3 cross(Lanes3 b) const noexcept {
    return {subtractProduct(y * b.z, z, b.y), subtractProduct(z * b.x, x, b.z),
            subtractProduct(x * b.y, y, b.x)};
  }
  /// c + this x b
  Lanes3 crossAdd(Lanes3 b, Lanes3 c) const noexcept {
    return {subtractProduct(multiplyAdd(y, b.z, c.x), z, b.y),
            subtractProduct(multiplyAdd(z, b.x, c.y), x, b.z),
            subtractProduct(multiplyAdd(x, b.y, c.z), y, b.x)};
  }
};

template <class L>
Lanes3<L> operator*(L f, Lanes3<L> a) noexcept {
  return {f * a.x, f * a.y, f * a.z};
}
/// f a + b
template <class L>
Lanes3<L> multiplyAdd(L f, Lanes3<L> a, Lanes3<L> b) noexcept {
  return {multiplyAdd(f, a.x, b.x), multiplyAdd(f, a.y, b.y), multiplyAdd(f, a.z, b.z)};
}

template <class L>
struct Quaternion {
  using Register = typename L::R::Register;
  Lanes3<L> u;
  L w;

  static Quaternion of(const Register* from) noexcept {
    return {Lanes3<L>::of(from), {from[3]}};
  }
  void put(Register* to) const noexcept {
    u.put(to);
    to[3] = w.r;
  }
  Quaternion conjugate() const noexcept { return {-u, w}; }
  Quaternion operator*(const Quaternion& b) const noexcept {
    const L uu = multiplyAdd(u.z, b.u.z, multiplyAdd(u.y, b.u.y, u.x * b.u.x));
    return {u.crossAdd(b.u, multiplyAdd(w, b.u, b.w * u)), w * b.w - uu};
  }
  /// The rotated vector, plus t.
  Lanes3<L> rotateAdd(Lanes3<L> v, Lanes3<L> t) const noexcept {
    const Lanes3<L> half = u.cross(v);
    const Lanes3<L> twice = half + half;
    return u.crossAdd(twice, multiplyAdd(w, twice, v)) + t;
  }
  Lanes3<L> rotate(Lanes3<L> v) const noexcept {
    const Lanes3<L> half = u.cross(v);
    const Lanes3<L> twice = half + half;
    return u.crossAdd(twice, multiplyAdd(w, twice, v));
  }
};

/// Horner's scheme over the rows 0 to I of a table, highest power first, for one of its columns.
/// `scale` is a power of 2 for the coefficient of row I and shrinks by `ratio` to those before.
template <std::size_t I>
struct Horner {
  template <class T, std::size_t N>
  static Lanes<T> sum(const T (&table)[N][2], std::size_t column, Lanes<T> x, T scale,
                      T ratio) noexcept {
    return multiplyAdd(Horner<I - 1>::sum(table, column, x, scale * ratio, ratio), x,
                       Lanes<T>::all(table[I][column] * scale));
  }
  /// The first column has the even powers, the second the odd.
  template <class T, std::size_t N>
  static Lanes<T> evenAndOdd(const T (&table)[N][2], Lanes<T> x) noexcept {
    const Lanes<T> odd = multiplyAdd(Horner<I - 1>::evenAndOdd(table, x), x,
                                     Lanes<T>::all(table[I][1]));
    return multiplyAdd(odd, x, Lanes<T>::all(table[I][0]));
  }
};
template <>
struct Horner<0> {
  template <class T, std::size_t N>
  static Lanes<T> sum(const T (&table)[N][2], std::size_t column, Lanes<T>, T scale, T) noexcept {
    return Lanes<T>::all(table[0][column] * scale);
  }
  template <class T, std::size_t N>
  static Lanes<T> evenAndOdd(const T (&table)[N][2], Lanes<T> x) noexcept {
    return multiplyAdd(Lanes<T>::all(table[0][1]), x, Lanes<T>::all(table[0][0]));
  }
};

template <class T, std::size_t N>
Lanes<T> polynomial(const T (&table)[N][2], std::size_t column, Lanes<T> x, T scale = T(1),
                    T ratio = T(1)) noexcept {
  return Horner<N - 1>::sum(table, column, x, scale, ratio);
}

/// exp of SO3, and what exp of SE3 needs beside.
template <class T>
struct ExpLanes {
  Quaternion<Lanes<T>> q;
  Lanes<T> half_sine;  // sin(t/2) / t

  ExpLanes(Lanes3<Lanes<T>> v, Lanes<T> x) noexcept {
    half_sine = polynomial(stumpff10Table(T()), 0, x, T(0.5), T(0.25));
    q = {half_sine * v, polynomial(stumpff10Table(T()), 1, x, T(1), T(0.25))};
  }
};

/// log of SO3, and what log of SE3 needs beside; see RotationLog.
template <class T>
struct LogLanes {
  Lanes<T> half_factor;  // the rotation vector is twice this times q.u
  Lanes<T> d;

  explicit LogLanes(const Quaternion<Lanes<T>>& q) noexcept {
    const Lanes<T> one = Lanes<T>::all(T(1));
    const Lanes<T> inverse = one / (one + q.w.magnitude());
    const Lanes<T> square = inverse * inverse;
    const Lanes<T> x = q.u.squaredNorm() * square;
    const Lanes<T> r = polynomial(arctangentTable(T()), 0, x) / polynomial(arctangentTable(T()), 1, x);
    const Lanes<T> a = multiplyAdd(x, r, one);
    const Lanes<T> quarter = (a * inverse).timesSign(q.w);
    half_factor = quarter + quarter;
    d = (a - r) * square;
  }
};

/// The formula of an operation, on registers: x[k] holds number k of some elements, y[k] that of the
/// results. Where it is not for all elements, squaredAngle() says for which, those up to nearSquare().
template <class Op>
struct Formula;

template <class Op>
struct FormulaBase {
  using L = Lanes<typename Op::Scalar>;
  using Register = typename L::R::Register;

  explicit FormulaBase(const Op&) noexcept {}
  static L squaredAngle(const Register*) noexcept { return L::all(0); }
};

template <class T>
struct Formula<Exp<SO3<T>>> : FormulaBase<Exp<SO3<T>>> {
  using Base = FormulaBase<Exp<SO3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  static L squaredAngle(const Register* x) noexcept { return Lanes3<L>::of(x).squaredNorm(); }
  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> v = Lanes3<L>::of(x);
    ExpLanes<T>(v, v.squaredNorm()).q.put(y);
  }
};

template <class T>
struct Formula<Exp<SE3<T>>> : FormulaBase<Exp<SE3<T>>> {
  using Base = FormulaBase<Exp<SE3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  static L squaredAngle(const Register* x) noexcept { return Lanes3<L>::of(x + 3).squaredNorm(); }
  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> r = Lanes3<L>::of(x), v = Lanes3<L>::of(x + 3);
    const L square = v.squaredNorm();
    const ExpLanes<T> e(v, square);
    const L c2 = (e.half_sine + e.half_sine) * e.half_sine;
    const auto& table = stumpff3Table(T());
    const L c3 = Horner<sizeof(table) / sizeof(table[0]) - 1>::evenAndOdd(table, square);
    v.crossAdd(multiplyAdd(c3, v.cross(r), c2 * r), r).put(y);
    e.q.put(y + 3);
  }
};

template <class T>
struct Formula<Log<SO3<T>>> : FormulaBase<Log<SO3<T>>> {
  using Base = FormulaBase<Log<SO3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> q = Quaternion<L>::of(x);
    const LogLanes<T> log(q);
    ((log.half_factor + log.half_factor) * q.u).put(y);
  }
};

template <class T>
struct Formula<Log<SE3<T>>> : FormulaBase<Log<SE3<T>>> {
  using Base = FormulaBase<Log<SE3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> t = Lanes3<L>::of(x);
    const Quaternion<L> q = Quaternion<L>::of(x + 3);
    const LogLanes<T> log(q);
    q.u.crossAdd(multiplyAdd(log.d, q.u.cross(t), -log.half_factor * t), t).put(y);
    ((log.half_factor + log.half_factor) * q.u).put(y + 3);
  }
};

template <class T>
struct Formula<Inverse<SO3<T>>> : FormulaBase<Inverse<SO3<T>>> {
  using Base = FormulaBase<Inverse<SO3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept { Quaternion<L>::of(x).conjugate().put(y); }
};

template <class T>
struct Formula<Inverse<SE3<T>>> : FormulaBase<Inverse<SE3<T>>> {
  using Base = FormulaBase<Inverse<SE3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> back = Quaternion<L>::of(x + 3).conjugate();
    back.rotate(-Lanes3<L>::of(x)).put(y);
    back.put(y + 3);
  }
};

template <class T>
struct Formula<Inverse<SIM3<T>>> : FormulaBase<Inverse<SIM3<T>>> {
  using Base = FormulaBase<Inverse<SIM3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> back = Quaternion<L>::of(x + 3).conjugate();
    const L scale = L::all(T(1)) / L{x[7]};
    back.rotate(-scale * Lanes3<L>::of(x)).put(y);
    back.put(y + 3);
    y[7] = scale.r;
  }
};

template <class T>
struct Formula<Compose<SO3<T>>> : FormulaBase<Compose<SO3<T>>> {
  using Base = FormulaBase<Compose<SO3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    (Quaternion<L>::of(x) * Quaternion<L>::of(x + 4)).put(y);
  }
};

template <class T>
struct Formula<Compose<SE3<T>>> : FormulaBase<Compose<SE3<T>>> {
  using Base = FormulaBase<Compose<SE3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> a = Quaternion<L>::of(x + 3);
    a.rotateAdd(Lanes3<L>::of(x + 7), Lanes3<L>::of(x)).put(y);
    (a * Quaternion<L>::of(x + 10)).put(y + 3);
  }
};

template <class T>
struct Formula<Compose<SIM3<T>>> : FormulaBase<Compose<SIM3<T>>> {
  using Base = FormulaBase<Compose<SIM3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> a = Quaternion<L>::of(x + 3);
    multiplyAdd(L{x[7]}, a.rotate(Lanes3<L>::of(x + 8)), Lanes3<L>::of(x)).put(y);
    (a * Quaternion<L>::of(x + 11)).put(y + 3);
    y[7] = x[7] * x[15];
  }
};

template <class T>
struct Formula<ActOnOne<SO3<T>>> : FormulaBase<ActOnOne<SO3<T>>> {
  using Base = FormulaBase<ActOnOne<SO3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    Quaternion<L>::of(x).rotate(Lanes3<L>::of(x + 4)).put(y);
  }
};

template <class T>
struct Formula<ActOnOne<SE3<T>>> : FormulaBase<ActOnOne<SE3<T>>> {
  using Base = FormulaBase<ActOnOne<SE3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    Quaternion<L>::of(x + 3).rotateAdd(Lanes3<L>::of(x + 7), Lanes3<L>::of(x)).put(y);
  }
};

template <class T>
struct Formula<ActOnOne<SIM3<T>>> : FormulaBase<ActOnOne<SIM3<T>>> {
  using Base = FormulaBase<ActOnOne<SIM3<T>>>;
  using typename Base::L;
  using typename Base::Register;
  using Base::Base;

  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> turned = Quaternion<L>::of(x + 3).rotate(Lanes3<L>::of(x + 8));
    multiplyAdd(L{x[7]}, turned, Lanes3<L>::of(x)).put(y);
  }
};

/// The matrix stays in registers over the loop.
template <class T>
struct Formula<ActOnAll<T>> : FormulaBase<ActOnAll<T>> {
  using Base = FormulaBase<ActOnAll<T>>;
  using typename Base::L;
  using typename Base::Register;

  explicit Formula(const ActOnAll<T>& op) noexcept
      : Base(op),
        a0(broadcast(op.a.col(0))),
        a1(broadcast(op.a.col(1))),
        a2(broadcast(op.a.col(2))),
        t(broadcast(op.t)) {}
  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> p = Lanes3<L>::of(x);
    multiplyAdd(p.x, a0, multiplyAdd(p.y, a1, multiplyAdd(p.z, a2, t))).put(y);
  }

 private:
  static Lanes3<L> broadcast(const Vec<T, 3>& v) noexcept {
    return {L::all(v[0]), L::all(v[1]), L::all(v[2])};
  }
  Lanes3<L> a0, a1, a2, t;
};

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
/// not hold. Where it stopped is returned. Flattened, because compilers find the formulas too long to
/// inline, and registers would be handed over in memory.
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

/// For which of some elements the formula does not hold; x[k][i] is number k of element i.
template <class Op, std::size_t W>
void findFar(const typename Op::Scalar (&x)[Op::kFrom][W], bool (&is_far)[W]) noexcept {
  using T = typename Op::Scalar;
  typename Registers<T>::Register numbers[Op::kFrom];
  for (std::size_t k = 0; k < Op::kFrom; ++k) numbers[k] = Registers<T>::load(x[k]);
  T square[W];
  Registers<T>::store(square, Formula<Op>::squaredAngle(numbers).r);
  for (std::size_t i = 0; i < W; ++i) is_far[i] = !(square[i] <= nearSquare<T>());
}

/// A few elements, through a copy that fills registers. Each gets the same operations as in any
/// other place of a batch; those for which the formula does not hold get the functions of the classes,
/// and in their place zeros go into the formula.
template <class Op, class In, class Out>
void runApart(const Op& op, const In& in, const Out& out, std::size_t begin, std::size_t count) {
  using T = typename Op::Scalar;
  constexpr std::size_t width = Registers<T>::kWidth;
  T x[Op::kFrom][width];
  T element[Op::kFrom] = {}, result[Op::kTo];
  for (std::size_t i = 0; i < width; ++i) {
    if (i < count) in.get(begin + i, element);  // else the last once more
    for (std::size_t k = 0; k < Op::kFrom; ++k) x[k][i] = element[k];
  }
  bool is_far[width];
  findFar<Op>(x, is_far);
  Room<In, width> from;
  Room<Out, width> to;
  for (std::size_t i = 0; i < width; ++i) {
    for (std::size_t k = 0; k < Op::kFrom; ++k) element[k] = is_far[i] ? T(0) : x[k][i];
    from.put(i, element);
  }
  runNear(op, from.view(), to.view(), 0, width);
  for (std::size_t i = 0; i < width && i < count; ++i) {
    for (std::size_t k = 0; k < Op::kFrom; ++k) element[k] = x[k][i];
    to.view().get(i, result);
    if (is_far[i]) Op::one(element, result, begin + i);
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
