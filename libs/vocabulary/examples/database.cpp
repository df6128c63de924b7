// Places that were seen before: a database of bags of words.
#include <gslam/vocabulary/database.h>
#include <gslam/vocabulary/dbow_maps.h>
#include <gslam/vocabulary/score.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <string>

namespace {

// As transform() makes them of the descriptors of an image. This walk of 80 images comes by the
// same places again after 50.
gslam::BowVector bagOfImage(std::uint32_t number) {
  gslam::BowVector bow;
  for (std::uint32_t i = 0; i < 30; ++i) {
    bow.words.push_back(10 * (number % 50) + i);
    bow.values.push_back(1 + i % 3 + 0.1 * (number % 7));
  }
  normalize(bow, gslam::Scoring::l1);
  return bow;
}

}  // namespace

int main() {
  gslam::BowDatabase database(gslam::Scoring::l1);  // that of the vocabulary
  for (std::uint32_t number = 0; number < 80; ++number) {
    const gslam::BowVector bow = bagOfImage(number);
    gslam::QueryOptions options;
    options.count = 1;                                  // the best one
    options.before_id = number < 20 ? 0 : number - 20;  // but not what was seen just now
    options.worst_score = 0.8;
    for (const gslam::QueryResult& place : database.query(bow, options)) {
      if (number % 10 != 0) continue;
      std::printf("image %u was at the place of image %llu: score %.2f, %u common words\n", number,
                  static_cast<unsigned long long>(place.id), place.score, place.common_words);
    }
    database.add(bow);  // gets the ids 0, 1, 2...
  }

  // Images that are no longer wanted go, and the rest goes into a file.
  for (std::uint64_t id = 0; id < 80; id += 2) database.erase(id);
  const std::string path = "gslam_example_places.bow";
  database.save(path);
  const gslam::BowDatabase loaded = gslam::loadDatabase(path);
  std::printf("%zu of %llu images are left\n", loaded.size(),
              static_cast<unsigned long long>(loaded.nextId()));
  std::remove(path.c_str());

  // Two bags alone, and the std::map of DBoW.
  const gslam::BowVector first = bagOfImage(1), second = bagOfImage(3);
  const auto map = gslam::toMap<std::map<unsigned, double>>(second);
  std::printf("score %.2f\n", score(gslam::Scoring::l1, first, gslam::bowFromMap(map)));
  return loaded.size() == 40 ? 0 : 1;
}
