// SPDX-License-Identifier: Apache-2.0
#include "ports/raw_mode.h"

#include <gtest/gtest.h>

namespace navcal::ports {
namespace {

TEST(RawMode, SpeedsOfTheDevicesHaveConstantsBothWays) {
  for (const int baud :
       {300, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600, 1000000, 4000000}) {
    const auto speed = speed_constant(baud);
    ASSERT_TRUE(speed) << baud;
    EXPECT_EQ(baud_of(*speed), baud);
  }
  EXPECT_FALSE(speed_constant(12345));
  EXPECT_EQ(baud_of(B0), 0);
}

TEST(RawMode, UndoesEveryKindOfInterference) {
  termios settings{};
  settings.c_iflag = ICRNL | IXON | IXOFF | IXANY | INLCR | IGNCR | ISTRIP | BRKINT | PARMRK;
  settings.c_oflag = OPOST | ONLCR;
  settings.c_lflag = ICANON | ECHO | ISIG | IEXTEN;
  settings.c_cflag = CS7 | PARENB | CSTOPB | CRTSCTS | HUPCL;
  settings.c_cc[VTIME] = 5;
  make_raw(settings);
  EXPECT_EQ(settings.c_iflag, 0U);
  EXPECT_EQ(settings.c_oflag & OPOST, 0U);
  EXPECT_EQ(settings.c_lflag, 0U);
  EXPECT_EQ(settings.c_cflag, static_cast<tcflag_t>(CS8 | CLOCAL | CREAD));
  EXPECT_EQ(settings.c_cc[VMIN], 1);
  EXPECT_EQ(settings.c_cc[VTIME], 0);
}

TEST(RawMode, RefusedByWhatIsNoTerminal) { EXPECT_FALSE(set_raw(-1, 9600)); }

}  // namespace
}  // namespace navcal::ports
