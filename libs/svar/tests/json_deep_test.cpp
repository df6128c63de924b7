// JSON of any size and depth: round trips of random values, cut and broken texts, depth limits.
#include <gslam/svar.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include "json_reject.h"

namespace {

using gslam::JsonOptions;
using gslam::ParseError;
using gslam::parseJson;
using gslam::printJson;
using gslam::Svar;
using json_reject::errorOf;

using Random = std::mt19937_64;

int below(Random& random, int end) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(end));
}

// Any finite double: all exponents are as likely.
double randomDouble(Random& random) {
  for (;;) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof(value));
    if (std::isfinite(value)) return value;
  }
}

std::string randomText(Random& random) {
  static const char* const pieces[] = {"a",
                                       "Z9",
                                       " ",
                                       "\"",
                                       "\\",
                                       "/",
                                       "\n",
                                       "\t",
                                       "\x01",
                                       "\x7F",
                                       "\xC3\xA9",
                                       "'",
                                       "\\n",
                                       "\\u0",
                                       "{",
                                       "\xE2\x82\xAC",
                                       "\xF0\x9F\x98\x80",
                                       "],"};
  std::string text;
  for (int i = below(random, 12); i > 0; --i) {
    text += pieces[below(random, static_cast<int>(sizeof(pieces) / sizeof(pieces[0])))];
  }
  if (below(random, 20) == 0) text += '\0';
  return text;
}

Svar randomScalar(Random& random) {
  switch (below(random, 7)) {
    case 0:
      return nullptr;
    case 1:
      return below(random, 2) == 0;
    case 2:
      return below(random, 2000) - 1000;
    case 3:
      return static_cast<std::int64_t>(random());
    case 4:
      return randomDouble(random);
    case 5:
      return std::round(randomDouble(random) * 1e3) / 1e3;  // few digits, or infinite
    default:
      return randomText(random);
  }
}

Svar randomTree(Random& random, int depth) {
  const int kind = depth == 0 ? 2 : below(random, 4);
  Svar made = kind == 0 ? Svar::array() : Svar::object();
  if (kind > 1) {
    const Svar scalar = randomScalar(random);
    const bool printable = !scalar.is<double>() || std::isfinite(scalar.as<double>());
    return printable ? scalar : Svar(0.5);
  }
  const int size = below(random, 5) == 0 ? below(random, 30) : below(random, 5);
  for (int i = 0; i < size; ++i) {
    Svar part = randomTree(random, depth - 1);
    if (kind == 0) {
      made.push_back(part);
    } else {
      made.set("n" + std::to_string(below(random, 1000)), part);
    }
  }
  return made;
}

TEST(JsonRoundTrip, RandomTrees) {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Svar value = randomTree(random, 6);
    const std::string text = printJson(value);
    const Svar again = parseJson(text);
    ASSERT_EQ(again, value) << text;
    ASSERT_EQ(printJson(again), text);  // the order of members, too
    ASSERT_EQ(parseJson(printJson(value, below(random, 5))), value) << text;
  }
}

TEST(JsonRoundTrip, DoublesKeepAllTheirBits) {
  Random random(2);
  for (int i = 0; i < 50000; ++i) {
    const double value = randomDouble(random);
    const double again = parseJson(printJson(value)).as<double>();
    ASSERT_EQ(again, value) << printJson(value);
    ASSERT_EQ(std::signbit(again), std::signbit(value));
  }
}

TEST(JsonRoundTrip, StampOfTumSurvives) {
  const char* const text = "1305031102.175304";
  EXPECT_EQ(printJson(parseJson(text)), text);
  EXPECT_EQ(parseJson(text).as<double>(), 1305031102.175304);
}

TEST(JsonRoundTrip, IntegersAndDoublesStayWhatTheyAre) {
  EXPECT_EQ(printJson(parseJson("[1,1.0,1e0,100000000000000000000]")), "[1,1.0,1.0,1e20]");
  EXPECT_EQ(parseJson("1").type(), gslam::SvarType::integer);
  EXPECT_EQ(parseJson("1.0").type(), gslam::SvarType::real);
}

// All of a text that has one of everything.
const char* const kDocument = R"({
  "name": "caf\u00e9 \ud83d\ude00 \\ \"\n",
  "numbers": [0, -1, 12, 0.5, -1.25e+3, 1e-7, 9223372036854775807],
  "words": [true, false, null],
  "empty": [{}, [], ""],
  "deep": {"a": {"b": [[["é€😀"]]]}}
})";

