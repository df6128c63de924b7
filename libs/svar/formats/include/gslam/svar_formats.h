#ifndef GSLAM_SVAR_FORMATS_H
#define GSLAM_SVAR_FORMATS_H

/// @file
/// All of GSLAM::svar_formats.

#include <gslam/svar_formats/version.h>
#include <gslam/svar_formats/xml.h>
#include <gslam/svar_formats/yaml.h>

#endif  // GSLAM_SVAR_FORMATS_H
