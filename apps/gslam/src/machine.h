#ifndef GSLAM_APPS_MACHINE_H
#define GSLAM_APPS_MACHINE_H

#include <gslam/svar/svar.h>

namespace app {

/// What ran: processor, cores, memory, kernel, and what this program was compiled by.
gslam::Svar describeMachine();

}  // namespace app

#endif  // GSLAM_APPS_MACHINE_H
