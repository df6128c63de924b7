// Bytes that the process has in memory, from the system.
#ifndef GSLAM_CORE_TESTS_RESIDENT_BYTES_H
#define GSLAM_CORE_TESTS_RESIDENT_BYTES_H

#include <unistd.h>

#include <fstream>

inline long residentBytes() {
  long pages = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * ::sysconf(_SC_PAGESIZE);
}

#endif  // GSLAM_CORE_TESTS_RESIDENT_BYTES_H
