// The sub-commands of `gslam vocabulary`, and what they have in common.
#ifndef GSLAM_APPS_VOCABULARY_H
#define GSLAM_APPS_VOCABULARY_H

#include <string>
#include <vector>

namespace app {

/// @{
/// Each takes the arguments behind its name, and gives the exit status. Throws gslam::Error.
int vocabularyTrain(const std::vector<std::string>& arguments);
int vocabularyInfo(const std::vector<std::string>& arguments);
int vocabularyConvert(const std::vector<std::string>& arguments);
int vocabularyTransform(const std::vector<std::string>& arguments);
int vocabularyQuery(const std::vector<std::string>& arguments);
/// @}

}  // namespace app

#endif  // GSLAM_APPS_VOCABULARY_H
