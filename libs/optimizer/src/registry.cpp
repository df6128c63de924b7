#include "registry.h"

#include <gslam/base/error.h>

#include <algorithm>
#include <utility>

namespace gslam {
inline namespace v1 {
namespace detail {
namespace {

// The fast one first, then the one that everybody trusts, then in the order of registration.
int rankOfBackend(const std::string& name) {
  return name == "pba" ? 0 : name == "ceres" ? 1 : 2;
}

std::string listOfNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

constexpr const char* kHowToGetOne =
    "include gslam/optimizer_pba.h and link GSLAM::optimizer_pba (or gslam/optimizer_ceres.h and "
    "GSLAM::optimizer_ceres)";

}  // namespace

BackendRegistry::BackendRegistry() {
  lists_.push_back(std::make_unique<const List>());
  list_.store(lists_.back().get(), std::memory_order_release);
}

BackendRegistry& BackendRegistry::instance() {
  // Never destroyed: destructors of other static objects may still solve problems.
  static BackendRegistry& registry = *new BackendRegistry();
  return registry;
}

void BackendRegistry::add(const OptimizerBackend& backend) {
  auto copy = std::make_unique<const OptimizerBackend>(backend);
  const std::lock_guard<std::mutex> lock(mutex_);
  auto next = std::make_unique<List>(list());
  const auto same = std::find_if(next->begin(), next->end(), [&](const OptimizerBackend* other) {
    return other->name == backend.name;
  });
  if (same != next->end()) {
    *same = copy.get();
  } else {
    const int rank = rankOfBackend(backend.name);
    next->insert(std::find_if(next->begin(), next->end(),
                              [&](const OptimizerBackend* other) {
                                return rankOfBackend(other->name) > rank;
                              }),
                 copy.get());
  }
  lists_.reserve(lists_.size() + 1);  // nothing may throw between the two
  backends_.push_back(std::move(copy));
  lists_.push_back(std::move(next));
  list_.store(lists_.back().get(), std::memory_order_release);
}

void refuseBackend(const std::string& wanted, const char* problem,
                   const std::vector<std::string>& can) {
  const std::vector<std::string> all = optimizerBackends();
  const std::string value = wanted.empty() ? "is empty" : "is \"" + wanted + "\"";
  if (all.empty()) {
    throw ArgumentError("options.backend", value + ", and no back end is there: " + kHowToGetOne);
  }
  if (!wanted.empty() && std::find(all.begin(), all.end(), wanted) == all.end()) {
    throw ArgumentError("options.backend", value + ", expected one of " + listOfNames(all) +
                                               "; for others " + kHowToGetOne);
  }
  const std::string others =
      can.empty() ? "none of those that are there can (" + listOfNames(all) + "): " + kHowToGetOne
                  : "expected one of " + listOfNames(can);
  throw ArgumentError("options.backend",
                      (wanted.empty() ? value + ", to solve " + problem + ": "
                                      : value + ", which cannot solve " + problem + "; ") +
                          others);
}

}  // namespace detail

bool registerOptimizerBackend(const OptimizerBackend& backend) {
  if (backend.name.empty()) {
    throw ArgumentError("backend.name", "is empty, expected a name such as \"pba\"");
  }
  detail::BackendRegistry::instance().add(backend);
  return true;
}

std::vector<std::string> optimizerBackends() {
  std::vector<std::string> names;
  for (const OptimizerBackend* backend : detail::BackendRegistry::instance().list()) {
    names.push_back(backend->name);
  }
  return names;
}

}  // namespace v1
}  // namespace gslam
