#include <gslam/core/trajectory_file.h>
#include <gslam/evaluation.h>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
  gslam::Trajectory truth, estimate;
  if (argc == 3) {
    truth = gslam::readTrajectory(argv[1]);
    estimate = gslam::readTrajectory(argv[2]);
  } else {  // half a circle, and a guess of it that drifts
    for (int i = 0; i < 100; ++i) {
      const double angle = 0.03 * i;
      const gslam::SO3d heading = gslam::SO3d::exp({{0, 0, angle}});
      truth.add(i * 100000000LL, {heading, {{10 * std::sin(angle), -10 * std::cos(angle), 0}}});
      estimate.add(i * 100000000LL,
                   {heading, {{9.9 * std::sin(angle), -9.8 * std::cos(angle), 1}}});
    }
  }
  gslam::EvaluationOptions options;
  options.alignment = gslam::parseAlignment("sim3");
  options.rpe = {gslam::parseRpe("1f"), gslam::parseRpe("5m:all")};
  const gslam::Evaluation result = gslam::evaluate(truth, estimate, options);
  std::printf("%s", gslam::evaluationText(result).c_str());
  return result.alignment.is_valid && result.coverage.time > 0 ? 0 : 1;
}
