// What one number costs on its way from text and to text, beside the C and C++ libraries.
#include <benchmark/benchmark.h>
#include <gslam/svar/detail/parse_number.h>
#include <gslam/svar/detail/print_number.h>

#include <cinttypes>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#if __cplusplus >= 201703L && defined(__has_include)
#if __has_include(<charconv>)
#include <charconv>
#endif
#endif

namespace {

constexpr std::size_t kCount = 4096;  // more than a branch predictor learns by heart
constexpr std::size_t kRoom = 40;     // for the text of one number

// --- the numbers, and how the texts are written that are parsed

template <class Distribution>
std::vector<typename Distribution::result_type> draw(Distribution distribution) {
  std::mt19937_64 random(1);
  std::vector<typename Distribution::result_type> made(kCount);
  for (typename Distribution::result_type& value : made) value = distribution(random);
  return made;
}

struct FullDoubles {  // of every magnitude that sensors and maps have
  static const char* format() { return "%.17g"; }
  static std::vector<double> make() {
    std::vector<double> made = draw(std::uniform_real_distribution<double>(-1, 1));
    for (std::size_t i = 0; i < made.size(); ++i) {
      for (std::size_t tens = i % 13; tens > 0; --tens) made[i] *= 10;
      made[i] *= 1e-4;
    }
    return made;
  }
};

struct BitPatterns {
  static const char* format() { return "%.17g"; }
  static std::vector<double> make() {
    std::vector<double> made;
    for (const std::uint64_t bits :
         draw(std::uniform_int_distribution<std::uint64_t>(1, gslam::detail::kInfinityBits - 1))) {
      made.push_back(gslam::detail::doubleOf(bits));
    }
    return made;
  }
};

struct ShortDecimals {
  static const char* format() { return "%.2f"; }
  static std::vector<double> make() {
    std::vector<double> made;
    for (const int hundredths : draw(std::uniform_int_distribution<int>(-99999, 99999))) {
      made.push_back(hundredths / 100.0);
    }
    return made;
  }
};

struct Seconds {  // time stamps of TUM
  static const char* format() { return "%.6f"; }
  static std::vector<double> make() {
    return draw(std::uniform_real_distribution<double>(1300000000, 1600000000));
  }
};

struct SmallIntegers {
  static const char* format() { return "%" PRId64; }
  static std::vector<std::int64_t> make() {
    return draw(std::uniform_int_distribution<std::int64_t>(-9999, 9999));
  }
};

struct Nanoseconds {  // time stamps of EuRoC
  static const char* format() { return "%" PRId64; }
  static std::vector<std::int64_t> make() {
    return draw(
        std::uniform_int_distribution<std::int64_t>(1300000000000000000, 1600000000000000000));
  }
};

// One text, as in a file: each number is followed by a comma.
struct Texts {
  template <class T>
  Texts(const std::vector<T>& values, const char* format) {
    for (const T value : values) {
      char number[kRoom];
      std::snprintf(number, sizeof(number), format, value);
      begins.push_back(text.size());
      text += number;
      text += ',';
    }
  }

  std::string text;
  std::vector<std::size_t> begins;
};

// --- who is measured: each reads a double and an int64, and writes them

struct Gslam {
  static double real(const char* begin, const char* end) {
    return gslam::detail::parseNumber(begin, end).real;
  }
  static std::int64_t integer(const char* begin, const char* end) {
    return gslam::detail::parseNumber(begin, end).integer;
  }
  static std::size_t print(double value, char* out) {
    return gslam::detail::printDouble(value, out);
  }
  static std::size_t print(std::int64_t value, char* out) {
    return gslam::detail::printInt64(value, out);
  }
};

struct CLibrary {
  static double real(const char* begin, const char* /*end*/) { return std::strtod(begin, nullptr); }
  static std::int64_t integer(const char* begin, const char* /*end*/) {
    return std::strtoll(begin, nullptr, 10);
  }
  static std::size_t print(double value, char* out) {
    return static_cast<std::size_t>(std::snprintf(out, kRoom, "%.17g", value));
  }
  static std::size_t print(std::int64_t value, char* out) {
    return static_cast<std::size_t>(std::snprintf(out, kRoom, "%" PRId64, value));
  }
};

#ifdef __cpp_lib_to_chars
struct CppLibrary {
  static double real(const char* begin, const char* end) {
    double value = 0;
    std::from_chars(begin, end, value);
    return value;
  }
  static std::int64_t integer(const char* begin, const char* end) {
    std::int64_t value = 0;
    std::from_chars(begin, end, value);
    return value;
  }
  template <class T>
  static std::size_t print(T value, char* out) {
    return static_cast<std::size_t>(std::to_chars(out, out + kRoom, value).ptr - out);
  }
};
#endif

// --- what is measured: the time of all kCount numbers

template <class Library>
void readOne(const char* begin, const char* end, double& value) {
  value = Library::real(begin, end);
}
template <class Library>
void readOne(const char* begin, const char* end, std::int64_t& value) {
  value = Library::integer(begin, end);
}

template <class Library, class Numbers>
void parse(benchmark::State& state) {
  auto values = Numbers::make();
  const Texts texts(values, Numbers::format());
  const char* const text = texts.text.data();
  const char* const end = text + texts.text.size();
  for (auto _ : state) {
    for (const std::size_t begin : texts.begins) {
      readOne<Library>(text + begin, end, values[0]);
      benchmark::DoNotOptimize(values[0]);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
}

template <class Library, class Numbers>
void print(benchmark::State& state) {
  const auto values = Numbers::make();
  char text[kRoom];
  for (auto _ : state) {
    for (const auto value : values) {
      benchmark::DoNotOptimize(Library::print(value, text));
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kCount));
}

#define MEASURE(numbers, Numbers, library, Library)                       \
  BENCHMARK(parse<Library, Numbers>)->Name("parse_" numbers "/" library); \
  BENCHMARK(print<Library, Numbers>)->Name("print_" numbers "/" library)

#define MEASURE_ALL(library, Library)                         \
  MEASURE("full_doubles", FullDoubles, library, Library);     \
  MEASURE("bit_patterns", BitPatterns, library, Library);     \
  MEASURE("short_decimals", ShortDecimals, library, Library); \
  MEASURE("seconds", Seconds, library, Library);              \
  MEASURE("small_integers", SmallIntegers, library, Library); \
  MEASURE("nanoseconds", Nanoseconds, library, Library)

MEASURE_ALL("gslam", Gslam);
MEASURE_ALL("c_library", CLibrary);
#ifdef __cpp_lib_to_chars
MEASURE_ALL("charconv", CppLibrary);
#endif

}  // namespace
