#include <gslam/datasets/formats.h>

namespace gslam {
inline namespace v1 {

std::vector<DatasetFactory> datasetFormats() {
  return {kittiFactory(),    kittiRawFactory(),     tumFactory(),     iclFactory(),
          tumMonoFactory(),  eurocFactory(),        tumViFactory(),   droneMapFactory(),
          photosFactory(),   sevenScenesFactory(),  strechaFactory(), folderFactory(),
          cvMonoFactory()};
}

}  // namespace v1
}  // namespace gslam
