// A trajectory drawn over ground truth: into a PNG, and with characters.
#ifndef GSLAM_APPS_TRAJECTORY_PLOT_H
#define GSLAM_APPS_TRAJECTORY_PLOT_H

#include <gslam/geometry/vec.h>

#include <cstdint>
#include <string>
#include <vector>

namespace app {

/// Where something was, and how wrong that is.
struct PlottedPose {
  std::int64_t stamp;     ///< nanoseconds, or the number of a frame
  gslam::Vec3d position;  ///< in the world of the truth, metres
  double error;           ///< metres; NaN where it is not known
};

/// What is drawn. A position that is not finite, or is beyond 1e12 m, is left out as a gap.
struct TrajectoryPlot {
  std::vector<PlottedPose> truth, estimate;  ///< ascending stamps; the estimate is aligned
  /// The longest step of the estimate that is no gap, as stamps are; 0: five median steps. Of the
  /// truth it is always these.
  std::int64_t lost_after = 0;
  std::string title, subtitle;  ///< lines above the picture
};

/// The plane that is looked at: the two axes along which the truth (or the estimate where there is
/// no truth) goes farthest, and what part of it has poses.
struct PlotView {
  int right = 0, up = 1;                               ///< axes, 0 to 2; `right` is the lesser
  double left = 0, width = 1, bottom = 0, height = 1;  ///< metres; one of both sizes is above 0
  bool is_empty = true;                                ///< whether there are no poses
};
PlotView viewOf(const TrajectoryPlot& plot);

/// A point of the plane.
struct PlotPoint {
  double right, up, error;  ///< metres
};
/// Points without a gap between them.
using PlotStroke = std::vector<PlotPoint>;

/// What is to be drawn of poses.
/// @param longest_step  that is no gap, as stamps are; 0: five median steps
std::vector<PlotStroke> strokesOf(const std::vector<PlottedPose>& poses, const PlotView& view,
                                  std::int64_t longest_step);

/// The name of an axis.
char axisName(int axis);
/// 1, 2 or 5 times a power of ten, not below a value above 0.
double roundStep(double least);
/// A number with the decimals that multiples of a step have, whatever the locale.
std::string numberText(double value, double step);
/// A length with three digits in mm, cm, m or km.
std::string lengthText(double metres);

/// Draws a PNG: the truth as a thin line, the estimate coloured by its error.
/// @throws FileError where it cannot be written
void writePlot(const TrajectoryPlot& plot, const std::string& path);

/// Draws with characters, 60 x 20 at most within a frame.
/// @param is_utf8  whether there are dots of Braille; else all is ASCII
std::string plotText(const TrajectoryPlot& plot, bool is_utf8);
/// Whether the environment says that text is UTF-8.
bool isUtf8Environment();

}  // namespace app

#endif  // GSLAM_APPS_TRAJECTORY_PLOT_H
