// One measurement for all: the same documents, parsed into a value that owns what it holds (it is
// destroyed within the time), and printed to a std::string without spaces.
#ifndef GSLAM_BENCH_SVAR_PEERS_JSON_H
#define GSLAM_BENCH_SVAR_PEERS_JSON_H

#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

constexpr std::size_t kDocumentSize = 1 << 20;

/// Adds rows until the document is 1 MiB long.
/// @param row  gives the text of the next row
template <class Row>
std::string document(Row row) {
  std::string text = "[";
  while (text.size() < kDocumentSize) text += (text.size() > 1 ? ",\n" : "") + row();
  return text + "]\n";
}

/// A trajectory as in TUM files: a stamp with six decimals, position and quaternion with four.
inline std::string numbers() {
  std::mt19937 random;
  std::int64_t microseconds = 1305031102175304;
  return document([&] {
    std::string row;
    for (int i = 0; i < 7; ++i) {
      char number[16];
      const long digits = static_cast<long>(random() % (i < 3 ? 60000 : 20000)) - 10000;
      std::snprintf(number, sizeof(number), ", %.4f", 1e-4 * static_cast<double>(digits));
      row += number;
    }
    const std::string stamp =
        std::to_string(microseconds += 33000 + static_cast<int>(random() % 1000));
    return "[" + stamp.substr(0, 10) + "." + stamp.substr(10) + row + "]";
  });
}

/// Doubles with all the digits that they have, from -1 to 1.
inline std::string doubles() {
  std::mt19937_64 random;
  return document([&] {
    char number[32];
    std::snprintf(number, sizeof(number), "%.17g",
                  static_cast<double>(static_cast<std::int64_t>(random())) * 0x1p-63);
    return std::string(number);
  });
}

/// A list of files with notes: names, paths, escapes and text beyond ASCII.
inline std::string strings() {
  static const char* const notes[] = {
      "the left camera of the stereo pair, rectified",
      "short",
      "",
      "a line\\nand a \\\"quoted\\\" word, a path C:\\\\data and a tab\\t",
      "Größe und Maß: 752 × 480",
      "no loop was closed here, for the corridor looks the same on both floors of the building"};
  std::mt19937 random;
  return document([&] {
    const std::string number = std::to_string(random());
    return "{\"id\": \"" + number + "\", \"file\": \"rgb/" + number + "." + number +
           ".png\", \"kind\": \"image\", \"note\": \"" + notes[random() % 6] +
           "\", \"license\": \"Creative Commons 4.0 Attribution License (CC BY 4.0)\"}";
  });
}

/// @tparam Peer  has `void parse(const std::string& text)`, which drops the value that it makes;
///               `void keep(const std::string& text)`, which keeps it, and `std::size_t print()`,
///               which makes text of what was kept and gives its size
template <class Peer>
void parse(benchmark::State& state, std::string (*make)()) {
  const std::string text = make();
  Peer peer;
  for (auto _ : state) peer.parse(text);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

template <class Peer>
void print(benchmark::State& state, std::string (*make)()) {
  Peer peer;
  peer.keep(make());
  std::size_t size = 0;
  for (auto _ : state) size = peer.print();
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}

/// Registers all for one peer; to be called before main().
template <class Peer>
bool measure(const std::string& name) {
  const auto add = [&name](const char* what, auto function, std::string (*make)()) {
    benchmark::RegisterBenchmark((what + name).c_str(), function, make);
  };
  add("json_parse_numbers/", parse<Peer>, numbers);
  add("json_parse_full_doubles/", parse<Peer>, doubles);
  add("json_parse_strings/", parse<Peer>, strings);
  add("json_print_numbers/", print<Peer>, numbers);
  add("json_print_full_doubles/", print<Peer>, doubles);
  add("json_print_strings/", print<Peer>, strings);
  return true;
}

#endif  // GSLAM_BENCH_SVAR_PEERS_JSON_H
