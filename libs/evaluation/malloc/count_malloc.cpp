// A malloc() that counts, for GSLAM::evaluation_malloc: hands on to that of glibc, whose manual
// ("Replacing malloc") lists the functions. They take no lock, so that they cannot be in the way of
// fork(), and may be called before main() and in the end of threads.
#include <cstddef>  // says whether this is glibc

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
#define GSLAM_DETAIL_HAS_SANITIZER 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GSLAM_DETAIL_HAS_SANITIZER 1
#endif

#if defined(__linux__) && defined(__GLIBC__) && !defined(GSLAM_DETAIL_HAS_SANITIZER)

#include <malloc.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>

#include "../src/allocation_table.h"

// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier): names of the C library
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void* __libc_valloc(std::size_t);
void* __libc_pvalloc(std::size_t);
void __libc_free(void*);
}

namespace {

using gslam_allocations::Counter;
using gslam_allocations::Slot;
using gslam_allocations::Table;

constexpr auto kRelaxed = std::memory_order_relaxed;

alignas(sizeof(Table)) Table table;
// Initial-exec: the place is there without an allocation.
__thread Slot* own_slot __attribute__((tls_model("initial-exec"))) = nullptr;
pthread_key_t at_thread_end;
std::atomic<bool> has_key(false);

bool isShared(const Slot* slot) {
  return slot == &table.slots[0];
}

void add(Slot* slot, Counter& counter, std::uint64_t value) {
  if (isShared(slot)) {
    counter.fetch_add(value, kRelaxed);
  } else {
    counter.store(counter.load(kRelaxed) + value, kRelaxed);
  }
}

__attribute__((noinline)) Slot* takeSlot() {
  own_slot = &table.slots[0];
  for (std::size_t i = 1; i < gslam_allocations::kSlots; ++i) {
    Counter& is_in_use = table.slots[i].is_in_use;
    std::uint64_t expected = 0;
    if (is_in_use.load(kRelaxed) != 0 ||
        !is_in_use.compare_exchange_strong(expected, 1, std::memory_order_acquire)) {
      continue;
    }
    own_slot = &table.slots[i];
    std::uint64_t used = table.used_slots.load(kRelaxed);
    while (used < i + 1 && !table.used_slots.compare_exchange_weak(used, i + 1)) {
    }
    if (has_key.load(std::memory_order_acquire)) pthread_setspecific(at_thread_end, own_slot);
    break;
  }
  return own_slot;
}

inline Slot* slot() {
  Slot* const own = own_slot;
  return __builtin_expect(own != nullptr, 1) ? own : takeSlot();
}

// Tells the table what is pending.
__attribute__((noinline)) void tell(Slot* slot, std::uint64_t pending) {
  const std::uint64_t live = table.live.fetch_add(pending, kRelaxed) + pending;
  std::uint64_t peak = table.peak.load(kRelaxed);
  while (std::int64_t(live) > std::int64_t(peak) &&
         !table.peak.compare_exchange_weak(peak, live, kRelaxed)) {
  }
  if (!isShared(slot)) slot->pending.store(0, kRelaxed);
}

inline void changeLive(Slot* slot, std::uint64_t change) {
  if (isShared(slot)) return tell(slot, change);
  const std::uint64_t pending = slot->pending.load(kRelaxed) + change;
  slot->pending.store(pending, kRelaxed);
  if (pending + gslam_allocations::kPending > 2 * gslam_allocations::kPending) tell(slot, pending);
}

inline void* given(void* block, std::size_t asked) {
  if (block == nullptr) return nullptr;
  const std::size_t size = malloc_usable_size(block);
  Slot* const own = slot();
  add(own, own->calls, 1);
  add(own, own->bytes, asked);
  add(own, own->given, size);
  changeLive(own, size);
  return block;
}

inline void taken(std::size_t size) {
  Slot* const own = slot();
  add(own, own->frees, 1);
  add(own, own->taken, size);
  changeLive(own, std::uint64_t(0) - size);
}

bool isPowerOfTwo(std::size_t number) {
  return number != 0 && (number & (number - 1)) == 0;
}

// The slot is the next thread's. What this one still does, in what ends after this, counts as that
// of threads without one.
void endThread(void* slot_of_thread) {
  Slot* const own = static_cast<Slot*>(slot_of_thread);
  own_slot = &table.slots[0];
  tell(own, own->pending.load(kRelaxed));
  own->is_in_use.store(0, std::memory_order_release);
}

// A forked child is alone, with a copy of the counts; slots of threads that it lacks are free.
void beginForkedChild() {
  if (table.is_shared.load(kRelaxed) != 0) {
    void* const copy =
        mmap(nullptr, sizeof(Table), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (copy == MAP_FAILED) return;
    __builtin_memcpy(copy, static_cast<const void*>(&table), sizeof(Table));
    mremap(copy, sizeof(Table), sizeof(Table), MREMAP_MAYMOVE | MREMAP_FIXED, &table);
    table.is_shared.store(0, kRelaxed);
  }
  for (std::size_t i = 1; i < table.used_slots.load(kRelaxed); ++i) {
    Slot* const one = &table.slots[i];
    if (one == own_slot) continue;
    tell(one, one->pending.load(kRelaxed));
    one->is_in_use.store(0, kRelaxed);
  }
}

// Writes the table where a process that started this one can see it. While there is one thread.
void shareTable() {
  const char* const text = getenv(gslam_allocations::kVariable);  // NOLINT(concurrency-mt-unsafe)
  if (text == nullptr) return;
  char* end = nullptr;
  const long file = strtol(text, &end, 10);
  if (end == text || *end != ':' || file < 0 || file > 1000000) return;
  const unsigned long long inode = strtoull(end + 1, &end, 10);
  struct stat facts;
  if (*end != '\0' || fstat(int(file), &facts) != 0 || facts.st_ino != inode ||
      std::size_t(facts.st_size) != gslam_allocations::kFileSize ||
      std::size_t(sysconf(_SC_PAGESIZE)) > sizeof(Table)) {
    return;
  }
  void* const mapped =
      mmap(nullptr, sizeof(Table), PROT_READ | PROT_WRITE, MAP_SHARED, int(file), 0);
  if (mapped == MAP_FAILED) return;
  gslam_allocations::FileHeader* const header = static_cast<gslam_allocations::FileHeader*>(mapped);
  std::uint64_t index = gslam_allocations::kTables;
  if (header->magic.load() == gslam_allocations::kMagic) index = header->next.fetch_add(1);
  munmap(mapped, sizeof(Table));
  if (index >= gslam_allocations::kTables) return;
  const off_t offset = off_t((index + 1) * sizeof(Table));
  table.is_shared.store(1, kRelaxed);
  table.parent.store(std::uint64_t(getppid()), kRelaxed);
  table.process.store(std::uint64_t(getpid()), kRelaxed);
  const std::size_t size = std::size_t(table.used_slots.load() + 1) * sizeof(Slot);
  if (pwrite(int(file), &table, size, offset) != ssize_t(size) ||
      mmap(&table, sizeof(Table), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, int(file),
           offset) == MAP_FAILED) {
    table.is_shared.store(0, kRelaxed);
  }
}

__attribute__((constructor)) void beginProgram() {
  const int problem = errno;
  shareTable();
  pthread_atfork(nullptr, nullptr, beginForkedChild);
  if (pthread_key_create(&at_thread_end, endThread) == 0) {
    has_key.store(true, std::memory_order_release);
  }
  errno = problem;
}

}  // namespace

extern "C" {

__attribute__((used)) Table* gslamAllocationTable() noexcept {
  return &table;
}

void* malloc(std::size_t size) noexcept {
  return given(__libc_malloc(size), size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  return given(__libc_calloc(count, size), count * size);
}

void* realloc(void* block, std::size_t size) noexcept {
  const std::size_t before = block == nullptr ? 0 : malloc_usable_size(block);
  void* const moved = __libc_realloc(block, size);
  const bool is_freed = moved != nullptr || size == 0;  // of 0 bytes glibc frees it
  if (block != nullptr && is_freed) taken(before);
  return given(moved, size);
}

void free(void* block) noexcept {
  if (block == nullptr) return;
  const std::size_t size = malloc_usable_size(block);
  __libc_free(block);
  taken(size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return given(__libc_memalign(alignment, size), size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  if (!isPowerOfTwo(alignment)) {
    errno = EINVAL;
    return nullptr;
  }
  return given(__libc_memalign(alignment, size), size);
}

int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  if (!isPowerOfTwo(alignment) || alignment % sizeof(void*) != 0) return EINVAL;
  const int before = errno;
  void* const block = given(__libc_memalign(alignment, size), size);
  errno = before;
  if (block == nullptr) return ENOMEM;
  *out = block;
  return 0;
}

void* valloc(std::size_t size) noexcept {
  return given(__libc_valloc(size), size);
}

void* pvalloc(std::size_t size) noexcept {
  return given(__libc_pvalloc(size), size);
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)

#endif
