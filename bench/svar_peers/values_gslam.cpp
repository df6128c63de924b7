#include <gslam/svar.h>
#include <gslam/svar/config.h>

#include <memory>

#include "values.h"

namespace {

using gslam::Svar;

Svar parameters() {
  Svar made = Svar::object();
  for (const std::string& name : names()) made.set(name, 1.5);
  return made;
}

void lookUp(benchmark::State& state) {
  Svar value = parameters();
  lookUpEach(state, [&](const std::string& name) {
    benchmark::DoNotOptimize(value);
    return value.get<double>(name);
  });
}
BENCHMARK(lookUp)->Name("lookup_by_name/gslam");

void getNested(benchmark::State& state) {
  Svar value = parameters();
  value.set("a.b.c", 2.5);
  repeat(state, [&] {
    benchmark::DoNotOptimize(value);
    return value.get<double>("a.b.c");
  });
}
BENCHMARK(getNested)->Name("get_double_a_b_c/gslam");

void lookUpShared(benchmark::State& state) {
  gslam::SharedSvar tree(parameters());
  lookUpEach(state, [&](const std::string& name) { return tree.get<double>(name); });
}
BENCHMARK(lookUpShared)->Name("lookup_by_name_shared/gslam");

void readBound(benchmark::State& state) {
  gslam::SharedSvar tree(parameters());
  const auto& variable = tree.bind<double>("mapper_scale");
  repeat(state, [&] { return variable.get(); });
}
BENCHMARK(readBound)->Name("read_bound/gslam");

void call(benchmark::State& state) {
  Svar function = Svar::function([](int a, int b) { return a + b; });
  int a = 0;
  repeat(state, [&] {
    benchmark::DoNotOptimize(function);
    return function(++a, 2).as<int>();
  });
}
BENCHMARK(call)->Name("call_int_int_int/gslam");

void parse(benchmark::State& state) {
  const std::vector<std::string> all = arguments();
  std::vector<const char*> argv;
  for (const std::string& one : all) argv.push_back(one.c_str());
  gslam::Config config("program", "", "");
  for (int i = 0; i < 20; ++i) {
    const std::string name = "p" + std::to_string(i);
    if (i < 10) config.arg<double>(name, 0, "");
    if (i >= 10 && i < 15) config.arg<int>(name, 0, "");
    if (i >= 15) config.arg<std::string>(name, "", "");
  }
  repeat(state,
         [&] { return config.parse(static_cast<int>(argv.size()), argv.data()).rest.size(); });
}
BENCHMARK(parse)->Name("parse_20_arguments/gslam");

}  // namespace
