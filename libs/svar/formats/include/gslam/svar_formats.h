#ifndef GSLAM_SVAR_FORMATS_H
#define GSLAM_SVAR_FORMATS_H

/// @file
/// All of GSLAM::svar_formats. Where it is included, Svar::load(), Svar::save() and the files of a
/// Config know .yaml, .yml and .xml.

#include <gslam/svar_formats/files.h>
#include <gslam/svar_formats/version.h>
#include <gslam/svar_formats/xml.h>
#include <gslam/svar_formats/yaml.h>

#endif  // GSLAM_SVAR_FORMATS_H
