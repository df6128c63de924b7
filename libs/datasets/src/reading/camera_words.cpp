#include "camera_words.h"

#include <gslam/base/error.h>
#include <gslam/svar/detail/parse_number.h>

#include <map>
#include <sstream>
#include <vector>

namespace gslam {
inline namespace v1 {
namespace reading {
namespace {

[[noreturn]] void fail(const std::string& words, const std::string& problem) {
  throw ArgumentError("camera", "is '" + words + "': " + problem +
                                    ", expected such as 'pinhole 640x480 525 525 319.5 239.5'");
}

// Words, with the x of 640x480 as one of its own.
std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    const std::size_t x = word.find('x');
    const bool is_size = x != std::string::npos && x > 0 && word[0] >= '0' && word[0] <= '9' &&
                         word.compare(0, 2, "0x") != 0;
    if (!is_size) {
      words.push_back(word);
      continue;
    }
    words.push_back(word.substr(0, x));
    if (x + 1 < word.size()) words.push_back(word.substr(x + 1));
  }
  return words;
}

bool readNumber(const std::string& word, double& value) {
  const char* const end = word.data() + word.size();
  const detail::ParsedNumber parsed = detail::parseNumber(word.data(), end);
  const bool is_number = parsed.status != detail::NumberStatus::malformed &&
                         parsed.status != detail::NumberStatus::out_of_range && parsed.end == end;
  if (is_number) value = parsed.is_integer ? double(parsed.integer) : parsed.real;
  return is_number;
}

int readSize(const std::string& words, const std::string& word) {
  double size = 0;
  const bool is_size = readNumber(word, size) && size >= 1 && size <= 1e6 && size == int(size);
  if (!is_size) fail(words, "'" + word + "' is no number of pixels");
  return int(size);
}

}  // namespace

Camera cameraOfWords(const std::string& text) {
  std::vector<std::string> words = wordsOf(text);
  if (words.size() > 2 && words[2] == "x") words.erase(words.begin() + 2);
  if (words.size() < 3) fail(text, "the model or the size of the image is missing");
  const int width = readSize(text, words[1]), height = readSize(text, words[2]);
  std::vector<double> values;
  std::map<std::string, double> named;
  for (std::size_t i = 3; i < words.size(); ++i) {
    double value = 0;
    if (readNumber(words[i], value)) {
      values.push_back(value);
    } else if (i + 1 < words.size() && readNumber(words[i + 1], value)) {
      named[words[i++]] = value;
    } else {
      fail(text, "'" + words[i] + "' is no number, and no name before one");
    }
  }
  if (!values.empty() && !named.empty()) fail(text, "some parameters have a name, some have none");
  try {
    return named.empty() ? Camera::fromParameters(words[0], width, height, values)
                         : Camera::fromNamedParameters(words[0], width, height, named);
  } catch (const ArgumentError& error) {
    throw ArgumentError("camera", "is '" + text + "': " + error.what());
  }
}

}  // namespace reading
}  // namespace v1
}  // namespace gslam
