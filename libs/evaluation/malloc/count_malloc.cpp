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
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(__SANITIZE_HWADDRESS__)
#define GSLAM_DETAIL_HAS_SANITIZER 1
#endif

#if defined(__linux__) && defined(__GLIBC__) && !defined(GSLAM_DETAIL_HAS_SANITIZER)

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>

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
using gslam_allocations::Ended;
using gslam_allocations::FileHeader;
using gslam_allocations::kMaker;
using gslam_allocations::kTables;
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

// The file that this process inherited; -1: none.
int inheritedFile() {
  const char* const text = getenv(gslam_allocations::kVariable);  // NOLINT(concurrency-mt-unsafe)
  if (text == nullptr) return -1;
  char* end = nullptr;
  const long file = strtol(text, &end, 10);
  if (end == text || *end != ':' || file < 0 || file > 1000000) return -1;
  const unsigned long long inode = strtoull(end + 1, &end, 10);
  struct stat facts;
  const bool is_it = *end == '\0' && fstat(int(file), &facts) == 0 && facts.st_ino == inode &&
                     std::size_t(facts.st_size) == gslam_allocations::kFileSize &&
                     std::size_t(sysconf(_SC_PAGESIZE)) <= sizeof(Table);
  return is_it ? int(file) : -1;
}

