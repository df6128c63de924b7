#include <gslam/odometer.h>

#include <iostream>

int main() {
  gslam::Odometer odometer;
  odometer.add({0, 0, 0});
  odometer.add({3, 4, 0});
  std::cout << odometer.length() << " m\n";
}
