// SPDX-License-Identifier: Apache-2.0
#include "ports/raw_mode.h"

#include <algorithm>
#include <array>
#include <utility>

namespace navcal::ports {
namespace {

constexpr std::array kSpeeds{
    std::pair{300, speed_t{B300}},         std::pair{600, speed_t{B600}},
    std::pair{1200, speed_t{B1200}},       std::pair{2400, speed_t{B2400}},
    std::pair{4800, speed_t{B4800}},       std::pair{9600, speed_t{B9600}},
    std::pair{19200, speed_t{B19200}},     std::pair{38400, speed_t{B38400}},
    std::pair{57600, speed_t{B57600}},     std::pair{115200, speed_t{B115200}},
    std::pair{230400, speed_t{B230400}},   std::pair{460800, speed_t{B460800}},
    std::pair{921600, speed_t{B921600}},   std::pair{1000000, speed_t{B1000000}},
    std::pair{1500000, speed_t{B1500000}}, std::pair{2000000, speed_t{B2000000}},
    std::pair{3000000, speed_t{B3000000}}, std::pair{4000000, speed_t{B4000000}},
};

}  // namespace

std::optional<speed_t> speed_constant(int baud) {
  const auto found = std::ranges::find_if(kSpeeds, [&](auto& entry) { return entry.first == baud; });
  if (found == kSpeeds.end()) return std::nullopt;
  return found->second;
}

int baud_of(speed_t speed) {
  const auto found = std::ranges::find_if(kSpeeds, [&](auto& entry) { return entry.second == speed; });
  return found == kSpeeds.end() ? 0 : found->first;
}

void make_raw(termios& settings) {
  cfmakeraw(&settings);
  settings.c_iflag &= ~static_cast<tcflag_t>(IXOFF | IXANY);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSIZE | PARENB | CSTOPB | CRTSCTS | HUPCL);
  settings.c_cflag |= CS8 | CLOCAL | CREAD;
  // VMIN must not be 0: an empty queue would read as 0 bytes, the same as the end of the device.
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
}

bool set_raw(int fd, int baud) {
  termios settings{};
  if (tcgetattr(fd, &settings) != 0) return false;
  make_raw(settings);
  if (const auto speed = speed_constant(baud)) cfsetspeed(&settings, *speed);
  // TCSANOW, never TCSAFLUSH: a device that spoke before we were ready has still been heard.
  return tcsetattr(fd, TCSANOW, &settings) == 0;
}

}  // namespace navcal::ports
