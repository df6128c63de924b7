// Functions as values: a callable behind a checked call.
#include <gslam/svar/svar.h>  // includes this file, so that it comes before the guard

#ifndef GSLAM_SVAR_DETAIL_SVAR_FUNCTION_H
#define GSLAM_SVAR_DETAIL_SVAR_FUNCTION_H

#include <gslam/base/detail/indices.h>
#include <gslam/svar/detail/svar_traits.h>

namespace gslam {
inline namespace v1 {
namespace detail {

/// What a function value holds.
class SvarFunction {
 public:
  virtual ~SvarFunction() = default;
  virtual Svar call(Span<const Svar> args) = 0;
  virtual std::string signature() const = 0;
};

/// One argument of a function, converted for a parameter of type P.
template <class P, bool readable = IsReadable<typename std::decay<P>::type>::value>
struct Argument {
  using Value = typename std::decay<P>::type;
  static_assert(!std::is_lvalue_reference<P>::value ||
                    std::is_const<typename std::remove_reference<P>::type>::value,
                "a function that changes its argument takes native objects only");
  static std::string typeName() { return svarTypeName<Value>(); }
  static Value get(const Svar& value) { return value.as<Value>(); }
};
template <class P>
struct Argument<P, false> {
  using Object = typename std::remove_reference<P>::type;
  static_assert(std::is_class<Object>::value && !IsText<Object>::value,
                "Svar does not know this parameter: take text as std::string, others by reference "
                "or by std::shared_ptr");
  static std::string typeName() { return cppTypeName<Object>(); }
  // The function value's caller holds the argument, and so the object, until the call ends.
  static Object& get(const Svar& value) {
    using Pointer = std::shared_ptr<Object>;
    if (value.isNull()) SvarParts::failType(value, svarTypeName<Pointer>());
    return *value.as<Pointer>();
  }
};

template <class P>
auto convertArgument(Span<const Svar> args, std::size_t i) -> decltype(Argument<P>::get(args[i])) {
  try {
    return Argument<P>::get(args[i]);
  } catch (const SvarError& error) {
    throw SvarError("argument " + std::to_string(i + 1),
                    error.path().empty() ? error.problem() : error.what());
  }
}

/// A callable F whose parameters are P and whose result is R.
template <class F, class R, class... P>
class SvarCallable : public SvarFunction {
 public:
  explicit SvarCallable(F callable) : callable_(std::move(callable)) {}

  Svar call(Span<const Svar> args) override {
    if (args.size() != sizeof...(P)) failCount(args.size());
    return callWith(args, typename MakeIndices<sizeof...(P)>::Type(), std::is_void<R>());
  }

  std::string signature() const override {
    const std::string names[] = {Argument<P>::typeName()..., ""};
    std::string text = resultName(std::is_void<R>()) + "(";
    for (std::size_t i = 0; i < sizeof...(P); ++i) text += (i == 0 ? "" : ", ") + names[i];
    return text + ")";
  }

 private:
  template <std::size_t... I>
  Svar callWith(Span<const Svar> args, Indices<I...>, std::false_type) {
    (void)args;
    return Svar(callable_(convertArgument<P>(args, I)...));
  }
  template <std::size_t... I>
  Svar callWith(Span<const Svar> args, Indices<I...>, std::true_type) {
    (void)args;
    callable_(convertArgument<P>(args, I)...);
    return Svar();
  }

  static std::string resultName(std::true_type) { return "void"; }
  static std::string resultName(std::false_type) {
    return svarTypeName<typename std::decay<R>::type>();
  }

  [[noreturn]] void failCount(std::size_t found) const {
    throw SvarError("", "expected " + std::to_string(sizeof...(P)) + " arguments for " +
                            signature() + ", found " + std::to_string(found));
  }

  F callable_;
};

/// A callable that takes all arguments as they are.
template <class F, class R>
class SvarCallable<F, R, Span<const Svar>> : public SvarFunction {
 public:
  explicit SvarCallable(F callable) : callable_(std::move(callable)) {}
  Svar call(Span<const Svar> args) override { return callWith(args, std::is_void<R>()); }
  std::string signature() const override {
    return svarTypeName<typename std::decay<R>::type>() + "(...)";
  }

 private:
  Svar callWith(Span<const Svar> args, std::false_type) { return Svar(callable_(args)); }
  Svar callWith(Span<const Svar> args, std::true_type) {
    callable_(args);
    return Svar();
  }
  F callable_;
};

/// Finds R and P from the type of a function or of an operator().
template <class F, class Operator>
struct CallableOf;
template <class F, class R, class... P>
struct CallableOf<F, R (*)(P...)> {
  using type = SvarCallable<F, R, P...>;
};
template <class F, class C, class R, class... P>
struct CallableOf<F, R (C::*)(P...)> : CallableOf<F, R (*)(P...)> {};
template <class F, class C, class R, class... P>
struct CallableOf<F, R (C::*)(P...) const> : CallableOf<F, R (*)(P...)> {};
#ifdef __cpp_noexcept_function_type
template <class F, class R, class... P>
struct CallableOf<F, R (*)(P...) noexcept> : CallableOf<F, R (*)(P...)> {};
template <class F, class C, class R, class... P>
struct CallableOf<F, R (C::*)(P...) noexcept> : CallableOf<F, R (*)(P...)> {};
template <class F, class C, class R, class... P>
struct CallableOf<F, R (C::*)(P...) const noexcept> : CallableOf<F, R (*)(P...)> {};
#endif

template <class F, bool is_class = std::is_class<F>::value>
struct OperatorOf {
  using type = F;
};
template <class F>
struct OperatorOf<F, true> {
  using type = decltype(&F::operator());
};

}  // namespace detail

template <class F>
Svar Svar::function(F callable) {
  using Operator = typename detail::OperatorOf<F>::type;
  using Callable = typename detail::CallableOf<F, Operator>::type;
  const std::shared_ptr<detail::SvarFunction> made =
      std::make_shared<Callable>(std::move(callable));
  return Svar(SvarType::function, made);
}

inline detail::SvarFunction& Svar::asFunction() const {
  return *static_cast<detail::SvarFunction*>(data_.get());
}

inline Svar Svar::apply(Span<const Svar> args) const {
  if (type_ != SvarType::function) failType("", "function");
  const Svar held = *this;  // the function may replace the value it is called from
  return held.asFunction().call(args);
}

inline std::string Svar::signature() const {
  if (type_ != SvarType::function) failType("", "function");
  return asFunction().signature();
}

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_SVAR_FUNCTION_H
