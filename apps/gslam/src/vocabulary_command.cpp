#include <gslam/svar/detail/nearest_name.h>
#include <gslam/svar/error.h>

#include <iostream>

#include "command.h"
#include "vocabulary.h"

namespace app {
namespace {

constexpr Command kParts[] = {
    {"train", "make a vocabulary of images", vocabularyTrain},
    {"info", "say what is in a vocabulary file of any kind", vocabularyInfo},
    {"convert", "write a vocabulary in another format, or with other weights", vocabularyConvert},
    {"transform", "turn images into bags of words", vocabularyTransform},
    {"query", "find the places that images show again", vocabularyQuery},
};

void printHelp(std::ostream& out) {
  out << "usage: gslam vocabulary PART [arguments]\n\n"
         "Makes vocabularies of image features, and recognizes places by them.\n\n";
  for (const Command& part : kParts) {
    const std::string name = part.name;
    out << "  " << name << std::string(11 - name.size(), ' ') << part.summary << '\n';
  }
  out << "\n`gslam vocabulary PART --help` says more.\n";
}

// As main() does, but with the help of the part.
int runPart(const Command& part, const std::vector<std::string>& arguments) {
  try {
    return part.run(arguments);
  } catch (const gslam::ConfigError& error) {
    const std::string what = std::string("gslam vocabulary ") + part.name;
    std::cerr << what << ": " << error.what() << "\nTry `" << what << " --help`.\n";
    return kUsage;
  }
}

}  // namespace

int vocabularyCommand(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    printHelp(std::cerr);
    return kUsage;
  }
  const std::string& name = arguments[0];
  if (name == "--help" || name == "-h" || name == "help") {
    printHelp(std::cout);
    return kSuccess;
  }
  std::vector<std::string> names;
  for (const Command& part : kParts) {
    if (name == part.name) return runPart(part, {arguments.begin() + 1, arguments.end()});
    names.emplace_back(part.name);
  }
  throw gslam::ConfigError("'" + name + "'",
                           "is no part of it: expected train, info, convert, transform or query" +
                               gslam::detail::suggestion(gslam::detail::nearestName(name, names)));
}

}  // namespace app
