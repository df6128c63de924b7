// Containers of the standard library to Svar and back.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>
#if __cplusplus >= 201703L
#include <optional>
#endif

#include "error_text.h"

namespace {

using gslam::Svar;
using gslam::SvarError;

// What Svar does not know, it does not take for something else.
static_assert(!std::is_convertible<std::map<int, int>, Svar>::value, "");
static_assert(!std::is_convertible<std::vector<int>*, Svar>::value, "");
static_assert(!std::is_convertible<std::vector<bool>::reference, Svar>::value, "");
static_assert(!std::is_convertible<std::nullptr_t*, Svar>::value, "");

// A container whose functions return something, as those of other libraries do.
struct Chain {
  using value_type = int;
  int& push_back(int value) {
    list.push_back(value);
    return list.back();
  }
  bool reserve(std::size_t size) {
    list.reserve(size);
    return true;
  }
  std::vector<int>::const_iterator begin() const { return list.begin(); }
  std::vector<int>::const_iterator end() const { return list.end(); }
  friend bool operator==(const Chain& a, const Chain& b) { return a.list == b.list; }
  std::vector<int> list;
};

template <class T>
void expectBothWays(const T& container, const Svar& value) {
  EXPECT_EQ(Svar(container), value);
  EXPECT_EQ(value.as<T>(), container);
  EXPECT_TRUE(value.is<T>());
  EXPECT_EQ(Svar::object({{"k", value}}).get<T>("k"), container);
  EXPECT_EQ(Svar().get<T>("k", container), container);
}

TEST(Container, SequencesAreArrays) {
  const Svar value = Svar::array({1, 2, 3});
  expectBothWays(std::vector<int>{1, 2, 3}, value);
  expectBothWays(std::vector<std::uint8_t>{1, 2, 3}, value);
  expectBothWays(std::deque<std::int64_t>{1, 2, 3}, value);
  expectBothWays(std::list<short>{1, 2, 3}, value);
  expectBothWays(std::set<unsigned>{3, 2, 1}, value);
  expectBothWays(std::unordered_set<int>{7}, Svar::array({7}));
  expectBothWays(std::vector<std::string>{"a", ""}, Svar::array({"a", ""}));
  expectBothWays(std::vector<int>(), Svar::array());
  EXPECT_EQ(value.as<std::vector<double>>(), (std::vector<double>{1, 2, 3}));
}

TEST(Container, MayBeOfAnotherLibrary) {
  Chain chain;
  chain.list = {4, 5};
  expectBothWays(chain, Svar::array({4, 5}));
}

TEST(Container, OfBoolIsAnArrayOfBool) {
  expectBothWays(std::vector<bool>{true, false}, Svar::array({true, false}));
  EXPECT_FALSE(Svar::array({1, 0}).is<std::vector<bool>>());
}

TEST(Container, OfSvarSharesItsElements) {
  Svar inner = Svar::object();
  const Svar outer = std::vector<Svar>{inner, 2};
  inner.set("x", 1);
  EXPECT_EQ(outer.get<int>("0.x"), 1);
  EXPECT_EQ(outer.as<std::vector<Svar>>()[0].size(), 1u);
}

TEST(Container, SetsTakeElementsThatRepeatOnce) {
  EXPECT_EQ(Svar::array({1, 2, 1}).as<std::set<int>>(), (std::set<int>{1, 2}));
  EXPECT_EQ(Svar::array({1, 2, 1}).as<std::multiset<int>>().size(), 3u);
}

TEST(Container, MapsAreObjects) {
  const Svar value = Svar::object({{"a", 1}, {"b.c", 2}, {"", 3}});
  using Text = std::string;
  expectBothWays(std::map<Text, int>{{"b.c", 2}, {"a", 1}, {"", 3}}, value);
  expectBothWays(std::unordered_map<Text, double>{{"x", 0.5}}, Svar::object({{"x", 0.5}}));
  expectBothWays(std::map<Text, std::map<Text, bool>>{{"x", {}}},
                 Svar::object({{"x", Svar::object()}}));
  EXPECT_EQ(Svar(std::map<Text, int>{{"b", 2}, {"a", 1}}).members()[0].first, "a");
#if __cplusplus >= 201402L
  expectBothWays(std::map<Text, int, std::less<>>{{"b.c", 2}, {"a", 1}, {"", 3}}, value);
#endif
}

TEST(Container, MultimapsMayNotHaveANameTwice) {
  using Multimap = std::multimap<std::string, int>;
  expectBothWays(Multimap{{"a", 1}, {"b", 2}}, Svar::object({{"a", 1}, {"b", 2}}));
  EXPECT_EQ((errorText([] {
              Svar value(Multimap{{"a", 1}, {"b", 2}, {"b", 3}});
            })),
            "b: expected each name once, found it twice");
}

TEST(Container, TuplesAreArraysOfTheirSize) {
  expectBothWays(std::make_pair(1, std::string("x")), Svar::array({1, "x"}));
  expectBothWays(std::pair<const std::string, int>("x", 1), Svar::array({"x", 1}));
  expectBothWays(std::make_tuple(1, 0.5, true), Svar::array({1, 0.5, true}));
  expectBothWays(std::tuple<int>(1), Svar::array({1}));
  expectBothWays(std::tuple<>(), Svar::array());
  expectBothWays(std::tuple<std::tuple<int>>(std::tuple<int>(1)), Svar::array({Svar::array({1})}));
  expectBothWays(std::array<double, 3>{{1.5, 2.5, 3.5}}, Svar::array({1.5, 2.5, 3.5}));
  expectBothWays(std::array<int, 0>(), Svar::array());
  expectBothWays(std::array<std::array<int, 2>, 2>{{{{1, 2}}, {{3, 4}}}},
                 Svar::array({Svar::array({1, 2}), Svar::array({3, 4})}));
  EXPECT_EQ(errorText([] {
              Svar::array({1, 2}).as<std::array<int, 3>>();
            }),
            "expected array of 3, found array of 2");
  EXPECT_EQ(errorText([] { Svar().as<std::tuple<>>(); }), "expected array of 0, found null");
  EXPECT_EQ(errorText([] {
              Svar::array({1, "x"}).as<std::pair<int, int>>();
            }),
            "1: expected int32, found string \"x\"");
}

TEST(Container, ErrorsSayWhereInside) {
  const Svar config = Svar::object({{"k", Svar::array({1.0, 2.0, "x"})}, {"a.b", Svar::array()}});
  EXPECT_EQ(errorText([&] { config.get<std::vector<double>>("k"); }),
            "k.2: expected double, found string \"x\"");
  EXPECT_EQ(errorText([&] { config.get<std::vector<double>>("k", {1.0}); }),
            "k.2: expected double, found string \"x\"");
  EXPECT_EQ(errorText([&] { config["k"].as<std::vector<double>>(); }),
            "2: expected double, found string \"x\"");
  EXPECT_EQ((errorText([&] { config.as<std::map<std::string, std::vector<float>>>(); })),
            "k.2: expected float, found string \"x\"");
  EXPECT_EQ(errorText([&] { config.get<std::vector<int>>("/k"); }),
            "/k/2: expected int32, found string \"x\"");
  try {
    config.get<std::vector<double>>("k");
    FAIL() << "a string is no double";
  } catch (const SvarError& error) {
    EXPECT_EQ(error.path(), "k.2");
  }
}

TEST(Container, ErrorsNameTheWholeType) {
  using Table = std::vector<std::vector<double>>;
  EXPECT_EQ(errorText([] { Svar(3).as<Table>(); }),
            "expected array of array of double, found int 3");
  EXPECT_EQ(errorText([] {
              Svar::array({Svar::array(), 3}).as<Table>();
            }),
            "1: expected array of double, found int 3");
  EXPECT_EQ((errorText([] { Svar::array().as<std::map<std::string, int>>(); })),
            "expected object of int32, found array of 0");
  EXPECT_THROW(Svar().as<std::vector<int>>(), SvarError);
  EXPECT_THROW(Svar("abc").as<std::vector<std::string>>(), SvarError);
  EXPECT_THROW(Svar::object().as<std::vector<int>>(), SvarError);
}

TEST(Container, NumbersInsideAreCheckedToo) {
  EXPECT_FALSE(Svar::array({1, 2.75}).is<std::vector<int>>());
  EXPECT_FALSE(Svar::array({1, 256}).is<std::vector<std::uint8_t>>());
  EXPECT_FALSE(Svar::array({1, true}).is<std::vector<int>>());
}

TEST(Container, OfBytesIsMadeFromABinaryToo) {
  const std::string bytes("\x00\xff\x07", 3);
  const Svar binary = Svar::binary(bytes.data(), bytes.size());
  EXPECT_EQ(binary.as<std::vector<std::uint8_t>>(), (std::vector<std::uint8_t>{0, 255, 7}));
  EXPECT_EQ(binary.as<std::deque<std::uint8_t>>().size(), 3u);
  EXPECT_FALSE(binary.is<std::vector<int>>());
  EXPECT_FALSE(binary.is<std::vector<std::int8_t>>());
  EXPECT_EQ(Svar::binary(nullptr, 0).as<std::vector<std::uint8_t>>().size(), 0u);
}

TEST(Container, FallbackMayBeWrittenInBraces) {
  const Svar config;
  EXPECT_EQ(config.get<std::vector<int>>("k", {1, 2}), (std::vector<int>{1, 2}));
  EXPECT_TRUE(config.get<std::vector<int>>("k", {}).empty());
}

TEST(Container, ChangingTheValueChangesNoContainer) {
  std::vector<int> list = {1};
  Svar value = list;
  value.push_back(2);
  EXPECT_EQ(list.size(), 1u);
  list = value.as<std::vector<int>>();
  value.set("0", 7);
  EXPECT_EQ(list, (std::vector<int>{1, 2}));
}

#if __cplusplus >= 201703L
TEST(Container, OptionalsAreNullOrTheirValue) {
  expectBothWays(std::optional<int>(3), Svar(3));
  expectBothWays(std::optional<int>(), Svar());
  expectBothWays(std::optional<bool>(false), Svar(false));
  expectBothWays(std::optional<std::optional<int>>(3), Svar(3));
  expectBothWays(std::vector<std::optional<double>>{1.5, std::nullopt},
                 Svar::array({1.5, nullptr}));
  EXPECT_EQ(Svar(std::optional<std::optional<int>>(std::optional<int>())), Svar());
  EXPECT_EQ(errorText([] { Svar("x").as<std::optional<int>>(); }),
            "expected int32, found string \"x\"");
  EXPECT_EQ(errorText([] { Svar::object().get<std::optional<int>>("x"); }),
            "x: expected int32 or null, found nothing: no \"x\" in the value (object of 0)");
}
#endif

}  // namespace
