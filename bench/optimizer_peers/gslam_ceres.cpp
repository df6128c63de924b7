// Ceres through the facade.
#include <gslam/optimizer_ceres.h>

#include "facade_rows.h"

namespace {

struct ByCeres {
  static constexpr const char* text = "ceres";
};
const bool kRows = FacadeRows<ByCeres>::add("gslam_ceres", gslam::ceresBackend().pose != nullptr);

}  // namespace