// When this process began, ticks: with its number, which one it is, whatever program it runs. 0:
// not known.
std::uint64_t startOfProcess() {
  const int file = open("/proc/self/stat", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  char text[1024];
  const ssize_t size = read(file, text, sizeof text - 1);
  close(file);
  text[std::max<ssize_t>(size, 0)] = '\0';
  const char* at = strrchr(text, ')');  // ends the name; the state behind it is field 3
  for (int field = 2; at != nullptr && field < 22; ++field) at = strchr(at + 1, ' ');
  return at == nullptr ? 0 : strtoull(at, nullptr, 10);
}

// Of a process that holds it and was stopped nobody waits for ever.
bool lock(int file, short kind) {
  struct flock how = {};
  how.l_type = kind;
  how.l_whence = SEEK_SET;
  for (int i = 0; i < 10000; ++i) {
    if (fcntl(file, F_SETLK, &how) == 0) return true;
    usleep(100);
  }
  return false;
}

void add(Ended& sum, const Ended& more) {
  Counter* const to = &sum.calls;
  const Counter* const from = &more.calls;
  for (int i = 0; i < 6; ++i) to[i].fetch_add(from[i].load(kRelaxed), kRelaxed);
}

// What a table that nobody writes any more has counted, with what had ended before it.
void addAll(Ended& sum, const Table& of) {
  const std::uint64_t used =
      std::min<std::uint64_t>(of.used_slots.load(), gslam_allocations::kSlots);
  for (std::uint64_t i = 0; i < used; ++i) {
    const Slot& one = of.slots[i];
    sum.calls.fetch_add(one.calls.load(kRelaxed), kRelaxed);
    sum.bytes.fetch_add(one.bytes.load(kRelaxed), kRelaxed);
    sum.frees.fetch_add(one.frees.load(kRelaxed), kRelaxed);
    sum.given.fetch_add(one.given.load(kRelaxed), kRelaxed);
    sum.taken.fetch_add(one.taken.load(kRelaxed), kRelaxed);
  }
  sum.peak.fetch_add(of.peak.load(kRelaxed), kRelaxed);
  add(sum, of.ended);
}

off_t offsetOf(std::uint64_t index) {
  return off_t((index + 1) * sizeof(Table));
}

bool makeEmpty(int file, std::uint64_t index) {
  return fallocate(file, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, offsetOf(index),
                   sizeof(Table)) == 0;
}

// A process is gone: what it counted is its parent's, and so are its children.
bool giveToParent(FileHeader* header, int file, std::uint64_t index) {
  Table* const tables = gslam_allocations::tablesOf(header);
  const std::uint64_t parent = header->entries[index].parent.load();
  if (parent == kMaker) addAll(header->ended, tables[index]);
  if (parent > 0 && parent < kMaker) addAll(tables[parent - 1].ended, tables[index]);
  for (std::uint64_t i = 0; i < header->used.load(); ++i) {
    if (header->entries[i].parent.load() == index + 1) header->entries[i].parent.store(parent);
  }
  header->entries[index].process.store(0);
  return makeEmpty(file, index);
}

// The table of the process that is gone longest; kTables: all live.
std::uint64_t oldestEnded(const FileHeader* header) {
  std::uint64_t oldest = kTables;
  for (std::uint64_t i = 0; i < header->used.load(); ++i) {
    const auto& entry = header->entries[i];
    if (oldest < kTables && entry.order.load() > header->entries[oldest].order.load()) continue;
    const pid_t process = pid_t(entry.process.load());
    if (process == 0 || (kill(process, 0) != 0 && errno == ESRCH)) oldest = i;
  }
  return oldest;
}

// An empty table for this process, but for what it counted in a program that it ran before;
// kTables: there is none.
std::uint64_t claim(FileHeader* header, int file) {
  const std::uint64_t own = std::uint64_t(getpid()), start = startOfProcess();
  std::uint64_t index = kTables, used = std::min<std::uint64_t>(header->used.load(), kTables);
  for (std::uint64_t i = 0; i < used && index == kTables; ++i) {
    if (header->entries[i].process.load() == own) index = i;
  }
  if (index < kTables && header->entries[index].start.load() == start) {
    Table* const before = &gslam_allocations::tablesOf(header)[index];
    Ended sum = {};
    addAll(sum, *before);
    if (!makeEmpty(file, index)) return kTables;
    add(before->ended, sum);
    return index;
  }
  if (index == kTables && used >= gslam_allocations::kKept) index = oldestEnded(header);
  if (index < kTables && !giveToParent(header, file, index)) return kTables;
  if (index == kTables) index = used;
  if (index >= kTables) return kTables;
  const std::uint64_t parent = std::uint64_t(getppid());
  gslam_allocations::Entry& entry = header->entries[index];
  entry.parent.store(parent == header->maker.load() ? kMaker : 0);
  for (std::uint64_t i = 0; i < used; ++i) {
    if (header->entries[i].process.load() == parent) entry.parent.store(i + 1);
  }
  entry.start.store(start);
  entry.order.store(header->next_order.fetch_add(1));
  entry.process.store(own);
  header->used.store(std::max(used, index + 1));
  return index;
}

// Counts in the file from now on, with what was counted already or, forked, from 0.
bool moveTo(Table* shared, int file, std::uint64_t index, bool is_forked) {
  if (is_forked) {
    shared->is_shared.store(1, kRelaxed);
  } else {
    add(table.ended, shared->ended);
    table.is_shared.store(1, kRelaxed);
    const std::size_t size =
        offsetof(Table, slots) + std::size_t(table.used_slots.load()) * sizeof(Slot);
    if (pwrite(file, &table, size, offsetOf(index)) != ssize_t(size)) return false;
  }
  return mmap(&table, sizeof(Table), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file,
              offsetOf(index)) != MAP_FAILED;
}

// Writes the table where a process that started this one can see it. While there is one thread.
bool shareTable(bool is_forked) {
  const int file = inheritedFile();
  if (file < 0) return false;
  void* const mapped =
      mmap(nullptr, gslam_allocations::kFileSize, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (mapped == MAP_FAILED) return false;
  FileHeader* const header = static_cast<FileHeader*>(mapped);
  bool is_done = false;
  if (header->magic.load() == gslam_allocations::kMagic && lock(file, F_WRLCK)) {
    header->changes.store(header->changes.load() | 1);  // it may be odd: one died here
    const std::uint64_t index = claim(header, file);
    if (index < kTables) {
      is_done = moveTo(&gslam_allocations::tablesOf(header)[index], file, index, is_forked);
      if (!is_done) header->entries[index].process.store(0);
    }
    header->changes.fetch_add(1);
    lock(file, F_UNLCK);
  }
  munmap(mapped, gslam_allocations::kFileSize);
  if (!is_done && !is_forked) table.is_shared.store(0, kRelaxed);
  return is_done;
}

// A forked child is alone, and counts for itself: in a table of its own where its parent's can be
// seen, or else with a copy of the counts, in which slots of threads that it lacks are free.
void beginForkedChild() {
  const int problem = errno;
  const bool is_done = shareTable(true);
  errno = problem;
  if (is_done) {
    own_slot = nullptr;
    return;
  }
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

__attribute__((constructor)) void beginProgram() {
  const int problem = errno;
  shareTable(false);
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
