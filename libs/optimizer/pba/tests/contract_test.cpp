#include "../../tests/backend_contract/contract.h"

#include <gslam/optimizer_pba.h>

INSTANTIATE_TEST_SUITE_P(pba, BackendContract, testing::Values(&gslam::pbaBackend));
