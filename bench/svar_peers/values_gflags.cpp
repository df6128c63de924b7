#include <gflags/gflags.h>

#include "values.h"

DEFINE_double(p0, 0, "");
DEFINE_double(p1, 0, "");
DEFINE_double(p2, 0, "");
DEFINE_double(p3, 0, "");
DEFINE_double(p4, 0, "");
DEFINE_double(p5, 0, "");
DEFINE_double(p6, 0, "");
DEFINE_double(p7, 0, "");
DEFINE_double(p8, 0, "");
DEFINE_double(p9, 0, "");
DEFINE_int32(p10, 0, "");
DEFINE_int32(p11, 0, "");
DEFINE_int32(p12, 0, "");
DEFINE_int32(p13, 0, "");
DEFINE_int32(p14, 0, "");
DEFINE_string(p15, "", "");
DEFINE_string(p16, "", "");
DEFINE_string(p17, "", "");
DEFINE_string(p18, "", "");
DEFINE_string(p19, "", "");

namespace {

// A plain variable: other threads may not change it.
void readFlag(benchmark::State& state) {
  repeat(state, [&] {
    benchmark::ClobberMemory();
    return FLAGS_p0;
  });
}
BENCHMARK(readFlag)->Name("read_bound/gflags");

// The only way by name gives text.
void lookUp(benchmark::State& state) {
  std::vector<std::string> all;
  for (int i = 0; i < 10; ++i) all.push_back("p" + std::to_string(i));
  std::string text;
  std::size_t i = 0;
  repeat(state, [&] {
    gflags::GetCommandLineOption(all[i].c_str(), &text);
    if (++i == all.size()) i = 0;
    return text.size();
  });
}
BENCHMARK(lookUp)->Name("lookup_by_name/gflags");

void parse(benchmark::State& state) {
  std::vector<std::string> all = arguments();
  repeat(state, [&] {
    std::vector<char*> argv;
    for (std::string& one : all) argv.push_back(&one[0]);
    int argc = static_cast<int>(argv.size());
    char** begin = argv.data();
    return gflags::ParseCommandLineNonHelpFlags(&argc, &begin, false);
  });
}
BENCHMARK(parse)->Name("parse_20_arguments/gflags");

}  // namespace
