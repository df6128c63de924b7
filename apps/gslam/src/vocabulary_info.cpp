#include <gslam/svar/json.h>
#include <gslam/vocabulary/file.h>
#include <gslam/vocabulary/fingerprint.h>

#include <iostream>

#include "command.h"
#include "options.h"
#include "vocabulary.h"
#include "vocabulary_file.h"
#include "vocabulary_report.h"

namespace app {

int vocabularyInfo(const std::vector<std::string>& arguments) {
  Options options(
      "gslam vocabulary info [options] FILE",
      "Says what is in a vocabulary file: of GSLAM, ORB-SLAM (text), DBoW2, DBoW3, FBoW "
      "or GSLAM before 1.0, compressed by gzip or not.");
  options.arg<bool>("verify", false,
                    "check all of it: the checksum and every number (files of others always are)");
  if (!options.read(arguments)) return kSuccess;
  const std::string& path = options.oneWord("FILE");
  const VocabularyFile file = openVocabularyFile(path);
  const bool verifies = options.get<bool>("verify");
  if (verifies) gslam::verifyVocabulary(file.vocabulary, path);
  const bool is_checked = verifies || !file.is_own;
  const std::string fingerprint = std::to_string(gslam::fingerprint(file.vocabulary));
  if (options.isJson()) {
    gslam::Svar facts = describe(file.vocabulary, path);
    facts.set("file", path);
    facts.set("kind", file.kind);
    facts.set("gzipped", file.is_gzipped);
    facts.set("file_bytes", file.bytes);
    facts.set("checked", is_checked);
    facts.set("fingerprint", fingerprint);
    std::cout << gslam::printJson(facts) << '\n';
    return kSuccess;
  }
  std::cout << "file         " << file.kind << (file.is_gzipped ? ", compressed by gzip, " : ", ")
            << sizeText(file.bytes) << '\n';
  print(file.vocabulary, path);
  std::cout << "fingerprint  " << fingerprint << "\nchecked      "
            << (is_checked ? "all of it, nothing is wrong with it\n"
                           : "its header alone; --verify checks all of it\n");
  return kSuccess;
}

}  // namespace app
