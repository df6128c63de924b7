// Shared libraries that are no plugins.
#ifdef AS_FUNCTION
extern "C" __attribute__((visibility("default"))) int gslam_plugin() {
  return 1;
}
#else
extern "C" __attribute__((visibility("default"))) int something_else() {
  return 1;
}
#endif
