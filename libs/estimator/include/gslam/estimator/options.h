#ifndef GSLAM_ESTIMATOR_OPTIONS_H
#define GSLAM_ESTIMATOR_OPTIONS_H

#include <gslam/base/span.h>

#include <cstddef>
#include <cstdint>

/// @file
/// How the robust functions, `gslam::estimate...`, search.

namespace gslam {
inline namespace v1 {

/// How minimal samples are drawn.
enum class EstimateSampling {
  Uniform,  ///< all matches alike
  Prosac,   ///< the best of EstimateOptions::quality first (Chum, Matas, "Matching with PROSAC",
            ///< CVPR 2005); uniform without qualities, and for the second half of max_iterations
            ///< as long as nothing was found
};

/// What makes one model better than another. In brackets: Estimate::score.
enum class EstimateScoring {
  Msac,    ///< squared residuals, each cut off at the threshold (Torr, Zisserman, "MLESAC", CVIU
           ///< 78(1), 2000) [their sum in units of the squared threshold, so that a match that does
           ///< not fit adds 1]
  Ransac,  ///< number of inliers [of matches that are none]
  Lmeds,   ///< least median of squares (Rousseeuw, JASA 79, 1984); at most half outliers. Needs no
           ///< threshold: it is made from the median, 2.5 standard deviations [the median, at the
           ///< rank of a half and half a sample]
  Magsac,  ///< likelihood marginalised over all thresholds up to the given one, which may be
           ///< several times too large (Barath et al., "MAGSAC++", CVPR 2020; here with three
           ///< degrees of freedom, where it has a closed form). The inliers are those of the
           ///< smaller threshold that makes their number least likely by chance [from 0 to 1 for
           ///< each match]
};

/// How `gslam::estimate...` search. The defaults suit matches of features in images.
///
/// Thread-safety: plain data; the spans are only read.
struct EstimateOptions {
  /// The largest residual of an inlier: pixels where cameras are given, radians for bearings, the
  /// unit of the points otherwise. 0: the function's own default, where it has one; functions on
  /// metric points have none and answer InvalidInput.
  double threshold = 0;
  /// Wanted probability that at least one sample without an outlier was drawn; below 1.
  double confidence = 0.999;
  /// Samples drawn whatever was found, even if there are more of them than max_iterations.
  std::size_t min_iterations = 0;
  std::size_t max_iterations = 10000;  ///< samples drawn at most
  /// Seconds after which no further sample is drawn; 0: no limit. What comes before the first
  /// sample and the final refinement take their time nevertheless: some hundredths of a second for
  /// 20'000 matches. With a limit results may differ from one call to the next.
  double max_seconds = 0;
  EstimateSampling sampling = EstimateSampling::Uniform;  ///< how samples are drawn
  EstimateScoring scoring = EstimateScoring::Msac;  ///< what makes one model better than another
  bool local_optimisation = true;  ///< whether each best model so far is refined on its inliers
  bool final_refinement = true;    ///< whether the last one is refined until its inliers stay
  /// Quality of each match for EstimateSampling::Prosac, larger is better; as many as matches, or
  /// none.
  Span<const float> quality;
  /// The most consensus that chance alone may explain: Ok is answered only if, among matches that
  /// have nothing to do with each other, the expected number of models with as many inliers is
  /// below this (a contrario; Moisan, Stival, IJCV 57(3), 2004).
  ///
  /// How likely an unrelated match is an inlier of the model is estimated twice, and the larger
  /// number counts: as if observations were spread evenly over the box around them (each function
  /// says how), and as the part of up to 20'000 pairs of the first half of one match and the second
  /// half of another one that fit the model, which knows clusters, lines and grids for what they
  /// are. Matches that are within the threshold of each other in all that was observed (more
  /// exactly, in one cell of a grid of this width) count once: a match that was given often
  /// confirms nothing.
  double max_false_alarms = 1e-3;
  /// Of the sampler: same seed, same result, for any number of threads, on machines of one kind
  /// (others round differently).
  std::uint64_t seed = 1;
  unsigned threads = 1;  ///< at work, the caller's among them; 0: as many as the machine has
};

}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_ESTIMATOR_OPTIONS_H
