#ifndef GSLAM_MESSENGER_H
#define GSLAM_MESSENGER_H

/// @file
/// All of GSLAM::messenger.

#include <gslam/messenger/default_messenger.h>
#include <gslam/messenger/messenger.h>
#include <gslam/messenger/publisher.h>
#include <gslam/messenger/subscriber.h>
#include <gslam/messenger/synchronizer.h>
#include <gslam/messenger/version.h>

#endif  // GSLAM_MESSENGER_H
