// A plugin that is part of the program; plugins_test.cpp sees it.
#define GSLAM_STATIC_PLUGINS
#include <gslam/core/plugin.h>

#include <memory>

GSLAM_PLUGIN(linked, "1.0.0", "Linked into the program") {
  gslam::ApplicationFactory application;
  application.name = "linked_app";
  application.make = [] { return std::unique_ptr<gslam::Application>(); };
  registry.add(application);
}

GSLAM_USE_STATIC_PLUGIN(linked);
