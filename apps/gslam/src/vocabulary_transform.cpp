#include <charconv>
#include <iostream>

#include "command.h"
#include "image_bags.h"
#include "json_list.h"
#include "vocabulary.h"
#include "vocabulary_file.h"

namespace app {
namespace {

// The shortest text that is read as the same number.
std::string textOf(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

void printLine(const ImageBag& image) {
  std::cout << image.name;
  for (std::size_t i = 0; i < image.bow.size(); ++i) {
    std::cout << (i == 0 ? '\t' : ' ') << image.bow.words[i] << ':' << textOf(image.bow.values[i]);
  }
  std::cout << '\n';
}

gslam::Svar describeBag(const ImageBag& image) {
  return gslam::Svar::object({{"image", image.name},
                              {"features", image.features},
                              {"words", image.bow.words},
                              {"values", image.bow.values},
                              {"nodes", image.by_node.nodes},
                              {"node_begins", image.by_node.begins},
                              {"node_features", image.by_node.features}});
}

}  // namespace

int vocabularyTransform(const std::vector<std::string>& arguments) {
  Options options(
      "gslam vocabulary transform [options] VOCABULARY IMAGES...",
      "Turns images (files, folders of images, datasets) into bags of words: a line for each, with "
      "its name, a tab, and word:value of all its words. With --json also the features by node: "
      "under nodes[i] are node_features[node_begins[i]] to node_features[node_begins[i + 1] - 1].");
  options.arg<std::uint32_t>("levels-up", 4, "levels above the lowest, for features by node")
      .range(0, 64);
  declareBags(options);
  if (!options.read(arguments)) return kSuccess;
  if (options.words().empty()) throw gslam::ConfigError("VOCABULARY", "must be given");
  const VocabularyFile file = openVocabularyFile(options.words()[0]);
  JsonList list;
  const bool is_complete =
      forEachBag(options, file.vocabulary, {options.words().begin() + 1, options.words().end()},
                 options.get<std::uint32_t>("levels-up"), [&](const ImageBag& image) {
                   if (options.isJson()) {
                     list.add(describeBag(image));
                   } else {
                     printLine(image);
                   }
                 });
  if (options.isJson()) list.end();
  return is_complete ? kSuccess : kInterrupted;
}

}  // namespace app
