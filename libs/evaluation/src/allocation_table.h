// Where counts of allocations stand: in memory that the counting malloc() writes, in this process
// or another, and the library reads.
#ifndef GSLAM_EVALUATION_SRC_ALLOCATION_TABLE_H
#define GSLAM_EVALUATION_SRC_ALLOCATION_TABLE_H

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace gslam_allocations {

using Counter = std::atomic<std::uint64_t>;

// Of one thread at a time, which alone writes it; a cache line.
struct Slot {
  Counter calls;      // that gave a block
  Counter bytes;      // that were asked for
  Counter frees;      // of blocks
  Counter given;      // bytes of blocks as large as they are
  Counter taken;      // bytes of these that were freed
  Counter pending;    // given - taken since the table was told, in two's complement
  Counter is_in_use;  // by a thread
  Counter unused;
};
static_assert(sizeof(Slot) == 64 && Counter::is_always_lock_free, "processes share it");

// Sums of what ended: its slots, and the peaks.
struct Ended {
  Counter calls, bytes, frees, given, taken, peak;
  Counter unused[2];
};

constexpr std::size_t kSlots = 1022;

// Counts of one process. Its size is a multiple of all page sizes, so that it can be mapped.
struct Table {
  Counter live;        // bytes that threads told of, in two's complement
  Counter peak;        // most of it
  Counter used_slots;  // the first so many
  Counter is_shared;   // whether another process can see it
  Counter unused[4];
  Ended ended;         // children whose tables are others' now, and what this process ran before
  Slot slots[kSlots];  // the first is for threads without one, which change it together
};
static_assert(sizeof(Table) == 65536, "a multiple of page sizes");

// Whose a table is.
struct Entry {
  Counter process;  // its number; 0: nobody's
  Counter start;    // when it began, as /proc/N/stat has it
  Counter parent;   // what started it: 1 + the index of its table, or kMaker; 0: not known
  Counter order;    // in which they came
};

// A file in memory: a header, and a table for each process. What changes the header or gives a
// table to another process has it locked (fcntl(2)); who reads, reads again when `changes` moved.
constexpr std::size_t kTables = 1023;
struct FileHeader {
  Counter magic;
  Counter maker;    // number of the process that made the file, which has no table in it
  Counter used;     // tables, of which some may be nobody's
  Counter changes;  // odd: one is made now
  Counter next_order;
  Counter unused[3];
  Ended ended;  // children of the maker whose tables are others' now
  Entry entries[kTables];
};
static_assert(sizeof(FileHeader) <= sizeof(Table), "it has the place of one");
constexpr std::uint64_t kMagic = 0x32434f4c4c414d53;
constexpr std::size_t kFileSize = (kTables + 1) * sizeof(Table);
constexpr std::uint64_t kMaker = kTables + 1;
// Tables of processes that are gone are given away from here on, the oldest first: with fewer, who
// started one can ask for its counts after its end.
constexpr std::uint64_t kKept = 32;

inline Table* tablesOf(FileHeader* header) {
  return reinterpret_cast<Table*>(reinterpret_cast<unsigned char*>(header) + sizeof(Table));
}

// In the environment of processes that are to be counted: "<number of the open file>:<its inode>".
constexpr const char* kVariable = "GSLAM_ALLOCATION_COUNTS";

// What is pending in a thread before it tells.
constexpr std::uint64_t kPending = 65536;

}  // namespace gslam_allocations

// Of this process; defined by the counting malloc(), and nowhere where that is not linked.
extern "C" gslam_allocations::Table* gslamAllocationTable() noexcept
    __attribute__((weak, visibility("default")));

#endif  // GSLAM_EVALUATION_SRC_ALLOCATION_TABLE_H
