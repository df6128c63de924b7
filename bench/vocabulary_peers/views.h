// Descriptors to train on and to ask for: of views of images that are rendered and, where
// GSLAM_TEST_DATA names the test data, of its photographs.
#ifndef GSLAM_BENCH_VOCABULARY_PEERS_VIEWS_H
#define GSLAM_BENCH_VOCABULARY_PEERS_VIEWS_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Rows of bytes: of ORB, 32 each; of SIFT, 128 numbers that OpenCV rounds to 0 to 255.
using Rows = std::vector<std::uint8_t>;

enum class Feature { orb, sift };

inline std::size_t rowSize(Feature feature) {
  return feature == Feature::orb ? 32 : 128;
}

/// Where descriptors and trees are kept from one run to the next: GSLAM_PEERS_CACHE, else a folder
/// below the one for temporary files. It is made when it is not there.
/// @return its path with a slash at its end
std::string cacheFolder();

/// What differs between caches that must not be mixed: the seed, the number of photographs, and the
/// version of OpenCV.
std::string cacheKey(Feature feature, std::uint32_t seed);

/// The descriptors of views, up to 1000 of each, one view after the other.
///
/// View i is of image i modulo their number, through a random homography, blurred, made brighter or
/// darker, with noise. Taken from the cache where they are in it.
/// @param seed  another one: other views of the same images
std::vector<Rows> describeViews(Feature feature, std::size_t count, std::uint32_t seed);

#endif  // GSLAM_BENCH_VOCABULARY_PEERS_VIEWS_H
