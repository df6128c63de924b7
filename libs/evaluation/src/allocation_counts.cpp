#include <gslam/evaluation/allocation_counts.h>

#include <algorithm>

#if defined(__linux__)
#include <fcntl.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <mutex>

#include "allocation_table.h"
#endif

namespace gslam {
inline namespace v1 {

AllocationCounts allocatedBetween(const AllocationCounts& earlier, const AllocationCounts& later) {
  AllocationCounts done = later;
  done.calls -= std::min(done.calls, earlier.calls);
  done.bytes -= std::min(done.bytes, earlier.bytes);
  done.frees -= std::min(done.frees, earlier.frees);
  return done;
}

#if defined(__linux__)

namespace {

using gslam_allocations::Ended;
using gslam_allocations::FileHeader;
using gslam_allocations::kMaker;
using gslam_allocations::kTables;
using gslam_allocations::Slot;
using gslam_allocations::Table;

// So that whether something was changed meanwhile is read after all that it would change.
constexpr auto kOrdered = std::memory_order_acquire;

// The file that children inherit, mapped for good; null: there is none.
std::atomic<const unsigned char*> shared_file(nullptr);

const Table* ownTable() noexcept {
  return &gslamAllocationTable != nullptr ? gslamAllocationTable() : nullptr;
}

AllocationCounts countsOf(const Table& table) noexcept {
  AllocationCounts counts;
  counts.is_counted = true;
  std::uint64_t given = 0, taken = 0;
  const std::size_t used = std::size_t(table.used_slots.load(std::memory_order_acquire));
  for (std::size_t i = 0; i < std::min(used, gslam_allocations::kSlots); ++i) {
    const Slot& slot = table.slots[i];
    counts.calls += slot.calls.load(kOrdered);
    counts.bytes += slot.bytes.load(kOrdered);
    counts.frees += slot.frees.load(kOrdered);
    given += slot.given.load(kOrdered);
    taken += slot.taken.load(kOrdered);
  }
  counts.live_blocks = std::int64_t(counts.calls - counts.frees);
  counts.live_bytes = std::int64_t(given - taken);
  counts.peak_live_bytes = std::int64_t(table.peak.load(kOrdered));
  return counts;
}

AllocationCounts countsOf(const Ended& ended) noexcept {
  AllocationCounts counts;
  counts.calls = ended.calls.load(kOrdered);
  counts.bytes = ended.bytes.load(kOrdered);
  counts.frees = ended.frees.load(kOrdered);
  counts.live_blocks = std::int64_t(counts.calls - counts.frees);
  counts.live_bytes = std::int64_t(ended.given.load(kOrdered) - ended.taken.load(kOrdered));
  counts.peak_live_bytes = std::int64_t(ended.peak.load(kOrdered));
  return counts;
}

void add(AllocationCounts& sum, const AllocationCounts& more) noexcept {
  sum.calls += more.calls;
  sum.bytes += more.bytes;
  sum.frees += more.frees;
  sum.live_blocks += more.live_blocks;
  sum.live_bytes += more.live_bytes;
  sum.peak_live_bytes += more.peak_live_bytes;
}

const FileHeader& headerOf(const unsigned char* file) noexcept {
  return *reinterpret_cast<const FileHeader*>(file);
}

const Table& tableAt(const unsigned char* file, std::size_t index) noexcept {
  return *reinterpret_cast<const Table*>(file + (index + 1) * sizeof(Table));
}

// Whether a table is, or descends from, that of another; `root` is as Entry::parent.
bool descends(const FileHeader& header, std::size_t index, std::uint64_t root) noexcept {
  std::uint64_t at = index + 1;
  for (std::size_t depth = 0; depth < kTables && at > 0 && at <= kTables; ++depth) {
    if (at == root) return true;
    at = header.entries[at - 1].parent.load(kOrdered);
  }
  return at == root;
}

// As the tables stand, while nobody changes which process has which.
AllocationCounts sumOf(const unsigned char* file, std::uint64_t process,
                       std::uint64_t own) noexcept {
  const FileHeader& header = headerOf(file);
  const std::size_t used = std::size_t(std::min<std::uint64_t>(header.used.load(), kTables));
  std::uint64_t root = 0;
  for (std::size_t i = 0; i < used; ++i) {
    if (header.entries[i].process.load(kOrdered) == process) root = i + 1;
  }
  AllocationCounts sum;
  if (root == 0) {
    if (process != own) return sum;
    sum = allocationCounts();
    if (header.maker.load(kOrdered) != own) return sum;
    root = kMaker;
    add(sum, countsOf(header.ended));
  } else {
    sum.is_counted = true;
  }
  for (std::size_t i = 0; i < used; ++i) {
    const bool is_any = header.entries[i].process.load(kOrdered) != 0;
    if (!is_any || !descends(header, i, root)) continue;
    add(sum, countsOf(tableAt(file, i)));
    add(sum, countsOf(tableAt(file, i).ended));
  }
  return sum;
}

// The file that this process inherited itself, in which its children are counted, too; null where
// there is none.
const unsigned char* inheritedFile() {
  const char* const text = std::getenv(gslam_allocations::kVariable);  // NOLINT(concurrency-*)
  if (text == nullptr) return nullptr;
  char* end = nullptr;
  const long file = std::strtol(text, &end, 10);
  if (end == text || *end != ':' || file < 0 || file > 1000000) return nullptr;
  const unsigned long long inode = std::strtoull(end + 1, nullptr, 10);
  struct stat facts = {};
  if (::fstat(int(file), &facts) != 0 || facts.st_ino != inode ||
      std::size_t(facts.st_size) != gslam_allocations::kFileSize) {
    return nullptr;
  }
  void* const mapped =
      ::mmap(nullptr, gslam_allocations::kFileSize, PROT_READ, MAP_SHARED, int(file), 0);
  if (mapped == MAP_FAILED) return nullptr;
  const auto* const bytes = static_cast<const unsigned char*>(mapped);
  const bool is_one =
      reinterpret_cast<const FileHeader*>(bytes)->magic.load() == gslam_allocations::kMagic;
  if (!is_one) ::munmap(mapped, gslam_allocations::kFileSize);
  return is_one ? bytes : nullptr;
}

// Makes the file and says in the environment where it is; null where that cannot be done.
const unsigned char* makeSharedFile() {
  const int made = ::memfd_create("gslam allocation counts", MFD_ALLOW_SEALING);
  if (made < 0) return nullptr;
  const int file = ::fcntl(made, F_DUPFD, 10);  // below are those that programs give children
  ::close(made);
  if (file < 0) return nullptr;
  void* mapped = MAP_FAILED;
  struct stat facts = {};
  if (::ftruncate(file, off_t(gslam_allocations::kFileSize)) == 0 &&
      ::fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) == 0 && ::fstat(file, &facts) == 0) {
    mapped =
        ::mmap(nullptr, gslam_allocations::kFileSize, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  }
  const std::string place = std::to_string(file) + ':' + std::to_string(facts.st_ino);
  if (mapped == MAP_FAILED ||
      ::setenv(gslam_allocations::kVariable, place.c_str(), 1) != 0) {  // NOLINT(concurrency-*)
    if (mapped != MAP_FAILED) ::munmap(mapped, gslam_allocations::kFileSize);
    ::close(file);
    return nullptr;
  }
  static_cast<FileHeader*>(mapped)->maker.store(std::uint64_t(::getpid()));
  static_cast<FileHeader*>(mapped)->magic.store(gslam_allocations::kMagic);
  return static_cast<const unsigned char*>(mapped);
}

}  // namespace

AllocationCounts allocationCounts() noexcept {
  const Table* const table = ownTable();
  return table != nullptr ? countsOf(*table) : AllocationCounts();
}

bool countAllocationsOfChildren() {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  if (shared_file.load() == nullptr) shared_file.store(inheritedFile());
  if (shared_file.load() == nullptr) shared_file.store(makeSharedFile());
  return shared_file.load() != nullptr;
}

AllocationCounts allocationCountsOf(long process) noexcept {
  const long own = long(::getpid());
  if (process == 0) process = own;
  const unsigned char* const file = shared_file.load();
  if (file == nullptr) return process == own ? allocationCounts() : AllocationCounts();
  if (process < 0) return {};
  const FileHeader& header = headerOf(file);
  AllocationCounts sum;
  // One that died while it made a change is not waited for.
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t before = header.changes.load();
    sum = sumOf(file, std::uint64_t(process), std::uint64_t(own));
    if (before % 2 == 0 && header.changes.load() == before) break;
    ::sched_yield();
  }
  return sum;
}

std::string whyNoAllocations() {
  if (ownTable() != nullptr) return "";
  return "this program does not count them: it was not linked with GSLAM::evaluation_malloc, or "
         "built with a sanitizer";
}

#else

AllocationCounts allocationCounts() noexcept {
  return {};
}
bool countAllocationsOfChildren() {
  return false;
}
AllocationCounts allocationCountsOf(long) noexcept {
  return {};
}
std::string whyNoAllocations() {
  return "allocations are counted on Linux only";
}

#endif  // __linux__

}  // namespace v1
}  // namespace gslam
