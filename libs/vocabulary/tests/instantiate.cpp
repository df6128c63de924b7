// Uses all of GSLAM::vocabulary; compiled and linked alone under every compiler and standard by
// tests/headers.
#include <gslam/vocabulary.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

using BowMap = std::map<unsigned, double>;
using FeatureMap = std::map<unsigned, std::vector<unsigned>>;

template BowMap gslam::toMap<BowMap>(const gslam::BowVector&);
template FeatureMap gslam::toMap<FeatureMap>(const gslam::FeatureVector&);
template gslam::BowVector gslam::bowFromMap(const BowMap&);
template gslam::FeatureVector gslam::featuresFromMap(const FeatureMap&);

gslam::Vocabulary instantiateVocabulary(gslam::Span<const gslam::Descriptors> images,
                                        const std::string& path);

gslam::Vocabulary instantiateVocabulary(gslam::Span<const gslam::Descriptors> images,
                                        const std::string& path) {
  const auto image = [&](std::size_t i) { return images[i]; };
  const gslam::Vocabulary trained = gslam::trainVocabulary(images.size(), image);
  saveVocabulary(gslam::reweighted(gslam::trainVocabulary(images), images), path);
  saveOrbSlamText(reweighted(gslam::loadVocabulary(path), images.size(), image), path);
  verifyVocabulary(trained);
  return toText(qualityOf(trained, images)).empty() ? trained : gslam::openVocabulary(path);
}

std::vector<gslam::QueryResult> instantiateDatabase(const gslam::Vocabulary& vocabulary,
                                                    gslam::Span<const gslam::Descriptors> images,
                                                    const std::string& path);

std::vector<gslam::QueryResult> instantiateDatabase(const gslam::Vocabulary& vocabulary,
                                                    gslam::Span<const gslam::Descriptors> images,
                                                    const std::string& path) {
  gslam::BowDatabase database(vocabulary.scoring());
  gslam::BowVector bow;
  gslam::FeatureVector features;
  gslam::TransformMemory memory;
  transform(vocabulary, images[0], 2, bow, features, memory);
  database.erase(database.add(bow, features));
  database.save(path, gslam::fingerprint(vocabulary));
  if (score(vocabulary.scoring(), bow, bow) > 0.5) database.clear();
  return gslam::loadDatabase(path).query(bow);
}
