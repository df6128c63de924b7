#include "plain_scalar.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "source_text.h"

namespace gslam {
namespace formats {

using detail::isDigit;
using detail::Text;

namespace {

template <std::size_t count>
bool isOneOf(Text text, const char* const (&words)[count]) {
  for (const char* const word : words) {
    if (text == Text(word)) return true;
  }
  return false;
}

bool isNull(Text text) {
  static const char* const words[] = {"", "~", "null", "Null", "NULL"};
  return isOneOf(text, words);
}

bool isTrue(Text text) {
  static const char* const words[] = {"true", "True", "TRUE"};
  return isOneOf(text, words);
}

bool isFalse(Text text) {
  static const char* const words[] = {"false", "False", "FALSE"};
  return isOneOf(text, words);
}

bool isNaN(Text text) {
  static const char* const words[] = {".nan", ".NaN", ".NAN", ".Nan"};
  return isOneOf(text, words);
}

bool isInfinity(Text text) {
  static const char* const words[] = {".inf", ".Inf", ".INF"};
  return isOneOf(text, words);
}

bool hasSign(Text text) {
  return !text.empty() && (*text.begin() == '-' || *text.begin() == '+');
}

Text withoutSign(Text text) {
  return hasSign(text) ? Text(text.data() + 1, text.size() - 1) : text;
}

const char* skipDigits(const char* p, const char* end) {
  while (p != end && isDigit(*p)) ++p;
  return p;
}

// The parts of [-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?
struct Decimal {
  bool negative;
  Text whole;
  Text fraction;
  Text exponent;  // with its e
  bool has_point;
};

bool readExponent(const char* p, const char* end) {
  if (p == end) return true;
  if (*p != 'e' && *p != 'E') return false;
  ++p;
  if (p != end && (*p == '-' || *p == '+')) ++p;
  return p != end && skipDigits(p, end) == end;
}

bool readDecimal(Text text, Decimal& out) {
  const auto between = [](const char* p, const char* q) {
    return Text(p, static_cast<std::size_t>(q - p));
  };
  const Text number = withoutSign(text);
  const char* const point = skipDigits(number.begin(), number.end());
  const bool has_point = point != number.end() && *point == '.';
  const char* const fraction = point + (has_point ? 1 : 0);
  const char* const exponent = skipDigits(fraction, number.end());
  out = {hasSign(text) && *text.begin() == '-', between(number.begin(), point),
         between(fraction, exponent), between(exponent, number.end()), has_point};
  return !(out.whole.empty() && out.fraction.empty()) && readExponent(exponent, number.end());
}

// Of 0o17 and 0xFF; 0 for other texts.
unsigned bitsOfPrefix(Text text) {
  if (text.size() < 3 || text.data()[0] != '0') return 0;
  const unsigned bits = text.data()[1] == 'x' ? 4 : text.data()[1] == 'o' ? 3 : 0;
  for (const char* p = text.begin() + 2; p != text.end(); ++p) {
    const int digit = detail::hexDigit(*p);
    if (digit < 0 || digit >= 1 << bits) return 0;
  }
  return bits;
}

PlainScalar roundedInteger(Text text) {
  return {Svar(),
          "expected an integer that int64 or double can hold exactly, found " + quoted(text)};
}

// A number of any length is exact in a double where all but 64 bits at its top are 0.
PlainScalar prefixedInteger(Text text, unsigned bits_of_digit) {
  std::uint64_t top = 0;
  int zeros_below = 0;
  for (const char* p = text.begin() + 2; p != text.end(); ++p) {
    const std::uint64_t digit = static_cast<std::uint64_t>(detail::hexDigit(*p));
    const bool fits = zeros_below == 0 && top >> (64 - bits_of_digit) == 0;
    if (fits) {
      top = top << bits_of_digit | digit;
    } else if (digit == 0 && zeros_below < 2000) {
      zeros_below += static_cast<int>(bits_of_digit);
    } else {
      return roundedInteger(text);
    }
  }
  if (zeros_below == 0 && top <= std::uint64_t(std::numeric_limits<std::int64_t>::max())) {
    return {Svar(static_cast<std::int64_t>(top)), ""};
  }
  const double real = std::ldexp(static_cast<double>(top), zeros_below);
  while ((top & 1) == 0) top >>= 1;
  const bool exact = top >> 53 == 0 && std::isfinite(real);
  return exact ? PlainScalar{Svar(real), ""} : roundedInteger(text);
}

// As RFC 8259 wants it, for parseNumber().
std::string normalised(const Decimal& decimal) {
  Text whole = decimal.whole;
  while (whole.size() > 1 && *whole.begin() == '0')
    whole = Text(whole.data() + 1, whole.size() - 1);
  std::string text = decimal.negative ? "-" : "";
  text += whole.empty() ? "0" : whole.str();
  if (decimal.has_point) text += "." + (decimal.fraction.empty() ? "0" : decimal.fraction.str());
  return text + decimal.exponent.str();
}

PlainScalar decimalScalar(Text text) {
  Decimal decimal = {false, "", "", "", false};
  readDecimal(text, decimal);
  const std::string number = normalised(decimal);
  const detail::ParsedNumber parsed =
      detail::parseNumber(number.data(), number.data() + number.size());
  const bool is_integer = !decimal.has_point && decimal.exponent.empty();
  if (parsed.status == detail::NumberStatus::out_of_range) {
    return {Svar(), "expected a number that a double can hold, found " + quoted(text)};
  }
  if (parsed.status == detail::NumberStatus::integer_rounded) return roundedInteger(text);
  if (parsed.is_integer) return {Svar(parsed.integer), ""};
  if (is_integer && parsed.real == 0) return {Svar(0), ""};  // -0, a double in JSON
  return {Svar(parsed.real), ""};
}

PlainScalar numberScalar(Text text) {
  const unsigned bits = bitsOfPrefix(text);
  if (bits != 0) return prefixedInteger(text, bits);
  if (isNaN(text)) return {Svar(std::numeric_limits<double>::quiet_NaN()), ""};
  if (isInfinity(withoutSign(text))) {
    const double infinity = std::numeric_limits<double>::infinity();
    return {Svar(*text.begin() == '-' ? -infinity : infinity), ""};
  }
  return decimalScalar(text);
}

}  // namespace

SvarType plainType(Text text) noexcept {
  if (isNull(text)) return SvarType::null;
  const char first = *text.begin();
  if (!isDigit(first) && first != '-' && first != '+' && first != '.') {
    return isTrue(text) || isFalse(text) ? SvarType::boolean : SvarType::string;
  }
  if (bitsOfPrefix(text) != 0) return SvarType::integer;
  Decimal decimal = {false, "", "", "", false};
  if (readDecimal(text, decimal)) {
    const bool is_integer = !decimal.has_point && decimal.exponent.empty();
    return is_integer ? SvarType::integer : SvarType::real;
  }
  return isNaN(text) || isInfinity(withoutSign(text)) ? SvarType::real : SvarType::string;
}

PlainScalar plainScalar(Text text) {
  switch (plainType(text)) {
    case SvarType::null:
      return {Svar(), ""};
    case SvarType::boolean:
      return {Svar(isTrue(text)), ""};
    case SvarType::integer:
    case SvarType::real:
      return numberScalar(text);
    default:
      return {detail::SvarParts::string(text), ""};
  }
}

PlainScalar plainReal(Text text) {
  // A point makes a decimal integer a real number, for which the nearest double is right.
  if (plainType(text) == SvarType::integer && bitsOfPrefix(text) == 0) {
    return numberScalar(text.str() + ".");
  }
  PlainScalar scalar = numberScalar(text);
  if (scalar.value.type() == SvarType::integer && scalar.problem.empty()) {
    if (!scalar.value.is<double>()) return roundedInteger(text);
    scalar.value = scalar.value.as<double>();
  }
  return scalar;
}

namespace {

void appendReal(double value, std::string& out) {
  if (std::isnan(value)) {
    out += ".nan";
    return;
  }
  if (std::isinf(value)) {
    out += value > 0 ? ".inf" : "-.inf";
    return;
  }
  char digits[32];
  const std::string number(digits, detail::printDouble(value, digits));
  const std::size_t exponent = number.find('e');
  if (exponent == std::string::npos) {
    out += number;
    return;
  }
  out.append(number, 0, exponent);
  if (number.find('.') == std::string::npos) out += ".0";
  out += 'e';
  if (number[exponent + 1] != '-') out += '+';
  out.append(number, exponent + 1, std::string::npos);
}

}  // namespace

void appendPlain(const Svar& value, std::string& out) {
  char digits[32];
  switch (value.type()) {
    case SvarType::boolean:
      out += detail::SvarParts::boolean(value) ? "true" : "false";
      return;
    case SvarType::integer:
      out.append(digits, detail::printInt64(detail::SvarParts::integer(value), digits));
      return;
    case SvarType::real:
      return appendReal(detail::SvarParts::real(value), out);
    default:
      out += "null";
  }
}

}  // namespace formats
}  // namespace gslam
