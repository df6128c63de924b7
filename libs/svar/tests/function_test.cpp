// Functions as values: what can be called, how arguments convert, what errors and exceptions do.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "error_text.h"

namespace {

using gslam::Span;
using gslam::Svar;
using gslam::SvarError;
using gslam::SvarType;

struct Counter {
  int count = 0;
};

int twice(int x) {
  return 2 * x;
}

int thrice(int x) noexcept {
  return 3 * x;
}

TEST(Function, IsAValueOfItsOwnType) {
  const Svar f = Svar::function(twice);
  EXPECT_EQ(f.type(), SvarType::function);
  EXPECT_STREQ(f.typeName(), "function");
  EXPECT_FALSE(f.isNull());
  EXPECT_FALSE(f.is<int>());
  EXPECT_EQ(errorText([&] { f.as<int>(); }), "expected int32, found function int32(int32)");
  EXPECT_EQ(errorText([&] { f.size(); }), "expected array or object, found function int32(int32)");
}

TEST(Function, EqualsOnlyItselfBeItCopiedOrCloned) {
  const Svar f = Svar::function(twice);
  const std::vector<Svar> copies(2, f);
  EXPECT_EQ(copies[0], f);
  EXPECT_EQ(f.clone(), f);
  EXPECT_EQ(f.frozen(), f);
  EXPECT_EQ(Svar::array({f}).clone(), Svar::array({f}));
  EXPECT_NE(Svar::function(twice), f);
}

TEST(Function, IsCalledWithCheckedConversion) {
  const Svar f = Svar::function([](int i, double d, const std::string& s, bool b) {
    return s + std::to_string(i + static_cast<int>(d)) + (b ? "!" : "?");
  });
  EXPECT_EQ(f(1, 2.0, "a", true), "a3!");
  EXPECT_EQ(f(1.0, 2, std::string("b"), false), "b3?");
  EXPECT_EQ(errorText([&] { f(1, 2.0, 3, true); }), "argument 3: expected string, found int 3");
  EXPECT_EQ(errorText([&] { f(2.5, 2.0, "", true); }),
            "argument 1: expected int32, found double 2.5");
  EXPECT_EQ(errorText([&] { f(1, 2.0); }),
            "expected 4 arguments for string(int32, double, string, bool), found 2");
  EXPECT_THROW(f(), SvarError);
  EXPECT_THROW(f(1, 2.0, "a", true, nullptr), SvarError);
}

TEST(Function, TakesAllThatCanBeCalled) {
  int calls = 0;
  const std::string end = "!";
  const std::function<int(int)> wrapped = twice;
  EXPECT_EQ(Svar::function(twice)(4), 8);
  EXPECT_EQ(Svar::function(&thrice)(4), 12);
  EXPECT_EQ(Svar::function(wrapped)(4), 8);
  EXPECT_EQ(Svar::function([end](const std::string& s) { return s + end; })("a"), "a!");
  EXPECT_EQ(Svar::function([](int x) noexcept { return -x; })(4), -4);
  EXPECT_EQ(Svar::function([&calls] { ++calls; })(), nullptr);
  EXPECT_EQ(calls, 1);
  const Svar counting = Svar::function([calls]() mutable { return ++calls; });
  EXPECT_EQ(counting(), 2);
  EXPECT_EQ(counting(), 3);
}

TEST(Function, MayBeMoveOnly) {
  struct Owner {
    int operator()(int x) const { return *added + x; }
    std::unique_ptr<int> added;
  };
  Owner owner;
  owner.added.reset(new int(5));
  EXPECT_EQ(Svar::function(std::move(owner))(1), 6);
}

TEST(Function, ParametersLiveUntilTheResultIsMade) {
  const std::string text(100, 'x');
  const Svar same = Svar::function([](const std::string& s) -> const std::string& { return s; });
  EXPECT_EQ(same(text), Svar(text));
  const Svar take = Svar::function([](std::vector<int>&& v) {
    std::vector<int> mine = std::move(v);
    return mine;
  });
  const Svar list = Svar::array({1, 2});
  EXPECT_EQ(take(list), list);
  const Svar by_value = Svar::function([](std::string s) { return s += "y"; });
  EXPECT_EQ(by_value(text), Svar(text + "y"));
  EXPECT_EQ(Svar::function([](const std::string& s) { return s.c_str(); })(text), Svar(text));
}

TEST(Function, ResultsMayBeReferences) {
  std::string text = "kept";
  const Svar f = Svar::function([&text]() -> std::string& { return text; });
  EXPECT_EQ(f(), "kept");
  EXPECT_EQ(f.signature(), "string()");
}

TEST(Function, TakesHandlesThatItMayChange) {
  Svar config = Svar::object();
  const Svar f = Svar::function([](Svar object, const Svar& value) { object.set("x", value); });
  EXPECT_EQ(f(config, 7), nullptr);
  EXPECT_EQ(config.get<int>("x"), 7);
  EXPECT_EQ(f.signature(), "void(any value, any value)");
}

TEST(Function, TakesNativeObjectsByReference) {
  const auto counter = std::make_shared<Counter>();
  const Svar count = Svar::function([](Counter& c, int by) { c.count += by; });
  const Svar read = Svar::function([](const Counter& c) { return c.count; });
  count(counter, 2);
  count(counter, 3);
  EXPECT_EQ(counter->count, 5);
  EXPECT_EQ(read(counter), 5);
  EXPECT_EQ(read(std::make_shared<const Counter>()), 0);
  EXPECT_THROW(count(std::make_shared<const Counter>(), 1), SvarError);
  EXPECT_THROW(count(3, 1), SvarError);
  EXPECT_THROW(count(nullptr, 1), SvarError);  // a null shared_ptr, but no object
  EXPECT_THROW(read(std::shared_ptr<Counter>()), SvarError);
  EXPECT_THROW(count(std::make_shared<int>(3), 1), SvarError);
}

TEST(Function, OfASpanGetsAllArguments) {
  const Svar sum = Svar::function([](Span<const Svar> args) {
    int total = 0;
    for (const Svar& arg : args) total += arg.as<int>();
    return total;
  });
  EXPECT_EQ(sum(), 0);
  EXPECT_EQ(sum(1, 2.0, 3), 6);
  EXPECT_EQ(sum.signature(), "int32(...)");
  int calls = 0;
  const Svar nothing = Svar::function([&calls](Span<const Svar>) { ++calls; });
  EXPECT_EQ(nothing(1, "x"), nullptr);
  EXPECT_EQ(nothing.signature(), "void(...)");
  EXPECT_EQ(calls, 1);
}

TEST(Function, TakesArgumentsFromAList) {
  const Svar f = Svar::function([](int a, int b) { return a - b; });
  const std::vector<Svar> list = {7, 3};
  EXPECT_EQ(f.apply(list), 4);
  EXPECT_THROW(f.apply(Span<const Svar>()), SvarError);
}

TEST(Function, SaysItsSignature) {
  using List = std::vector<std::vector<double>>;
  EXPECT_EQ(Svar::function([] {}).signature(), "void()");
  EXPECT_EQ(Svar::function([](const List&, float) { return true; }).signature(),
            "bool(array of array of double, float)");
  EXPECT_EQ(errorText([] { Svar(3).signature(); }), "expected function, found int 3");
}

TEST(Function, ErrorsInArgumentsSayWhereInsideOfThem) {
  const Svar f = Svar::function([](const std::vector<int>&) {});
  EXPECT_EQ(errorText([&] {
              f(Svar::array({1, "x"}));
            }),
            "argument 1: 1: expected int32, found string \"x\"");
}

TEST(Function, ExceptionsOfTheCallableComeThroughAsTheyAre) {
  const Svar f = Svar::function([](int x) -> int {
    if (x == 0) throw std::out_of_range("zero");
    if (x == 1) throw SvarError("mine", "is one");
    throw x;
  });
  EXPECT_THROW(f(0), std::out_of_range);
  EXPECT_EQ(errorText([&] { f(1); }), "mine: is one");
  EXPECT_THROW(f(2), int);
  EXPECT_EQ(errorText([&] { f("x"); }), "argument 1: expected int32, found string \"x\"");
}

TEST(Function, IsFoundByPathAndCalled) {
  const Svar config = Svar::object({{"math", Svar::object({{"twice", Svar::function(twice)}})}});
  EXPECT_EQ(config["math.twice"](21), 42);
  EXPECT_EQ(errorText([&] { config["math"](21); }), "expected function, found object of 1");
}

TEST(Function, MayReplaceTheValueItIsCalledFrom) {
  const std::string text(100, 'x');
  Svar once;
  once = Svar::function([&once, text] {
    once = "done";
    return text.size();
  });
  EXPECT_EQ(once(), 100);
  EXPECT_EQ(once, "done");
}

TEST(Function, KeepsWhatItCaptures) {
  const auto counter = std::make_shared<Counter>();
  Svar f = Svar::function([counter] { return counter->count; });
  Svar copy = f.clone();
  EXPECT_EQ(counter.use_count(), 2);
  f = nullptr;
  EXPECT_EQ(counter.use_count(), 2);
  copy = nullptr;
  EXPECT_EQ(counter.use_count(), 1);
}

}  // namespace
