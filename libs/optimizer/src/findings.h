#ifndef GSLAM_OPTIMIZER_SRC_FINDINGS_H
#define GSLAM_OPTIMIZER_SRC_FINDINGS_H

#include <gslam/base/error.h>
#include <gslam/base/span.h>
#include <gslam/optimizer/check.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "finite.h"

// Collecting what is wrong with a problem.

namespace gslam {
inline namespace v1 {
namespace detail {

// Things of one kind: the first, and how many.
struct Counted {
  std::size_t first = 0;
  std::size_t count = 0;

  void note(std::size_t index) noexcept {
    if (count++ == 0) first = index;
  }
};

// `field[index]`
inline std::string elementOf(const std::string& field, std::size_t index) {
  return field + "[" + std::to_string(index) + "]";
}

class Findings {
 public:
  void error(std::string field, std::string problem) {
    all_.push_back({true, std::move(field), std::move(problem)});
    ++errors_;
  }
  void warning(std::string field, std::string problem) {
    all_.push_back({false, std::move(field), std::move(problem)});
  }
  // The first of its kind, and the number of others; nothing where there is none.
  void errors(const std::string& field, const Counted& counted, const std::string& problem) {
    if (counted.count != 0) error(elementOf(field, counted.first), problem + others(counted));
  }
  void warnings(const std::string& field, const Counted& counted, const std::string& problem) {
    if (counted.count != 0) warning(elementOf(field, counted.first), problem + others(counted));
  }

  bool hasErrors() const noexcept { return errors_ != 0; }
  std::size_t errorCount() const noexcept { return errors_; }
  // Errors first, each kind in the order in which it was found.
  std::vector<ProblemFinding> take() {
    std::stable_partition(all_.begin(), all_.end(),
                          [](const ProblemFinding& finding) { return finding.is_error; });
    return std::move(all_);
  }

 private:
  static std::string others(const Counted& counted) {
    if (counted.count == 1) return "";
    return " (and " + std::to_string(counted.count - 1) +
           (counted.count == 2 ? " other of this kind)" : " others of this kind)");
  }

  std::vector<ProblemFinding> all_;
  std::size_t errors_ = 0;
};

// @throws ArgumentError with the first error, where there is one
inline void throwFirstError(const std::vector<ProblemFinding>& findings) {
  if (!findings.empty() && findings.front().is_error) {
    throw ArgumentError(findings.front().field, findings.front().problem);
  }
}

// Sizes that must agree: `name has 3 elements, expected 4 as of`.
inline void checkSize(Findings& findings, const char* name, std::size_t size, std::size_t expected,
                      const char* as, bool may_be_empty) {
  if (size == expected || (may_be_empty && size == 0)) return;
  findings.error(name, "has " + std::to_string(size) + " elements, expected " +
                           std::to_string(expected) + " as of " + as +
                           (may_be_empty ? ", or none" : ""));
}

inline void checkIndices(Findings& findings, const char* name, Span<const std::uint32_t> indices,
                         std::size_t size) {
  Counted bad;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= size) bad.note(i);
  }
  if (bad.count == 0) return;
  findings.errors(
      name, bad,
      "is " + std::to_string(indices[bad.first]) + ", expected below " + std::to_string(size));
}

template <class T>
void checkFinite(Findings& findings, const std::string& name, Span<const T> values) {
  Counted bad;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!isFinite(values[i])) bad.note(i);
  }
  findings.errors(name, bad, "is not finite");
}

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_OPTIMIZER_SRC_FINDINGS_H
