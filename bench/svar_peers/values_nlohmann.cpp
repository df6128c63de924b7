#include <nlohmann/json.hpp>

#include "values.h"

namespace {

nlohmann::json parameters() {
  nlohmann::json made;
  for (const std::string& name : names()) made[name] = 1.5;
  return made;
}

void lookUp(benchmark::State& state) {
  nlohmann::json value = parameters();
  lookUpEach(state, [&](const std::string& name) {
    benchmark::DoNotOptimize(value);
    return value.value(name, 0.0);
  });
}
BENCHMARK(lookUp)->Name("lookup_by_name/nlohmann");

// Its only way by one text; the pointer is made ahead of time, as its users would.
void getNested(benchmark::State& state) {
  nlohmann::json value = parameters();
  const nlohmann::json::json_pointer pointer("/a/b/c");
  value[pointer] = 2.5;
  repeat(state, [&] {
    benchmark::DoNotOptimize(value);
    return value.at(pointer).get<double>();
  });
}
BENCHMARK(getNested)->Name("get_double_a_b_c/nlohmann");

}  // namespace
