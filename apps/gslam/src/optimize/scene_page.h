// A page that shows a problem before and after it was solved.
#ifndef GSLAM_APPS_OPTIMIZE_SCENE_PAGE_H
#define GSLAM_APPS_OPTIMIZE_SCENE_PAGE_H

#include <gslam/optimizer/summary.h>

#include <string>

#include "scene.h"

namespace app {

/// What stands on the page.
struct ScenePage {
  std::string title;  ///< such as the name of the file
  std::string start;  ///< what the first scene shows, such as "before"
  Scene before;
  Scene after;
  SceneView view;  ///< where to begin to look from
  gslam::OptimizerSummary summary;
};

/// Writes an HTML file that needs nothing else: both scenes, to be turned together, the cost of
/// each iteration, and the summary.
/// @throws FileError when it cannot be written
void writeScenePage(const ScenePage& page, const std::string& path);

}  // namespace app

#endif  // GSLAM_APPS_OPTIMIZE_SCENE_PAGE_H
