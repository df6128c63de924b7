#ifndef GSLAM_SVAR_H
#define GSLAM_SVAR_H

/// @file
/// All of GSLAM::svar but Config, which stands in gslam/svar/config.h: who only reads parameters
/// need not pay for the command line.

#include <gslam/svar/error.h>
#include <gslam/svar/fields.h>
#include <gslam/svar/json.h>
#include <gslam/svar/shared.h>
#include <gslam/svar/svar.h>
#include <gslam/svar/version.h>

#endif  // GSLAM_SVAR_H
