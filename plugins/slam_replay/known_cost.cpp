#include "known_cost.h"

#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>
#include <thread>

namespace replay {
namespace {

// Calls that the compiler must not think it knows, or it would leave a malloc() and its free() out.
void* (*volatile const obtain)(std::size_t) = std::malloc;
void (*volatile const giveBack)(void*) = std::free;

std::chrono::nanoseconds cpuOfThread() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

void burnHere(std::chrono::nanoseconds cpu) {
  const std::chrono::nanoseconds end = cpuOfThread() + cpu;
  while (cpuOfThread() < end) {
  }
}

}  // namespace

KnownCost::KnownCost(const CostOptions& options) : options_(options) {
  blocks_.reserve(options.allocations);
}

void KnownCost::spend() {
  allocate();
  burn();
  grow();
}

// All at once, so that they are the blocks in use, too.
void KnownCost::allocate() {
  for (std::size_t i = 0; i < options_.allocations; ++i) {
    void* const block = obtain(options_.allocation_bytes);
    if (block == nullptr) break;
    blocks_.push_back(block);
  }
  const bool are_all = blocks_.size() == options_.allocations;
  for (void* const block : blocks_) giveBack(block);
  blocks_.clear();
  if (!are_all) throw std::bad_alloc();
}

void KnownCost::burn() const {
  if (options_.cpu.count() == 0) return;
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < options_.cpu_threads; ++i) {
    others.emplace_back([this] { burnHere(options_.cpu); });
  }
  burnHere(options_.cpu);
  for (std::thread& other : others) other.join();
}

// Touched, or it would take no memory.
void KnownCost::grow() {
  if (options_.grow_bytes == 0) return;
  kept_.emplace_back(new char[options_.grow_bytes]);
  std::memset(kept_.back().get(), 1, options_.grow_bytes);
}

}  // namespace replay
