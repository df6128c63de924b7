#include "problem_file.h"

#include <gslam/base/error.h>
#include <gslam/optimizer/files.h>
#include <gslam/svar/error.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace app {
namespace {

namespace fs = std::filesystem;

bool isBundleFormat(ProblemFormat format) {
  return format != ProblemFormat::G2o && format != ProblemFormat::Toro;
}

bool beginsWith(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

// The beginning of a file, enough to see what it is.
std::string beginningOf(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw gslam::FileError(path, "cannot be opened", errno);
  std::string text(4096, '\0');
  file.read(&text[0], static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

// The first word of a text that is in no comment.
std::string firstWordOf(const std::string& text) {
  std::istringstream lines(text);
  std::string line, word;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    if (words >> word && word[0] != '#') return word;
  }
  return "";
}

bool isNumber(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
}

ProblemFormat namedFormat(const std::string& name) {
  const std::vector<std::string>& names = problemFormatNames();
  const auto found = std::find(names.begin(), names.end(), name);
  return static_cast<ProblemFormat>(found - names.begin());
}

ProblemFormat formatOfContent(const std::string& path) {
  if (fs::is_directory(path)) return ProblemFormat::Colmap;
  const std::string text = beginningOf(path);
  if (beginsWith(text, "# Bundle file")) return ProblemFormat::Bundler;
  std::string word = firstWordOf(text);
  if (beginsWith(word, "\xEF\xBB\xBF")) word.erase(0, 3);
  const bool is_compressed = beginsWith(text, "BZh") || beginsWith(text, "\x1f\x8b");
  if (isNumber(word) || is_compressed) return ProblemFormat::Bal;  // says: decompress
  for (const char* const tag : {"VERTEX_SE", "VERTEX_SIM", "EDGE_SE", "EDGE_SIM", "FIX"}) {
    if (beginsWith(word, tag)) return ProblemFormat::G2o;
  }
  for (const char* const tag : {"VERTEX", "EDGE", "ODOMETRY"}) {
    if (beginsWith(word, tag)) return ProblemFormat::Toro;
  }
  throw gslam::ConfigError(
      "--format",
      "must be given: " + path + " looks like none of BAL, Bundler, COLMAP, g2o and TORO");
}

}  // namespace

const std::vector<std::string>& problemFormatNames() {
  static const std::vector<std::string> names = {"bal", "bundler", "colmap", "g2o", "toro"};
  return names;
}

ProblemFormat inputFormat(const std::string& path, const std::string& name) {
  return name == "auto" ? formatOfContent(path) : namedFormat(name);
}

ProblemFormat outputFormat(const std::string& path, const std::string& name, ProblemFormat input) {
  ProblemFormat format = input;
  if (name != "auto") {
    format = namedFormat(name);
  } else {
    const std::string extension = fs::path(path).extension().string();
    if (extension == ".g2o") format = ProblemFormat::G2o;
    if (extension == ".graph" || extension == ".toro") format = ProblemFormat::Toro;
    if (extension == ".out") format = ProblemFormat::Bundler;
    if (extension == ".bal") format = ProblemFormat::Bal;
    const bool is_folder = fs::is_directory(path) || (!path.empty() && path.back() == '/');
    if (is_folder) format = ProblemFormat::Colmap;
  }
  if (isBundleFormat(format) == isBundleFormat(input)) return format;
  const std::string kind = isBundleFormat(input) ? "a bundle" : "a pose graph";
  throw gslam::ConfigError("--out", "is to be written as " +
                                        problemFormatNames()[static_cast<std::size_t>(format)] +
                                        ", which cannot hold " + kind);
}

Problem readProblem(const std::string& path, ProblemFormat format) {
  switch (format) {
    case ProblemFormat::Bal:
      return gslam::readBal(path);
    case ProblemFormat::Bundler:
      return gslam::readBundler(path);
    case ProblemFormat::Colmap:
      return gslam::readColmap(path);
    case ProblemFormat::G2o:
      return gslam::readG2o(path);
    case ProblemFormat::Toro:
      break;
  }
  return gslam::readToro(path);
}

void writeProblem(const Problem& problem, const std::string& path, ProblemFormat format) {
  if (format == ProblemFormat::G2o) return gslam::writeG2o(std::get<1>(problem), path);
  if (format == ProblemFormat::Toro) return gslam::writeToro(std::get<1>(problem), path);
  const gslam::Bundle& bundle = std::get<0>(problem);
  if (format == ProblemFormat::Bundler) return gslam::writeBundler(bundle, path);
  if (format == ProblemFormat::Colmap) return gslam::writeColmap(bundle, path);
  gslam::writeBal(bundle, path);
}

}  // namespace app
