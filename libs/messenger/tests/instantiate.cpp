// Instantiates the templates of GSLAM::messenger; compiled alone under every compiler and standard
// by tests/headers.
#include <gslam/messenger.h>

template class gslam::Publisher<int>;

void instantiateMessenger(const gslam::Messenger& messenger);

void instantiateMessenger(const gslam::Messenger& messenger) {
  messenger.subscribe<int>("/n", [](const std::shared_ptr<const int>&) {}).keep();
  messenger.advertise<int>("/n").publish(1);
}
