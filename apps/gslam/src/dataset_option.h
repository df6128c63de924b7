// What all commands that open a dataset have in common.
#ifndef GSLAM_APPS_DATASET_OPTION_H
#define GSLAM_APPS_DATASET_OPTION_H

#include <gslam/core/open_dataset.h>

#include <memory>
#include <string>

#include "options.h"

namespace app {

/// Declares --format and --dataset-param.
void declareDataset(Options& options);

/// The defaults of a factory with what the user gave by an option, whose name errors have.
/// @throws ConfigError for what is no parameter
gslam::Svar completeOption(const gslam::Svar& defaults, const Options& options, const char* option);

/// What the user calls a dataset, with the kind that --format says.
gslam::FoundDataset findDataset(gslam::Plugins& plugins, const Options& options,
                                const std::string& name);

/// Opens it, with --dataset-param.
std::unique_ptr<gslam::Dataset> openDataset(gslam::Plugins& plugins, const Options& options,
                                            const std::string& name);

}  // namespace app

#endif  // GSLAM_APPS_DATASET_OPTION_H
