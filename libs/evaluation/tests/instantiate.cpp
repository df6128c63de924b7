// Uses every function of GSLAM::evaluation; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/evaluation.h>

#include <string>
#include <vector>

std::string instantiateEvaluation(const gslam::Trajectory& reference,
                                  const gslam::Trajectory& estimate);

std::string instantiateEvaluation(const gslam::Trajectory& reference,
                                  const gslam::Trajectory& estimate) {
  gslam::EvaluationOptions options;
  options.association.method = gslam::associationMethod("evo");
  options.alignment = gslam::parseAlignment("sim3");
  options.rpe.push_back(gslam::parseRpe("1f"));
  const gslam::Evaluation evaluation = gslam::evaluate(reference, estimate, options);
  const gslam::PosePairs pairs = gslam::pairPoses(reference, estimate);
  const gslam::Alignment alignment = gslam::align(pairs);
  const std::vector<double> lengths = {10};
  const double sum = gslam::kittiErrors(pairs).t_err_percent + gslam::driftOf(pairs).length +
                     gslam::segmentErrors(pairs, lengths)[0].length +
                     gslam::scoreOf(reference, estimate).value +
                     gslam::coverageOf(reference, estimate).time + gslam::percentile({1, 2}, 0.5) +
                     gslam::statisticsOf(gslam::absoluteErrors(pairs)).full.rmse;
  return gslam::evaluationText(evaluation) + gslam::rpeText(options.rpe[0]) +
         gslam::alignmentText(options.alignment) + std::to_string(sum) + alignment.reason +
         std::to_string(gslam::readKittiMatrices("none").size()) +
         std::to_string(gslam::evaluationToSvar(evaluation).size());
}
