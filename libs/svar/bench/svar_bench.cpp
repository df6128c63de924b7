// What reading, writing and copying cost. std::map stands beside the lookup as a known measure.
#include <benchmark/benchmark.h>
#include <gslam/svar.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace {

using gslam::Svar;

std::vector<std::string> names(std::int64_t count) {
  std::vector<std::string> made;
  for (std::int64_t i = 0; i < count; ++i) made.push_back("parameter_" + std::to_string(i));
  return made;
}

Svar object(const std::vector<std::string>& members) {
  Svar made = Svar::object();
  for (const std::string& name : members) made.set(name, 1.5);
  return made;
}

void lookup(benchmark::State& state) {
  const std::vector<std::string> all = names(state.range(0));
  Svar value = object(all);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(value);  // may have changed, for all the compiler knows
    benchmark::DoNotOptimize(value[all[i]]);
    if (++i == all.size()) i = 0;
  }
}
BENCHMARK(lookup)->Name("lookup_by_name/gslam")->Arg(8)->Arg(64)->Arg(1024);

void getByName(benchmark::State& state) {
  const std::vector<std::string> all = names(state.range(0));
  Svar value = object(all);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(value);
    benchmark::DoNotOptimize(value.get<double>(all[i]));
    if (++i == all.size()) i = 0;
  }
}
BENCHMARK(getByName)->Name("get_double_by_name/gslam")->Arg(8)->Arg(64)->Arg(1024);

void lookupInMap(benchmark::State& state) {
  const std::vector<std::string> all = names(state.range(0));
  std::map<std::string, double> value;
  for (const std::string& name : all) value[name] = 1.5;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(value);
    benchmark::DoNotOptimize(value.find(all[i])->second);
    if (++i == all.size()) i = 0;
  }
}
BENCHMARK(lookupInMap)->Name("lookup_by_name/std_map")->Arg(8)->Arg(64)->Arg(1024);

Svar config() {
  Svar made;
  made.set("a.b.c", 2.5);
  made.set("a.b.d", 1);
  made.set("a.x", "text");
  made.set("y", true);
  return made;
}

void getByPath(benchmark::State& state) {
  Svar value = config();
  for (auto _ : state) {
    benchmark::DoNotOptimize(value);
    benchmark::DoNotOptimize(value.get<double>("a.b.c"));
  }
}
BENCHMARK(getByPath)->Name("get_double_a_b_c/gslam");

void getByIndexing(benchmark::State& state) {
  Svar value = config();
  for (auto _ : state) {
    benchmark::DoNotOptimize(value);
    benchmark::DoNotOptimize(value["a"]["b"]["c"].as<double>());
  }
}
BENCHMARK(getByIndexing)->Name("get_double_a_b_c/gslam_by_operator");

void getDefault(benchmark::State& state) {
  Svar value = config();
  for (auto _ : state) {
    benchmark::DoNotOptimize(value);
    benchmark::DoNotOptimize(value.get<double>("a.b.e", 1.0));
  }
}
BENCHMARK(getDefault)->Name("get_missing_with_default/gslam");

void setByPath(benchmark::State& state) {
  Svar value = config();
  double next = 0;
  for (auto _ : state) {
    value.set("a.b.c", next += 1);
    benchmark::DoNotOptimize(value);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(setByPath)->Name("set_double_a_b_c/gslam");

void build(benchmark::State& state) {
  const std::vector<std::string> all = names(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(object(all));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(build)->Name("build_object/gslam")->Arg(8)->Arg(1024);

void cloneObject(benchmark::State& state) {
  const Svar value = object(names(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(value.clone());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(cloneObject)->Name("clone_object/gslam")->Arg(1024);

void sumArray(benchmark::State& state) {
  Svar list = Svar::array();
  for (int i = 0; i < 1024; ++i) list.push_back(i);
  for (auto _ : state) {
    benchmark::DoNotOptimize(list);
    std::int64_t sum = 0;
    for (const Svar& element : list) sum += element.as<std::int64_t>();
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * 1024);
}
BENCHMARK(sumArray)->Name("sum_array_of_1024/gslam");

}  // namespace
