// SPDX-License-Identifier: Apache-2.0
#include "ports/port_list.h"

#include <gtest/gtest.h>

namespace navcal::ports {
namespace {

TEST(PortList, ListsWithoutPseudoTerminals) {
  for (const PortInfo& port : list_ports()) {
    EXPECT_EQ(port.path.rfind("/dev/", 0), 0U) << port.path;
    EXPECT_NE(port.path.rfind("/dev/pts/", 0), 0U) << port.path;
  }
}

TEST(PortList, DescribesWhatIsKnownAndNothingElse) {
  PortInfo port;
  EXPECT_EQ(describe(port), "");
  port.description = "ttyS0";
  EXPECT_EQ(describe(port), "ttyS0");
  port.usb_product = "FT232R USB UART";
  port.usb_vid = 0x0403;
  port.usb_pid = 0x6001;
  port.usb_serial = "A50285BI";
  port.driver = "ftdi_sio";
  port.latency_timer_ms = 16;
  EXPECT_EQ(describe(port),
            "FT232R USB UART (USB 0403:6001, serial number A50285BI, driver ftdi_sio, latency timer 16 ms)");
}

}  // namespace
}  // namespace navcal::ports
