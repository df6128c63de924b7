// What YAML and XML cost, beside yaml-cpp and pugixml alone: the ratio is what our layer adds.
#include <benchmark/benchmark.h>
#include <gslam/svar_formats.h>
#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <pugixml.hpp>
#include <random>
#include <string>

namespace {

using gslam::Svar;

Svar config() {
  return Svar::object({{"fps", 30},
                       {"camera", Svar::object({{"model", "pinhole"},
                                                {"k", Svar::array({535.4, 539.2, 320.1, 247.6})},
                                                {"size", Svar::array({640, 480})}})},
                       {"tracker", Svar::object({{"features", 1000}, {"scale", 1.2}})},
                       {"dataset", "rgbd_dataset_freiburg1_xyz"},
                       {"realtime", false}});
}

Svar manyConfigs() {
  Svar list = Svar::array();
  for (int i = 0; i < 1000; ++i) list.push_back(config());
  return Svar::object({{"configs", list}});
}

Svar manyNumbers() {
  std::mt19937 random;
  Svar list = Svar::array();
  for (int i = 0; i < 50000; ++i) {
    list.push_back(1e-4 * static_cast<double>(static_cast<int>(random() % 100000) - 50000));
  }
  return Svar::object({{"data", list}});
}

// Runs `call`, which takes a text of that size or returns it.
template <class F>
void measure(benchmark::State& state, std::size_t size, F call) {
  for (auto _ : state) call();
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(size));
}

void yamlParse(benchmark::State& state, const Svar& value) {
  const std::string text = gslam::printYaml(value);
  measure(state, text.size(), [&] { benchmark::DoNotOptimize(gslam::parseYaml(text)); });
}

void yamlParseAlone(benchmark::State& state, const Svar& value) {
  const std::string text = gslam::printYaml(value);
  measure(state, text.size(), [&] { benchmark::DoNotOptimize(YAML::Load(text)); });
}

void yamlPrint(benchmark::State& state, const Svar& value) {
  const std::size_t size = gslam::printYaml(value).size();
  measure(state, size, [&] { benchmark::DoNotOptimize(gslam::printYaml(value).data()); });
}

void yamlPrintAlone(benchmark::State& state, const Svar& value) {
  const std::string text = gslam::printYaml(value);
  const YAML::Node node = YAML::Load(text);
  measure(state, text.size(), [&] { benchmark::DoNotOptimize(YAML::Dump(node).data()); });
}

void xmlParse(benchmark::State& state, const Svar& value) {
  const std::string text = gslam::printXml(value);
  measure(state, text.size(), [&] { benchmark::DoNotOptimize(gslam::parseXml(text)); });
}

void xmlParseAlone(benchmark::State& state, const Svar& value) {
  const std::string text = gslam::printXml(value);
  measure(state, text.size(), [&] {
    pugi::xml_document document;
    benchmark::DoNotOptimize(document.load_buffer(text.data(), text.size()));
  });
}

void xmlPrint(benchmark::State& state, const Svar& value) {
  const std::size_t size = gslam::printXml(value).size();
  measure(state, size, [&] { benchmark::DoNotOptimize(gslam::printXml(value).data()); });
}

#define ALL(name, ...)                                                                         \
  BENCHMARK_CAPTURE(yamlParse, name, __VA_ARGS__)->Name("yaml_parse_" #name "/gslam");         \
  BENCHMARK_CAPTURE(yamlParseAlone, name, __VA_ARGS__)->Name("yaml_parse_" #name "/yaml-cpp"); \
  BENCHMARK_CAPTURE(yamlPrint, name, __VA_ARGS__)->Name("yaml_print_" #name "/gslam");         \
  BENCHMARK_CAPTURE(yamlPrintAlone, name, __VA_ARGS__)->Name("yaml_print_" #name "/yaml-cpp"); \
  BENCHMARK_CAPTURE(xmlParse, name, __VA_ARGS__)->Name("xml_parse_" #name "/gslam");           \
  BENCHMARK_CAPTURE(xmlParseAlone, name, __VA_ARGS__)->Name("xml_parse_" #name "/pugixml");    \
  BENCHMARK_CAPTURE(xmlPrint, name, __VA_ARGS__)->Name("xml_print_" #name "/gslam")

ALL(config, config());
ALL(1000_configs, manyConfigs());
ALL(50000_numbers, manyNumbers());

}  // namespace
