// SPDX-License-Identifier: Apache-2.0
#include "record/port_matching.h"

#include <gtest/gtest.h>

#include "config/load.h"
#include "tests/record/sample_log.h"

namespace navcal::record {
namespace {

TEST(PortMatch, PortsAreThoseOfTheSameNameAndOthersAreMissing) {
  const auto recorded = testing::sample_settings();  // compass, imu
  config::Settings used;
  used.ports.push_back(config::default_port("gps", protocols::Protocol::nmea, 9600));
  used.ports.push_back(config::default_port("imu", protocols::Protocol::imu_card, 57600));
  const PortMatch match(recorded, used);
  EXPECT_EQ(match[0], std::nullopt);
  EXPECT_EQ(match[1], 1);
  EXPECT_EQ(match.remarks("a.cap"),
            std::vector<std::string>{"a.cap: port compass is not in the configuration: left out"});
  EXPECT_THROW((void)match[2], std::out_of_range);
  const PortMatch same(recorded, recorded);
  EXPECT_EQ(same[0], 0);
  EXPECT_EQ(same[1], 1);
  EXPECT_TRUE(same.remarks("a.cap").empty());
}

}  // namespace
}  // namespace navcal::record
