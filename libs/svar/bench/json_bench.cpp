// What JSON costs by the kind of content; against others: bench/svar_peers.
#include <benchmark/benchmark.h>
#include <gslam/svar.h>

#include <cstdint>
#include <random>
#include <string>

namespace {

using gslam::Svar;

Svar repeated(const Svar& part, int count) {
  Svar list = Svar::array();
  for (int i = 0; i < count; ++i) list.push_back(part);
  return list;
}

Svar randomNumbers(int count) {
  std::mt19937 random;
  Svar list = Svar::array();
  for (int i = 0; i < count; ++i) {
    list.push_back(1e-4 * static_cast<double>(static_cast<int>(random() % 100000) - 50000));
  }
  return list;
}

Svar config() {
  return Svar::object({{"fps", 30},
                       {"camera", Svar::object({{"model", "pinhole"},
                                                {"k", Svar::array({535.4, 539.2, 320.1, 247.6})},
                                                {"size", Svar::array({640, 480})}})},
                       {"tracker", Svar::object({{"features", 1000}, {"scale", 1.2}})},
                       {"dataset", "rgbd_dataset_freiburg1_xyz"},
                       {"realtime", false}});
}

Svar manyNames(int count) {
  Svar made = Svar::object();
  for (int i = 0; i < count; ++i) made.set("n" + std::to_string(i * 7919LL % count), i);
  return made;
}

Svar nested(int depth) {
  Svar value;
  for (int i = 0; i < depth; ++i) value = Svar::array({value});
  return value;
}

void parse(benchmark::State& state, const Svar& value, int indent = 0) {
  const std::string text = gslam::printJson(value, indent);
  for (auto _ : state) benchmark::DoNotOptimize(gslam::parseJson(text));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void print(benchmark::State& state, const Svar& value, int indent = 0) {
  std::size_t size = 0;
  for (auto _ : state) {
    const std::string text = gslam::printJson(value, indent);
    benchmark::DoNotOptimize(text.data());
    size = text.size();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}

#define BOTH(name, ...)                                                   \
  BENCHMARK_CAPTURE(parse, name, __VA_ARGS__)->Name("json_parse_" #name); \
  BENCHMARK_CAPTURE(print, name, __VA_ARGS__)->Name("json_print_" #name)

BOTH(config, config());
BOTH(1000_configs, repeated(config(), 1000));
BOTH(1000_configs_pretty, repeated(config(), 1000), 2);
BOTH(100000_decimals, randomNumbers(100000));
BOTH(100000_integers, repeated(123456, 100000));
BOTH(10000_names, manyNames(10000));
BOTH(text_of_1_MB, std::string(1000000, 'x'));
BOTH(text_beyond_ascii, repeated("\xE6\x97\xA5\xE6\x9C\xAC\xE8\xAA\x9E", 10000));
BOTH(control_characters, std::string(100000, '\n'));
BOTH(nested_500, nested(500));

}  // namespace
