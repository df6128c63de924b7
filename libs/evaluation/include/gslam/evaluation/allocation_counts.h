#ifndef GSLAM_EVALUATION_ALLOCATION_COUNTS_H
#define GSLAM_EVALUATION_ALLOCATION_COUNTS_H

#include <gslam/evaluation/export.h>

#include <cstdint>
#include <string>

/// @file
/// What a program asks of malloc().
///
/// Counted only in programs that ask for it where they are linked:
///
///     target_link_libraries(my_program PRIVATE GSLAM::evaluation GSLAM::evaluation_malloc)
///
/// GSLAM::evaluation_malloc has a malloc(), calloc(), realloc(), free(), aligned_alloc(),
/// memalign(), posix_memalign(), valloc() and pvalloc() that count and hand on to those of glibc;
/// operator new and all libraries and plugins use them, too. A malloc/free pair takes about 10 ns
/// longer. Not with a sanitizer, which has a malloc() of its own, nor with another C library; one
/// of them that the compiler does not tell of, such as -fsanitize=leak, does not work with it.
/// Where another malloc() is preloaded, such as jemalloc, it is glibc's nevertheless that is used.

namespace gslam {
inline namespace v1 {

/// Blocks of memory since the begin of a process. What lives is right while nobody allocates: a
/// block that is given to another thread and freed meanwhile may be missed on one side.
///
/// Thread-safety: plain data.
struct AllocationCounts {
  bool is_counted = false;       ///< otherwise all others are 0 and mean nothing
  std::uint64_t calls = 0;       ///< that gave a block; a realloc() counts as one, and as a free
  std::uint64_t bytes = 0;       ///< that these asked for
  std::uint64_t frees = 0;       ///< of blocks
  std::int64_t live_blocks = 0;  ///< not freed yet
  std::int64_t live_bytes = 0;   ///< of these, as large as they are (malloc_usable_size())
  std::int64_t peak_live_bytes = 0;  ///< most of it, to within 64 KiB for each thread
};

/// What was done from one count to a later one (never below 0); what lives and its peak are as in
/// the later: since the begin of the processes.
GSLAM_EVALUATION_EXPORT AllocationCounts allocatedBetween(const AllocationCounts& earlier,
                                                          const AllocationCounts& later);

/// Of this process alone. Thread-safe, allocates nothing, about 0.1 us; calls that other threads
/// are in meanwhile may count or not.
GSLAM_EVALUATION_EXPORT AllocationCounts allocationCounts() noexcept;

/// Has the processes that this one starts from now on counted for allocationCountsOf(), where they
/// are programs that count, such as an IsolatedSlam of a program that does: they inherit an open
/// file, and its number in the environment (GSLAM_ALLOCATION_COUNTS). Where this process inherited
/// one itself, it is that one, so that whoever started this one sees all. To be called before there
/// are threads that may use the environment; again does nothing.
/// @return whether it can be done: on Linux
GSLAM_EVALUATION_EXPORT bool countAllocationsOfChildren();

/// Of a process and all that descend from it, this one or one started after
/// countAllocationsOfChildren(); those that ended count, what lived at their end lives, and the
/// peak is the sum of their peaks. A forked child begins at 0. Descendants that do not count
/// (another program) are not in it, nor what descends from such. `is_counted` says whether the
/// process itself counts.
///
/// Any number of processes may come and go: the counts of those that ended are their parents'
/// sooner or later, the last few of them can still be asked for. Of more than 1023 at a time the
/// last are not counted. To be counted, a start or a fork() takes about 0.1 ms longer.
///
/// Thread-safe, allocates nothing. About 1 us, and 0.1 us for each descendant.
/// @param process  its number; 0: this one, also where that is the IsolatedSlam::processNumber() of
///   one that has ended
GSLAM_EVALUATION_EXPORT AllocationCounts allocationCountsOf(long process) noexcept;

/// Why allocations of this process are not counted, for reports; empty where they are.
GSLAM_EVALUATION_EXPORT std::string whyNoAllocations();

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_ALLOCATION_COUNTS_H
