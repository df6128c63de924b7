// The formulas of a batch. Included once for each SIMD variant, see batch_variant.h.
//
// They are those of SO3 and SE3, with the same polynomials; where those use pairs of numbers and
// sums of even and odd powers to keep one processor busy with one element, here are plain Horner
// schemes, because several registers of elements are under way at any time.
#ifdef GSLAM_DETAIL_VARIANT
namespace gslam {
inline namespace v1 {
namespace detail {
namespace GSLAM_DETAIL_VARIANT {
/// exp of SO3, and what exp of SE3 needs beside.
template <class T>
struct ExpLanes {
  Quaternion<Lanes<T>> q;
  Lanes<T> half_sine;  // sin(t/2) / t

  /// @param x  t^2
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
    const Lanes<T> r =
        polynomial(arctangentTable(T()), 0, x) / polynomial(arctangentTable(T()), 1, x);
    const Lanes<T> a = multiplyAdd(x, r, one);
    const Lanes<T> quarter = (a * inverse).timesSign(q.w);
    half_factor = quarter + quarter;
    d = (a - r) * square;
  }
};

/// The formula of an operation, on registers: x[k] holds number k of some elements, y[k] that of
/// the results, in the order in which they stand in the element: qx qy qz qw tx ty tz of SE3, and
/// the scale of SIM3 as the eighth. Where it is not for all elements, squaredAngle() says for
/// which, those up to nearSquare().
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
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  static L squaredAngle(const Register* x) noexcept { return Lanes3<L>::of(x).squaredNorm(); }
  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> v = Lanes3<L>::of(x);
    ExpLanes<T>(v, v.squaredNorm()).q.put(y);
  }
};

template <class T>
struct Formula<Exp<SE3<T>>> : FormulaBase<Exp<SE3<T>>> {
  using Base = FormulaBase<Exp<SE3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  static L squaredAngle(const Register* x) noexcept { return Lanes3<L>::of(x + 3).squaredNorm(); }
  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> r = Lanes3<L>::of(x), v = Lanes3<L>::of(x + 3);
    const L square = v.squaredNorm();
    const ExpLanes<T> e(v, square);
    const L c2 = (e.half_sine + e.half_sine) * e.half_sine;
    const L c3 = evenAndOdd(stumpff3Table(T()), square);
    e.q.put(y);
    v.crossAdd(multiplyAdd(c3, v.cross(r), c2 * r), r).put(y + 4);
  }
};

template <class T>
struct Formula<Log<SO3<T>>> : FormulaBase<Log<SO3<T>>> {
  using Base = FormulaBase<Log<SO3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> q = Quaternion<L>::of(x);
    const LogLanes<T> log(q);
    ((log.half_factor + log.half_factor) * q.u).put(y);
  }
};

template <class T>
struct Formula<Log<SE3<T>>> : FormulaBase<Log<SE3<T>>> {
  using Base = FormulaBase<Log<SE3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> q = Quaternion<L>::of(x);
    const Lanes3<L> t = Lanes3<L>::of(x + 4);
    const LogLanes<T> log(q);
    q.u.crossAdd(multiplyAdd(log.d, q.u.cross(t), -log.half_factor * t), t).put(y);
    ((log.half_factor + log.half_factor) * q.u).put(y + 3);
  }
};

template <class T>
struct Formula<Inverse<SO3<T>>> : FormulaBase<Inverse<SO3<T>>> {
  using Base = FormulaBase<Inverse<SO3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    Quaternion<L>::of(x).conjugate().put(y);
  }
};

template <class T>
struct Formula<Inverse<SE3<T>>> : FormulaBase<Inverse<SE3<T>>> {
  using Base = FormulaBase<Inverse<SE3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> back = Quaternion<L>::of(x).conjugate();
    back.put(y);
    back.rotate(-Lanes3<L>::of(x + 4)).put(y + 4);
  }
};

template <class T>
struct Formula<Inverse<SIM3<T>>> : FormulaBase<Inverse<SIM3<T>>> {
  using Base = FormulaBase<Inverse<SIM3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> back = Quaternion<L>::of(x).conjugate();
    const L scale = L::all(T(1)) / L{x[7]};
    back.put(y);
    back.rotate(-scale * Lanes3<L>::of(x + 4)).put(y + 4);
    y[7] = scale.r;
  }
};

template <class T>
struct Formula<Compose<SO3<T>>> : FormulaBase<Compose<SO3<T>>> {
  using Base = FormulaBase<Compose<SO3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    (Quaternion<L>::of(x) * Quaternion<L>::of(x + 4)).put(y);
  }
};

template <class T>
struct Formula<Compose<SE3<T>>> : FormulaBase<Compose<SE3<T>>> {
  using Base = FormulaBase<Compose<SE3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> a = Quaternion<L>::of(x);
    (a * Quaternion<L>::of(x + 7)).put(y);
    a.rotateAdd(Lanes3<L>::of(x + 11), Lanes3<L>::of(x + 4)).put(y + 4);
  }
};

template <class T>
struct Formula<Compose<SIM3<T>>> : FormulaBase<Compose<SIM3<T>>> {
  using Base = FormulaBase<Compose<SIM3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Quaternion<L> a = Quaternion<L>::of(x);
    (a * Quaternion<L>::of(x + 8)).put(y);
    multiplyAdd(L{x[7]}, a.rotate(Lanes3<L>::of(x + 12)), Lanes3<L>::of(x + 4)).put(y + 4);
    y[7] = x[7] * x[15];
  }
};

template <class T>
struct Formula<ActOnOne<SO3<T>>> : FormulaBase<ActOnOne<SO3<T>>> {
  using Base = FormulaBase<ActOnOne<SO3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    Quaternion<L>::of(x).rotate(Lanes3<L>::of(x + 4)).put(y);
  }
};

template <class T>
struct Formula<ActOnOne<SE3<T>>> : FormulaBase<ActOnOne<SE3<T>>> {
  using Base = FormulaBase<ActOnOne<SE3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    Quaternion<L>::of(x).rotateAdd(Lanes3<L>::of(x + 7), Lanes3<L>::of(x + 4)).put(y);
  }
};

template <class T>
struct Formula<ActOnOne<SIM3<T>>> : FormulaBase<ActOnOne<SIM3<T>>> {
  using Base = FormulaBase<ActOnOne<SIM3<T>>>;
  using Base::Base;
  using typename Base::L;
  using typename Base::Register;

  void operator()(const Register* x, Register* y) const noexcept {
    const Lanes3<L> turned = Quaternion<L>::of(x).rotate(Lanes3<L>::of(x + 8));
    multiplyAdd(L{x[7]}, turned, Lanes3<L>::of(x + 4)).put(y);
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

  static Lanes3<L> broadcast(const Vec<T, 3>& v) noexcept {
    return {L::all(v[0]), L::all(v[1]), L::all(v[2])};
  }

  Lanes3<L> a0, a1, a2, t;
};

}  // namespace GSLAM_DETAIL_VARIANT
}  // namespace detail
}  // namespace v1
}  // namespace gslam
#endif
