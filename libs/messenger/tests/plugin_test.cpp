// Messengers that are shared with plugins: two real libraries, loaded while the program runs.
#include "plugin/plugin.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <string>
#include <typeinfo>

namespace {

using gslam::Messenger;

// Stays loaded, as plugins must: their code is called by topics that they have touched.
const Plugin& load(const std::string& path) {
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw gslam::FileError(path, dlerror());
  void* const entry = dlsym(library, "gslamTestPlugin");
  if (entry == nullptr) throw gslam::FileError(path, dlerror());
  return *reinterpret_cast<const Plugin* (*)()>(entry)();
}
const Plugin& left() {
  static const Plugin& plugin = load(GSLAM_TEST_PLUGIN_LEFT);
  return plugin;
}
const Plugin& right() {
  static const Plugin& plugin = load(GSLAM_TEST_PLUGIN_RIGHT);
  return plugin;
}

TEST(Plugins, ShareATypeWithEachOtherAndTheHost) {
  const Messenger messenger;
  left().subscribe(messenger);
  right().publish(messenger, 3);
  EXPECT_EQ(left().last(), 3);
  EXPECT_EQ(right().last(), -1);  // they are two, each with its own
  messenger.advertise<SharedPose>("pose").publish(SharedPose{4});
  EXPECT_EQ(left().last(), 4);
  int seen = 0;
  const gslam::Subscriber host =
      messenger.subscribe<SharedPose>("pose", [&](const SharedPose& pose) { seen = pose.x; });
  right().publish(messenger, 5);
  EXPECT_EQ(seen, 5);
  left().end();
  right().publish(messenger, 6);
  EXPECT_EQ(left().last(), 5);
}

TEST(Plugins, TypesOfUnnamedNamespacesAreDifferent) {
  const Messenger messenger;
  left().publishHidden(messenger);
  left().publishHidden(messenger);
  EXPECT_THROW(right().publishHidden(messenger), gslam::TypeMismatch);
}

TEST(Plugins, CallbackMayEndItsSubscriptionWhereverItIsCalledFrom) {
  const Messenger messenger;
  left().subscribeOnce(messenger);
  const auto publisher = messenger.advertise<SharedPose>("pose");
  publisher.publish(SharedPose{7});
  publisher.publish(SharedPose{8});
  EXPECT_EQ(left().last(), 7);
  left().subscribeOnce(messenger);
  right().publish(messenger, 9);
  right().publish(messenger, 10);
  EXPECT_EQ(left().last(), 9);
}

TEST(Plugins, GetTheDefaultMessengerOfTheirHost) {
  const Messenger messenger;
  left().subscribe(messenger);
  right().publishToDefault(11);
  EXPECT_NE(left().last(), 11);
  right().setDefault(messenger);
  right().publishToDefault(12);
  EXPECT_EQ(left().last(), 12);
  left().end();
  right().setDefault(Messenger());
}

}  // namespace
