#include "../../tests/backend_contract/contract.h"

#include <gslam/optimizer_ceres.h>

INSTANTIATE_TEST_SUITE_P(ceres, BackendContract, testing::Values(&gslam::ceresBackend));