TEST(JsonCut, EveryBeginningIsAnError) {
  const std::string text = kDocument;
  EXPECT_EQ(parseJson(text).size(), 5u);
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string cut = text.substr(0, size);  // so that a sanitizer sees reads beyond it
    EXPECT_THROW(parseJson(cut), ParseError) << cut;
    std::vector<char> exact(cut.begin(), cut.end());
    EXPECT_THROW(parseJson({exact.data(), exact.size()}), ParseError) << cut;
  }
}

TEST(JsonCut, BeginningsOfNumbersMayBeNumbers) {
  const std::string text = "-12.5e+3";
  const bool is_number[] = {false, false, true, true, false, true, false, false, true};
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const std::vector<char> cut(text.data(), text.data() + size);
    SCOPED_TRACE(size);
    if (is_number[size]) {
      EXPECT_EQ(parseJson({cut.data(), size}).as<double>(), std::stod(text.substr(0, size)));
    } else {
      EXPECT_THROW(parseJson({cut.data(), size}), ParseError);
    }
  }
}

TEST(JsonCut, EveryEndIsAnError) {
  const std::string text = kDocument;
  for (std::size_t begin = 1; begin < text.size(); ++begin) {
    const std::string cut = text.substr(begin);
    if (cut[0] != '{' || begin > text.size() - 4) {
      EXPECT_THROW(parseJson(cut), ParseError) << cut;
    }
  }
}

TEST(JsonCut, BrokenBytesNeverCrash) {
  Random random(3);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = kDocument;
    for (int k = below(random, 3); k >= 0; --k) {
      text[random() % text.size()] = static_cast<char>(random());
    }
    try {
      const Svar value = parseJson(text);
      ASSERT_EQ(parseJson(printJson(value)), value) << text;
      ++accepted;
    } catch (const ParseError& error) {
      ASSERT_GT(error.column(), 0u);
    }
  }
  EXPECT_GT(accepted, 100);  // a letter for a letter
  EXPECT_LT(accepted, 10000);
}

std::string repeated(const std::string& text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

TEST(JsonDepth, IsLimited) {
  JsonOptions options;
  const std::string thousand = repeated("[", 1000) + repeated("]", 1000);
  EXPECT_EQ(errorOf(thousand, options), "accepted");
  EXPECT_EQ(errorOf("[" + thousand + "]", options),
            "1:1001: expected at most 1000 arrays and objects inside one another, found one "
            "more");
  options.max_depth = 2;
  EXPECT_EQ(errorOf("[{}, [], {\"a\": 1}]", options), "accepted");
  EXPECT_EQ(errorOf("[{\"a\": []}]", options),
            "1:8: expected at most 2 arrays and objects inside one another, found one more");
  options.max_depth = 0;
  EXPECT_EQ(errorOf("\"a\"", options), "accepted");
  EXPECT_EQ(errorOf("[]", options),
            "1:1: expected at most 0 arrays and objects inside one another, found one more");
}

TEST(JsonDepth, AMillionIsRefused) {
  EXPECT_THROW(parseJson(repeated("[", 1000000)), ParseError);
  EXPECT_THROW(parseJson(repeated("{\"a\":", 1000000)), ParseError);
}

TEST(JsonDepth, AMillionOnRequest) {
  JsonOptions options;
  options.max_depth = 1000000;
  const std::string arrays = repeated("[", 1000000) + repeated("]", 1000000);
  EXPECT_EQ(printJson(parseJson(arrays, "JSON", options)), arrays);
  EXPECT_THROW(parseJson(repeated("[", 1000000), "JSON", options), ParseError);  // without an end
  const std::string objects = repeated("{\"a\":", 300000) + "1" + repeated("}", 300000);
  const Svar deep = parseJson(objects, "JSON", options);
  EXPECT_EQ(printJson(deep), objects);
  EXPECT_EQ(parseJson(printJson(deep, 1), "JSON", options), deep);
}

TEST(JsonDepth, ErrorsInTheDeepNameThePath) {
  Svar value = Svar::array({std::nan("")});
  for (int i = 0; i < 100000; ++i) value = Svar::array({value});
  try {
    printJson(value);
    FAIL();
  } catch (const gslam::SvarError& error) {
    EXPECT_EQ(error.path().size(), 200001u);
  }
}

TEST(JsonSize, ManyNamesTakeNoQuadraticTime) {
  std::string text = "{\"\":0";
  for (int i = 0; i < 200000; ++i) {
    text += ",\"" + std::to_string(i * 7919LL % 200000) + "\":" + std::to_string(i);
  }
  const Svar value = parseJson(text + "}");
  EXPECT_EQ(value.size(), 200001u);
  EXPECT_EQ(value.get<int>("7919"), 1);
}

}  // namespace
