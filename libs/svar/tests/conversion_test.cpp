// From C++ to Svar and back, where the value must stay what it is.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "error_text.h"
#include "int64_limits.h"

namespace {

using gslam::Svar;
using gslam::SvarError;
using gslam::SvarType;

constexpr std::int64_t kTwoTo53 = std::int64_t(1) << 53;

// Pointers are no bools, characters no numbers; a write to what operator[] gives is not silent.
static_assert(!std::is_convertible<void*, Svar>::value, "");
static_assert(!std::is_convertible<const int*, Svar>::value, "");
static_assert(!std::is_convertible<char, Svar>::value, "");
static_assert(!std::is_convertible<long double, Svar>::value, "");
#ifdef __SIZEOF_INT128__
__extension__ using Int128 = __int128;  // its upper half would be lost
static_assert(!std::is_convertible<Int128, Svar>::value, "");
#endif
static_assert(!std::is_constructible<gslam::detail::Text, std::nullptr_t>::value, "");
static_assert(!std::is_assignable<Svar, int>::value, "config[\"fps\"] = 30 must not compile");
static_assert(std::is_nothrow_move_constructible<Svar>::value, "");
static_assert(std::is_nothrow_move_assignable<Svar>::value, "");
static_assert(std::is_nothrow_copy_constructible<SvarError>::value, "");
static_assert(std::is_base_of<gslam::Error, SvarError>::value, "");

TEST(Construction, KnowsItsType) {
  EXPECT_EQ(Svar().type(), SvarType::null);
  EXPECT_EQ(Svar(nullptr).type(), SvarType::null);
  EXPECT_EQ(Svar(true).type(), SvarType::boolean);
  EXPECT_EQ(Svar(0).type(), SvarType::integer);
  EXPECT_EQ(Svar(std::uint8_t(7)).type(), SvarType::integer);
  EXPECT_EQ(Svar(0.0).type(), SvarType::real);
  EXPECT_EQ(Svar(0.5f).type(), SvarType::real);
  EXPECT_EQ(Svar("abc").type(), SvarType::string);
  EXPECT_EQ(Svar(std::string("abc")).type(), SvarType::string);
  EXPECT_EQ(Svar::array().type(), SvarType::array);
  EXPECT_EQ(Svar::object().type(), SvarType::object);
}

TEST(Construction, NamesItsType) {
  EXPECT_STREQ(Svar().typeName(), "null");
  EXPECT_STREQ(Svar(false).typeName(), "bool");
  EXPECT_STREQ(Svar(1).typeName(), "int");
  EXPECT_STREQ(Svar(1.0).typeName(), "double");
  EXPECT_STREQ(Svar("").typeName(), "string");
  EXPECT_STREQ(Svar::array().typeName(), "array");
  EXPECT_STREQ(Svar::object().typeName(), "object");
}

TEST(Construction, RefusesWhatInt64CannotHold) {
  EXPECT_EQ(Svar(std::uint64_t(kMax64)).as<std::int64_t>(), kMax64);
  EXPECT_EQ(errorText([] { Svar(std::uint64_t(kMax64) + 1); }),
            "expected at most 9223372036854775807, the largest int64, found 9223372036854775808");
  EXPECT_THROW(Svar{std::numeric_limits<std::uint64_t>::max()}, SvarError);
}

TEST(Construction, RefusesNullPointers) {
  const char* const nothing = nullptr;
  EXPECT_EQ(errorText([=] { Svar value(nothing); }), "expected text, found a null pointer");
  EXPECT_THROW(Svar::object().contains(nothing), SvarError);
}

TEST(Construction, RefusesANameTwice) {
  EXPECT_EQ(errorText([] {
              Svar::object({{"a", 1}, {"a", 2}});
            }),
            "a: expected each name once, found it twice");
}

TEST(Construction, KeepsBytes) {
  const std::string bytes("a\0b\xff", 4);
  EXPECT_EQ(Svar(bytes).as<std::string>(), bytes);
  EXPECT_EQ(Svar::object({{bytes, 1}})[bytes].as<int>(), 1);
}

template <class T>
void expectLimits() {
  const std::int64_t least = std::numeric_limits<T>::min();
  const std::int64_t most = std::numeric_limits<T>::max();
  EXPECT_EQ(Svar(least).as<T>(), std::numeric_limits<T>::min());
  EXPECT_EQ(Svar(most).as<T>(), std::numeric_limits<T>::max());
  EXPECT_EQ(Svar(static_cast<double>(most)).as<T>(), std::numeric_limits<T>::max());
  EXPECT_THROW(Svar(least - 1).as<T>(), SvarError);
  EXPECT_THROW(Svar(most + 1).as<T>(), SvarError);
  EXPECT_THROW(Svar(static_cast<double>(least - 1)).as<T>(), SvarError);
  EXPECT_THROW(Svar(static_cast<double>(most + 1)).as<T>(), SvarError);
  EXPECT_FALSE(Svar(most + 1).is<T>());
  EXPECT_TRUE(Svar(most).is<T>());
}

TEST(Conversion, IntegersStopAtTheirLimits) {
  expectLimits<std::int8_t>();
  expectLimits<std::uint8_t>();
  expectLimits<std::int16_t>();
  expectLimits<std::uint16_t>();
  expectLimits<std::int32_t>();
  expectLimits<std::uint32_t>();
}

TEST(Conversion, IntegersOf64Bits) {
  EXPECT_EQ(Svar(kMin64).as<std::int64_t>(), kMin64);
  EXPECT_EQ(Svar(kMax64).as<long long>(), kMax64);
  EXPECT_EQ(Svar(kMax64).as<std::uint64_t>(), std::uint64_t(kMax64));
  EXPECT_EQ(Svar(0).as<std::size_t>(), 0u);
  EXPECT_THROW(Svar(-1).as<std::uint64_t>(), SvarError);
  EXPECT_THROW(Svar(kMin64).as<std::uint64_t>(), SvarError);
}

TEST(Conversion, IntegerToDoubleOnlyWhenExact) {
  EXPECT_EQ(Svar(kTwoTo53).as<double>(), 9007199254740992.0);
  EXPECT_EQ(Svar(kTwoTo53 + 2).as<double>(), 9007199254740994.0);
  EXPECT_EQ(Svar(kMin64).as<double>(), -9223372036854775808.0);
  EXPECT_THROW(Svar(kMax64).as<double>(), SvarError);  // rounds up to 2^63
  EXPECT_THROW(Svar(-kTwoTo53 - 1).as<double>(), SvarError);
  EXPECT_EQ(errorText([] { Svar(kTwoTo53 + 1).as<double>(); }),
            "expected double, found int 9007199254740993");
  EXPECT_EQ(Svar(1 << 24).as<float>(), 16777216.0f);
  EXPECT_THROW(Svar((1 << 24) + 1).as<float>(), SvarError);
  EXPECT_THROW(Svar(kMax64).as<float>(), SvarError);
}

TEST(Conversion, DoubleToIntegerOnlyWhenWhole) {
  EXPECT_EQ(Svar(3.0).as<int>(), 3);
  EXPECT_EQ(Svar(-3.0).as<std::int8_t>(), -3);
  EXPECT_EQ(Svar(-0.0).as<unsigned>(), 0u);
  EXPECT_EQ(Svar(-9223372036854775808.0).as<std::int64_t>(), kMin64);
  EXPECT_EQ(Svar(9223372036854774784.0).as<std::int64_t>(), 9223372036854774784);
  EXPECT_THROW(Svar(9223372036854775808.0).as<std::int64_t>(), SvarError);
  EXPECT_THROW(Svar(9223372036854775808.0).as<std::uint64_t>(), SvarError);
  EXPECT_THROW(Svar(-9223372036854777856.0).as<std::int64_t>(), SvarError);
  EXPECT_THROW(Svar(1e300).as<int>(), SvarError);
  EXPECT_THROW(Svar(std::nan("")).as<int>(), SvarError);
  EXPECT_THROW(Svar(INFINITY).as<std::int64_t>(), SvarError);
  EXPECT_THROW(Svar(-INFINITY).as<std::int64_t>(), SvarError);
}

TEST(Conversion, FractionIsRefusedAndKept) {
  const Svar value(2.75);
  EXPECT_EQ(errorText([&] { value.as<int>(); }), "expected int32, found double 2.75");
  EXPECT_FALSE(value.is<int>());
  EXPECT_EQ(value.type(), SvarType::real);
  EXPECT_EQ(value.as<double>(), 2.75);
}

TEST(Conversion, DoubleToFloat) {
  EXPECT_EQ(Svar(0.1).as<float>(), 0.1f);
  EXPECT_EQ(Svar(double(std::numeric_limits<float>::max())).as<float>(),
            std::numeric_limits<float>::max());
  EXPECT_THROW(Svar(1e39).as<float>(), SvarError);
  EXPECT_THROW(Svar(-1e39).as<float>(), SvarError);
  EXPECT_EQ(Svar(INFINITY).as<float>(), INFINITY);
  EXPECT_TRUE(std::isnan(Svar(std::nan("")).as<float>()));
  EXPECT_TRUE(std::isnan(Svar(std::nan("")).as<double>()));
}

TEST(Conversion, TextIsNeverParsed) {
  EXPECT_EQ(errorText([] { Svar("abc").as<int>(); }), "expected int32, found string \"abc\"");
  EXPECT_THROW(Svar("30").as<int>(), SvarError);
  EXPECT_THROW(Svar("true").as<bool>(), SvarError);
  EXPECT_THROW(Svar(30).as<std::string>(), SvarError);
}

TEST(Conversion, BinaryIsOnlyItself) {
  const std::string bytes("a\0\xff", 3);
  const Svar binary = Svar::binary(bytes.data(), bytes.size());
  EXPECT_STREQ(binary.typeName(), "binary");
  ASSERT_EQ(binary.bytes().size(), 3u);
  EXPECT_EQ(binary.bytes()[2], 0xFF);
  EXPECT_EQ(errorText([&] { binary.as<std::string>(); }),
            "expected string, found binary of 3 bytes");
  EXPECT_FALSE(binary.is<int>());
  EXPECT_EQ(errorText([] { Svar("abc").bytes(); }), "expected binary, found string \"abc\"");
  EXPECT_THROW(binary.size(), SvarError);
  EXPECT_TRUE(Svar::binary(nullptr, 0).bytes().empty());
}

TEST(Conversion, RefusedOnesLeaveTheValueAsItIs) {
  const Svar config = Svar::object({{"scale", 2.75}, {"name", "abc"}, {"on", true}});
  const Svar before = config.clone();
  EXPECT_THROW(config.get<int>("scale"), SvarError);
  EXPECT_THROW(config.get<int>("scale", 1), SvarError);
  EXPECT_THROW(config.get<int>("name"), SvarError);
  EXPECT_THROW(config.get<int>("name", 1), SvarError);
  EXPECT_THROW(config.get<double>("on"), SvarError);
  EXPECT_EQ(config, before);
}

TEST(Conversion, BoolIsNoNumber) {
  EXPECT_TRUE(Svar(true).as<bool>());
  EXPECT_EQ(errorText([] { Svar(true).as<int>(); }), "expected int32, found bool true");
  EXPECT_THROW(Svar(false).as<double>(), SvarError);
  EXPECT_EQ(errorText([] { Svar(1).as<bool>(); }), "expected bool, found int 1");
  EXPECT_THROW(Svar(0.0).as<bool>(), SvarError);
}

TEST(Conversion, NullArrayAndObjectAreOnlyThemselves) {
  for (const Svar& value : {Svar(), Svar::array({1}), Svar::object({{"a", 1}})}) {
    EXPECT_FALSE(value.is<bool>());
    EXPECT_FALSE(value.is<int>());
    EXPECT_FALSE(value.is<float>());
    EXPECT_FALSE(value.is<std::string>());
    EXPECT_TRUE(value.is<Svar>());
    EXPECT_EQ(value.as<Svar>(), value);
  }
  EXPECT_EQ(errorText([] { Svar().as<double>(); }), "expected double, found null");
  EXPECT_EQ(errorText([] {
              Svar::array({1, 2}).as<std::uint8_t>();
            }),
            "expected uint8, found array of 2");
  EXPECT_EQ(errorText([] {
              Svar::object({{"a", 1}}).as<float>();
            }),
            "expected float, found object of 1");
}

TEST(Conversion, MessagesShowNumbersAsShortAsTheyAreAndCutLongText) {
  EXPECT_EQ(errorText([] { Svar(0.1).as<int>(); }), "expected int32, found double 0.1");
  EXPECT_EQ(errorText([] { Svar(0.1 + 0.2).as<int>(); }),
            "expected int32, found double 0.30000000000000004");
  EXPECT_EQ(errorText([] { Svar(std::string(41, 'a')).as<int>(); }),
            "expected int32, found string \"" + std::string(40, 'a') + "...\"");
  // Two bytes a letter, and the cut would fall between them.
  EXPECT_EQ(errorText([] { Svar(std::string(39, 'a') + "\xc3\xa9").as<int>(); }),
            "expected int32, found string \"" + std::string(39, 'a') + "...\"");
}

}  // namespace
