// Values given as text on the command line or in the environment.
#ifndef GSLAM_SVAR_DETAIL_VALUE_OF_TEXT_H
#define GSLAM_SVAR_DETAIL_VALUE_OF_TEXT_H

#include <gslam/svar/detail/svar_traits.h>
#include <gslam/svar/json.h>

#include <string>

namespace gslam {
inline namespace v1 {
namespace detail {

[[noreturn]] inline void failText(const std::string& text, const std::string& expected) {
  throw SvarError("", "expected " + expected + ", found \"" + text + "\"");
}

inline Svar valueOfJson(const std::string& text, const std::string& expected) {
  try {
    return parseJson(text, "value");
  } catch (const ParseError& error) {
    failText(text, expected + " as JSON (" + std::string(error.what()) + ")");
  }
}

inline Svar valueOfBool(const std::string& text) {
  for (const char* word : {"true", "yes", "on", "1"}) {
    if (text == word) return true;
  }
  for (const char* word : {"false", "no", "off", "0"}) {
    if (text == word) return false;
  }
  failText(text, "true or false");
}

/// As JSON has them, and with a plus before, or without a digit on one side of the point.
inline Svar valueOfNumber(const std::string& text, const std::string& expected) {
  std::string number = text;
  const std::size_t sign = !number.empty() && (number[0] == '+' || number[0] == '-') ? 1 : 0;
  if (number.compare(sign, 1, ".") == 0 && number.size() > sign + 1) number.insert(sign, "0");
  const std::size_t point = number.find('.');
  const bool ends = point != std::string::npos && !isDigit((number + " ")[point + 1]);
  if (ends && point > sign && isDigit(number[point - 1])) number.insert(point + 1, "0");
  if (sign == 1 && number[0] == '+') number.erase(0, 1);
  const char* const end = number.data() + number.size();
  if (number.empty() || (text[0] == '+' && !isDigit(number[0]))) failText(text, expected);
  const ParsedNumber parsed = parseNumber(number.data(), end);
  const bool whole = parsed.end == end;
  if (whole && parsed.status == NumberStatus::ok) {
    return parsed.is_integer ? Svar(parsed.integer) : Svar(parsed.real);
  }
  if (whole && parsed.status == NumberStatus::integer_as_double) return parsed.real;
  failText(text, expected);
}

/// What a text means where a T is asked for. Whether it is one in the end is not checked here.
template <class T, class = void>
struct ValueOfText {
  static Svar read(const std::string& text) { return valueOfJson(text, svarTypeName<T>()); }
};
template <>
struct ValueOfText<bool> {
  static Svar read(const std::string& text) { return valueOfBool(text); }
};
template <class T>
struct ValueOfText<T, typename std::enable_if<IsInteger<T>::value || IsReal<T>::value>::type> {
  static Svar read(const std::string& text) { return valueOfNumber(text, svarTypeName<T>()); }
};
template <>
struct ValueOfText<std::string> {
  static Svar read(const std::string& text) { return text; }
};
/// JSON, or where it does not look like JSON a string.
template <>
struct ValueOfText<Svar> {
  static Svar read(const std::string& text) {
    if (!text.empty() && std::string("[{\"").find(text[0]) != std::string::npos) {
      return valueOfJson(text, "a value");
    }
    try {
      return parseJson(text, "value");
    } catch (const ParseError&) {
      return text;
    }
  }
};
/// JSON, or elements with commas between them.
template <class T>
struct ValueOfText<T, typename std::enable_if<IsList<T>::value>::type> {
  static Svar read(const std::string& text) {
    if (!text.empty() && text[0] == '[') return valueOfJson(text, svarTypeName<T>());
    Svar list = Svar::array();
    for (std::size_t begin = 0; begin < text.size();) {
      std::size_t end = text.find(',', begin);
      if (end == std::string::npos) end = text.size();
      const std::string element = text.substr(begin, end - begin);
      list.push_back(ValueOfText<typename T::value_type>::read(element));
      begin = end + 1;
      if (begin == text.size()) failText(text, "an element behind the last comma");
    }
    return list;
  }
};
template <class T>
struct ValueOfText<T, typename std::enable_if<IsOptional<T>::value>::type> {
  static Svar read(const std::string& text) {
    return text == "null" ? Svar() : ValueOfText<typename SvarTraits<T>::Value>::read(text);
  }
};

}  // namespace detail
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_SVAR_DETAIL_VALUE_OF_TEXT_H
