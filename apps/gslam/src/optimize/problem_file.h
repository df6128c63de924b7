// Files of bundles and pose graphs of any format.
#ifndef GSLAM_APPS_OPTIMIZE_PROBLEM_FILE_H
#define GSLAM_APPS_OPTIMIZE_PROBLEM_FILE_H

#include <gslam/optimizer/bundle.h>
#include <gslam/optimizer/files/any_pose_graph.h>

#include <string>
#include <variant>
#include <vector>

namespace app {

/// A format of files.
enum class ProblemFormat { Bal, Bundler, Colmap, G2o, Toro };

/// What a file holds.
using Problem = std::variant<gslam::Bundle, gslam::AnyPoseGraph>;

/// Names that --format and --out-format take, in the order of ProblemFormat.
const std::vector<std::string>& problemFormatNames();

/// The format of a file or folder that is there, by its content.
/// @param name  one of problemFormatNames(), or "auto"
/// @throws FileError when it cannot be read, ConfigError when nothing looks like a format
ProblemFormat inputFormat(const std::string& path, const std::string& name);

/// The format of a file or folder that is to be written: by its extension where that says one, else
/// that of the input.
/// @param name  one of problemFormatNames(), or "auto"
/// @throws ConfigError when the format cannot hold the problem
ProblemFormat outputFormat(const std::string& path, const std::string& name, ProblemFormat input);

/// @throws FileError, ParseError
Problem readProblem(const std::string& path, ProblemFormat format);
/// @throws FileError, ArgumentError for what the format cannot hold
void writeProblem(const Problem& problem, const std::string& path, ProblemFormat format);

}  // namespace app

#endif  // GSLAM_APPS_OPTIMIZE_PROBLEM_FILE_H
