#include "opencv.h"

#include <cstdint>
#include <cstring>

#include "source_text.h"

namespace gslam {
namespace formats {

using detail::Text;

namespace {

const char kMatrix[] = "opencv-matrix";
const char kMatrixOfAnySize[] = "opencv-nd-matrix";

// More than there can be data, but far from overflow.
constexpr std::uint64_t kMany = std::uint64_t(1) << 62;

std::uint64_t product(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kMany / b ? kMany : a * b;
}

std::string found(const Svar& value) {
  switch (value.type()) {
    case SvarType::string:
      return ", found " + quoted(detail::SvarParts::text(value));
    case SvarType::integer:
      return ", found " + std::to_string(value.as<std::int64_t>());
    default:
      return std::string(", found a value of type ") + value.typeName();
  }
}

/// How many channels an element of that type has, such as 3 for "3f"; 0 where there is no such.
std::uint64_t channelCount(Text type) {
  std::uint64_t count = 0;
  const char* p = type.begin();
  for (; p != type.end() && detail::isDigit(*p); ++p) {
    if (count > 512 || (count == 0 && *p == '0')) return 0;
    count = count * 10 + static_cast<std::uint64_t>(*p - '0');
  }
  const bool has_letter = type.end() - p == 1 && std::strchr("ucwsifdh", *p) != nullptr;
  if (!has_letter || count > 512) return 0;
  return p == type.begin() ? 1 : count;
}

/// Collects the sizes of a matrix and the first problem.
class MatrixCheck {
 public:
  explicit MatrixCheck(const Svar& matrix) : matrix_(matrix) {}

  MatrixProblem check(bool any_size) {
    if (any_size) {
      checkSizes();
    } else {
      checkSize("rows", member("rows"));
      checkSize("cols", member("cols"));
    }
    checkType();
    checkData();
    return problem_;
  }

 private:
  Svar member(const char* name) const { return matrix_.contains(name) ? matrix_[name] : Svar(); }

  void fail(const char* name, const std::string& problem) {
    if (problem_.problem.empty()) problem_ = {name, problem};
  }

  void checkSize(const char* name, const Svar& size) {
    if (size.type() != SvarType::integer || size.as<std::int64_t>() < 0) {
      return fail(name, std::string("expected ") + name + " of 0 or more" + found(size));
    }
    count_ = product(count_, static_cast<std::uint64_t>(size.as<std::int64_t>()));
  }

  void checkSizes() {
    const Svar sizes = member("sizes");
    if (sizes.type() != SvarType::array || sizes.size() == 0) {
      return fail("sizes", "expected an array of sizes" + found(sizes));
    }
    for (const Svar& size : sizes) checkSize("sizes", size);
  }

  void checkType() {
    const Svar type = member("dt");
    const std::uint64_t channels =
        type.type() == SvarType::string ? channelCount(detail::SvarParts::text(type)) : 0;
    if (channels == 0) fail("dt", "expected a type such as d, f, u or 3f as dt" + found(type));
    count_ = product(count_, channels);
  }

  void checkData() {
    const Svar data = member("data");
    if (data.type() != SvarType::array)
      return fail("data", "expected an array as data" + found(data));
    for (const Svar& number : data) {
      if (number.type() == SvarType::integer || number.type() == SvarType::real) continue;
      return fail("data", "expected numbers as data" + found(number));
    }
    if (data.size() == count_) return;
    fail("data", "expected " + (count_ == kMany ? "far more" : std::to_string(count_)) +
                     " numbers as data, as of the size and type of the matrix, found " +
                     std::to_string(data.size()));
  }

  const Svar& matrix_;
  std::uint64_t count_ = 1;
  MatrixProblem problem_;
};

}  // namespace

bool isOpenCvMatrix(Text type) {
  return type == Text(kMatrix) || type == Text(kMatrixOfAnySize);
}

MatrixProblem checkOpenCvMatrix(Text type, const Svar& matrix) {
  return MatrixCheck(matrix).check(type == Text(kMatrixOfAnySize));
}

}  // namespace formats
}  // namespace gslam
