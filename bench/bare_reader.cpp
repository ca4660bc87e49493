// SPDX-License-Identifier: Apache-2.0
// Waits for bytes at the given ttys, reads the time and the bytes, and does nothing with them, until it is killed:
// what the kernel alone costs. bench/vehicle_footprint compares navcald with it.
#include <fcntl.h>
#include <sys/epoll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <ctime>

int main(int argc, char** argv) {
  const int waiting = epoll_create1(0);
  for (int i = 1; i < argc; ++i) {
    const int fd = open(argv[i], O_RDWR | O_NOCTTY | O_NONBLOCK);
    termios settings{};
    if (fd < 0 || tcgetattr(fd, &settings) != 0) {
      std::perror(argv[i]);
      return 1;
    }
    cfmakeraw(&settings);
    tcsetattr(fd, TCSANOW, &settings);
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = fd;
    epoll_ctl(waiting, EPOLL_CTL_ADD, fd, &event);
  }
  std::array<epoll_event, 16> events{};
  std::array<std::uint8_t, 4096> bytes{};
  for (;;) {
    const int ready = epoll_wait(waiting, events.data(), static_cast<int>(events.size()), -1);
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    for (int i = 0; i < ready; ++i) {
      if (read(events[static_cast<std::size_t>(i)].data.fd, bytes.data(), bytes.size()) == 0) return 0;
    }
  }
}
