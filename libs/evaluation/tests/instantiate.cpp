// Uses every function of GSLAM::evaluation; compiled alone under every compiler and standard by
// tests/headers.
#include <gslam/evaluation.h>

#include <memory>
#include <string>
#include <utility>
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

std::string instantiateCost(std::shared_ptr<gslam::Slam> slam);

std::string instantiateCost(std::shared_ptr<gslam::Slam> slam) {
  gslam::setCpuAffinity(gslam::parseCpuList("0"));
  const gslam::MemoryLimit limit(gslam::parseMemorySize("4G"));
  const bool is_counted = gslam::countAllocationsOfChildren();
  const auto tree = std::make_shared<gslam::ProcessTree>();
  gslam::MeasuredSlam measured(std::move(slam), {tree});
  gslam::ResourceMonitor monitor(tree);
  measured.noteDropped(1, 2);
  const gslam::AllocationCounts before = gslam::allocationCounts();
  gslam::CostSource source;
  source.frames = measured.frames();
  source.resources = monitor.stop();
  source.allocations = gslam::allocatedBetween(before, gslam::allocationCountsOf(tree->root()));
  const double used = gslam::usedBetween(tree->read(), tree->read()).cpu_seconds;
  const gslam::Cost cost = gslam::costOf(std::move(source));
  return limit.text() + gslam::whyNoAllocations() + gslam::costText(cost) +
         gslam::frameTimesCsv(cost.source.frames) +
         std::to_string(gslam::costToSvar(cost).size() + gslam::cpuAffinity().size()) +
         std::to_string(used + double(tree->cpuTime())) + (is_counted ? "counted" : "not");
}
