// Uses the templates of GSLAM::vocabulary; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/vocabulary.h>

#include <cstdint>
#include <map>
#include <vector>

using BowMap = std::map<unsigned, double>;
using FeatureMap = std::map<unsigned, std::vector<unsigned>>;

template BowMap gslam::toMap<BowMap>(const gslam::BowVector&);
template FeatureMap gslam::toMap<FeatureMap>(const gslam::FeatureVector&);
template gslam::BowVector gslam::bowFromMap(const BowMap&);
template gslam::FeatureVector gslam::featuresFromMap(const FeatureMap&);
