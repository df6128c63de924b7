#include "fields.h"

#include <gslam/base/error.h>

#include <cmath>
#include <cstdint>

namespace gslam {
inline namespace v1 {
namespace calibration {
namespace {

// Files have matrices with six digits, which are no rotations to the last bit.
constexpr double kMatrixTolerance = 1e-3;

}  // namespace

const Svar* Fields::find(const std::string& name) const {
  if (!isObject()) return nullptr;
  for (const Svar::Member& member : value_.members()) {
    if (member.first == prefix_ + name) return member.second.isNull() ? nullptr : &member.second;
  }
  return nullptr;
}

Fields Fields::operator[](const std::string& name) const {
  const Svar* const found = find(name);
  if (found == nullptr) failMissing(name);
  return Fields(*found, source_, (path_.empty() ? "" : path_ + " / ") + prefix_ + name);
}

Fields Fields::section(const std::string& name) const {
  if (has(name)) return (*this)[name];
  Fields same = *this;
  same.prefix_ = prefix_ + name + ".";
  return same;
}

bool Fields::hasAnyOf(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    if (has(name)) return true;
  }
  return false;
}

Fields Fields::anyOf(const std::vector<std::string>& names) const {
  for (const std::string& name : names) {
    if (has(name)) return (*this)[name];
  }
  failMissing(names.front());
}

std::vector<std::string> Fields::names() const {
  std::vector<std::string> result;
  if (!isObject()) return result;
  for (const Svar::Member& member : value_.members()) result.push_back(member.first);
  return result;
}

std::size_t Fields::size() const {
  if (!isArray()) fail(std::string("is of type ") + value_.typeName() + ", expected a list");
  return value_.size();
}

Fields Fields::at(std::size_t i) const {
  if (i >= size()) {
    fail("has " + std::to_string(size()) + " elements, expected " + std::to_string(i + 1) +
         " or more");
  }
  return Fields(value_[i], source_, path_ + " [" + std::to_string(i) + "]");
}

double Fields::number() const {
  if (value_.type() != SvarType::integer && value_.type() != SvarType::real) {
    fail(std::string("is of type ") + value_.typeName() + ", expected a number");
  }
  // An integer of more than 53 bits is no double to as().
  const double value =
      value_.type() == SvarType::integer ? double(value_.as<std::int64_t>()) : value_.as<double>();
  if (!std::isfinite(value)) fail("is not finite, expected a number");
  return value;
}

double Fields::number(const std::string& name, double fallback) const {
  return has(name) ? (*this)[name].number() : fallback;
}

std::string Fields::text() const {
  if (!isText()) fail(std::string("is of type ") + value_.typeName() + ", expected text");
  return value_.as<std::string>();
}

int Fields::pixels() const {
  const double value = number();
  if (!(value >= 1 && value <= 1e6) || value != std::floor(value)) {
    fail("is " + std::to_string(value) + ", expected a whole number of pixels, 1 to 1000000");
  }
  return static_cast<int>(value);
}

void Fields::addNumbers(std::vector<double>& all) const {
  if (!isArray()) {
    all.push_back(number());
    return;
  }
  for (std::size_t i = 0; i < value_.size(); ++i) {
    const Fields element = at(i);
    if (!element.isArray()) {
      all.push_back(element.number());
      continue;
    }
    for (std::size_t k = 0; k < element.size(); ++k) all.push_back(element.at(k).number());
  }
}

std::vector<double> Fields::numbers() const {
  if (isObject()) return (*this)["data"].numbers();
  std::vector<double> all;
  addNumbers(all);
  return all;
}

std::vector<double> Fields::numbers(std::size_t count) const {
  std::vector<double> all = numbers();
  if (all.size() == count) return all;
  fail("has " + std::to_string(all.size()) + " numbers, expected " + std::to_string(count));
}

SE3d Fields::pose() const {
  const std::vector<double> n = numbers();
  if (n.size() != 12 && n.size() != 16) {
    fail("has " + std::to_string(n.size()) + " numbers, expected a matrix of 4 x 4");
  }
  if (n.size() == 16 && (n[12] != 0 || n[13] != 0 || n[14] != 0 || n[15] != 1)) {
    fail("is no pose: its last row is not 0 0 0 1");
  }
  Mat<double, 3, 4> m;
  for (std::size_t i = 0; i < 12; ++i) m(i / 4, i % 4) = n[i];
  try {
    return SE3d::fromMatrix(m, kMatrixTolerance);
  } catch (const ArgumentError& error) {
    fail(std::string("is no pose: ") + error.what());
  }
}

SO3d Fields::rotation() const {
  const std::vector<double> n = numbers(9);
  Mat3d m;
  for (std::size_t i = 0; i < 9; ++i) m(i / 3, i % 3) = n[i];
  try {
    return SO3d::fromMatrix(m, kMatrixTolerance);
  } catch (const ArgumentError& error) {
    fail(std::string("is no rotation: ") + error.what());
  }
}

// The path, or the name of a section that is written with points.
std::string Fields::place() const {
  return path_.empty() && !prefix_.empty() ? prefix_.substr(0, prefix_.size() - 1) : path_;
}

void Fields::fail(const std::string& problem) const {
  const std::string where = place();
  throw ParseError(source_, 0, 0, (where.empty() ? "" : where + " ") + problem);
}

void Fields::failMissing(const std::string& name) const {
  throw ParseError(source_, 0, 0,
                   (path_.empty() ? "" : path_ + " / ") + prefix_ + name + " is missing");
}

}  // namespace calibration
}  // namespace v1
}  // namespace gslam
