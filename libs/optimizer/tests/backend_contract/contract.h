// What every back end must do, as tests: a back end's tests include this and say
//
//     INSTANTIATE_TEST_SUITE_P(pba, BackendContract, testing::Values(&gslam::pbaBackend));
//
// Problems that the back end says it cannot solve are skipped.
#ifndef GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_H
#define GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_H

#include "contract_bundle.h"
#include "contract_edges.h"
#include "contract_files.h"
#include "contract_graph.h"
#include "contract_run.h"
#include "contract_small.h"

#endif  // GSLAM_OPTIMIZER_TESTS_BACKEND_CONTRACT_CONTRACT_H
