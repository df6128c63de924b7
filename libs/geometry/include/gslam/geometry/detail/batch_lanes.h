// Arithmetic on registers: vectors, quaternions and polynomials of some elements at once. Included
// once for each SIMD variant, see batch_variant.h.
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

  static Quaternion of(const Register* from) noexcept { return {Lanes3<L>::of(from), {from[3]}}; }
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
/// `scale` is a power of 2 for the coefficient of row I; it shrinks by `ratio` to each row before.
/// A recursion, because compilers keep loops as loops at -O2.
template <std::size_t I>
struct Horner {
  template <class T, std::size_t N>
  static Lanes<T> sum(const T (&table)[N][2], std::size_t column, Lanes<T> x, T scale,
                      T ratio) noexcept {
    const Lanes<T> before = Horner<I - 1>::sum(table, column, x, scale * ratio, ratio);
    return multiplyAdd(before, x, Lanes<T>::all(table[I][column] * scale));
  }
  /// The first column has the even powers, the second the odd.
  template <class T, std::size_t N>
  static Lanes<T> evenAndOdd(const T (&table)[N][2], Lanes<T> x) noexcept {
    const Lanes<T> before = Horner<I - 1>::evenAndOdd(table, x);
    const Lanes<T> odd = multiplyAdd(before, x, Lanes<T>::all(table[I][1]));
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

/// One column of a table at `ratio` x, times `scale`. Both are powers of 2 and cost nothing.
template <class T, std::size_t N>
Lanes<T> polynomial(const T (&table)[N][2], std::size_t column, Lanes<T> x, T scale = T(1),
                    T ratio = T(1)) noexcept {
  return Horner<N - 1>::sum(table, column, x, scale, ratio);
}
template <class T, std::size_t N>
Lanes<T> evenAndOdd(const T (&table)[N][2], Lanes<T> x) noexcept {
  return Horner<N - 1>::evenAndOdd(table, x);
}

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
