// Stamps that count different units, and trajectories that miss each other in time.
#ifndef GSLAM_EVALUATION_SRC_TIME_UNITS_H
#define GSLAM_EVALUATION_SRC_TIME_UNITS_H

#include <gslam/core/trajectory.h>

#include <cstdint>
#include <string>

namespace gslam {
inline namespace v1 {
namespace evaluation {

// Half of the steps between two poses are no longer; 0 where there are fewer than two poses. ns.
double medianStep(const Trajectory& trajectory);

// Seconds with as many digits as one wants to read.
std::string secondsOf(double nanoseconds);

// Throws an ArgumentError that names the units where stamps of one trajectory count another one.
void checkUnits(const Trajectory& reference, const Trajectory& estimate, std::int64_t offset);

// Why no pose found a partner, and what to do.
std::string whyNoPair(const Trajectory& reference, const Trajectory& estimate, std::int64_t offset,
                      std::int64_t max_dt);

}  // namespace evaluation
}  // namespace v1
}  // namespace gslam

#endif  // GSLAM_EVALUATION_SRC_TIME_UNITS_H
