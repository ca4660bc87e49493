// SPDX-License-Identifier: Apache-2.0
// A node with a reliable reader of Imu, which the test stops and lets go on.
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "tests/ros2/fast_peer.h"

int main(int count, char** arguments) {
  using namespace navcal::ros2::test;
  if (count != 3) return 2;
  FastPeer peer(static_cast<std::uint32_t>(std::atoi(arguments[1])));
  const auto& reader = peer.read(arguments[2], "sensor_msgs::msg::dds_::Imu_", FastPeer::Reliability::reliable);
  for (std::size_t told = 0;;) {
    if (const std::size_t now = reader.received().size(); now > told) {
      std::printf("%zu\n", told = now);
      std::fflush(stdout);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}
