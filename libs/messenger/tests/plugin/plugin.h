// What the test and its plugins agree on. Plugins are built with hidden visibility and loaded
// local, as those of GSLAM are: each has its own copy of all that is inline, and of all type_infos.
#ifndef GSLAM_MESSENGER_TESTS_PLUGIN_H
#define GSLAM_MESSENGER_TESTS_PLUGIN_H

#include <gslam/messenger.h>

struct SharedPose {
  int x;
};

/// What a plugin offers to its host.
struct Plugin {
  void (*subscribe)(const gslam::Messenger&);       ///< keeps the last pose of "pose"
  int (*last)();                                    ///< its x
  void (*end)();                                    ///< ends that subscription
  void (*publish)(const gslam::Messenger&, int x);  ///< on "pose"
  void (*publishHidden)(const gslam::Messenger&);   ///< a type of an unnamed namespace, on "hidden"
  void (*subscribeOnce)(const gslam::Messenger&);   ///< to "pose", until the first message
  void (*setDefault)(const gslam::Messenger&);      ///< hands a default messenger over
  void (*publishToDefault)(int x);                  ///< on "pose" of the plugin's default messenger
};

#endif  // GSLAM_MESSENGER_TESTS_PLUGIN_H
