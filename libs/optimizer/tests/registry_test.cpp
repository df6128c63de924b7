#include <gmock/gmock.h>
#include <gslam/optimizer.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "backend_contract/scenes.h"

namespace {

using backend_contract::complaintOf;
using gslam::OptimizerBackend;
using gslam::OptimizerOptions;
using gslam::OptimizerSummary;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

OptimizerBackend bundleBackend(const std::string& name, double cost) {
  OptimizerBackend backend;
  backend.name = name;
  backend.bundle = [cost](const gslam::BundleProblem&, const OptimizerOptions&) {
    OptimizerSummary summary;
    summary.final_cost = cost;
    return summary;
  };
  return backend;
}

// The registry is one for the program, and tests run in an order of their own: this one needs it
// empty and goes through all of its life.
TEST(registry, asks_back_ends_in_order_and_names_them_in_errors) {
  auto scene = backend_contract::bundleScene(3, 10, 0);
  const auto solve = [&](const std::string& name) {
    OptimizerOptions options;
    options.backend = name;
    return optimizeBundle(scene.problem(), options);
  };
  if (gslam::optimizerBackends().empty()) {
    EXPECT_THAT(complaintOf([&] { solve(""); }),
                AllOf(HasSubstr("options.backend is empty"), HasSubstr("gslam/optimizer_pba.h"),
                      HasSubstr("GSLAM::optimizer_pba")));
  }
  EXPECT_TRUE(gslam::registerOptimizerBackend(bundleBackend("registry_b", 1)));
  gslam::registerOptimizerBackend(bundleBackend("registry_a", 2));
  gslam::registerOptimizerBackend(bundleBackend("ceres", 3));
  gslam::registerOptimizerBackend(bundleBackend("pba", 4));
  std::vector<std::string> mine;
  for (const std::string& name : gslam::optimizerBackends()) {
    if (name == "pba" || name == "ceres" || name.find("registry_") == 0) mine.push_back(name);
  }
  EXPECT_THAT(mine, ElementsAre("pba", "ceres", "registry_b", "registry_a"));
  EXPECT_EQ(gslam::optimizerBackends().front(), "pba");
  EXPECT_EQ(solve("").final_cost, 4);
  EXPECT_EQ(solve("").backend, "pba");
  EXPECT_EQ(solve("registry_a").final_cost, 2);

  // A back end of the same name takes the place of the old one, whatever it can do.
  OptimizerBackend other;
  other.name = "pba";
  gslam::registerOptimizerBackend(other);
  EXPECT_EQ(gslam::optimizerBackends().front(), "pba");
  EXPECT_EQ(solve("").final_cost, 3);
  EXPECT_THAT(complaintOf([&] { solve("pba"); }),
              AllOf(HasSubstr("options.backend is \"pba\", which cannot solve bundles"),
                    HasSubstr("expected one of ceres, "), HasSubstr("registry_b, registry_a")));
  EXPECT_THAT(complaintOf([&] { solve("pbb"); }),
              AllOf(HasSubstr("options.backend is \"pbb\", expected one of pba, ceres, "),
                    HasSubstr("gslam/optimizer_pba.h")));
  EXPECT_THAT(complaintOf([&] {
                auto graph = backend_contract::graphScene<gslam::SIM3d>(5, 0).graph;
                optimizePoseGraph(graph.problem());
              }),
              AllOf(HasSubstr("pose graphs of SIM3"), HasSubstr("none of those that are there")));
}

TEST(registry, refuses_a_back_end_without_a_name) {
  EXPECT_THAT(complaintOf([] { gslam::registerOptimizerBackend(OptimizerBackend()); }),
              HasSubstr("backend.name is empty"));
}

// For the thread sanitizer: solving goes on while others register, and replace what is in use.
TEST(registry, is_read_by_threads_while_others_register) {
  gslam::registerOptimizerBackend(bundleBackend("registry_threads", 7));
  std::atomic<int> writers(2);
  std::vector<std::thread> threads;
  for (int writer = 0; writer < 2; ++writer) {
    threads.emplace_back([&writers] {
      for (int i = 0; i < 50; ++i) {
        gslam::registerOptimizerBackend(bundleBackend("registry_threads", 7));
      }
      --writers;
    });
  }
  std::atomic<std::size_t> wrong(0);
  for (int reader = 0; reader < 2; ++reader) {
    threads.emplace_back([&writers, &wrong] {
      auto scene = backend_contract::bundleScene(2, 3, 0);
      OptimizerOptions options;
      options.backend = "registry_threads";
      do {
        if (optimizeBundle(scene.problem(), options).final_cost != 7) ++wrong;
        if (gslam::optimizerBackends().empty()) ++wrong;
      } while (writers != 0);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
