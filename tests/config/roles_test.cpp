// SPDX-License-Identifier: Apache-2.0
// [roles]: which port serves what.
#include "config/roles.h"

#include <algorithm>

#include "protocols/device_types.h"
#include "tests/config/expect_problems.h"

namespace navcal::config {
namespace {

using protocols::kDeviceTypes;

constexpr std::string_view kPorts =
    "[port.compass]\nprotocol = \"tcm2\"\npath = \"/dev/ttyS1\"\n"
    "[port.gyrocompass]\nprotocol = \"nmea\"\npath = \"/dev/ttyS2\"\n"
    "[port.card]\nprotocol = \"imu-card\"\npath = \"/dev/ttyS3\"\n";

Problems problems_with(std::string_view roles, const Overrides& overrides = {}) {
  return problems_of(std::string("[roles]\n").append(roles).append(kPorts), overrides);
}

TEST(ConfigRoles, APortThatCanDeliverIsTaken) {
  const Settings settings =
      parse(std::string("[roles]\nheading = \"gyrocompass\"\n").append(kPorts), "t.toml", {});
  EXPECT_EQ(settings.roles.port_name(Role::heading), "gyrocompass");
  EXPECT_EQ(settings.roles.port_name(Role::position), "");
  EXPECT_EQ(parse(to_toml(settings), "again", {}), settings);
}

TEST(ConfigRoles, APortThatIsNotThereIsNamedWithTheOneThatWasMeant) {
  EXPECT_EQ(problems_with("heading = \"compas\"\n"),
            Problems{"t.toml:2: roles.heading: there is no port compas; did you mean compass?"});
  EXPECT_EQ(problems_with("heading = \"Not A Name\"\n"),
            Problems{"t.toml:2: roles.heading: \"Not A Name\" is not a port's name, or nothing"});
}

TEST(ConfigRoles, APortThatCannotDeliverSaysWhy) {
  EXPECT_EQ(problems_with("field = \"gyrocompass\"\n"),
            Problems{"t.toml:2: roles.field: port gyrocompass is of protocol nmea, which has no field"});
  EXPECT_EQ(problems_with("heading = \"compass\"\n", {"roles.depth=compass"}),
            Problems{"--set: roles.depth: port compass is of protocol tcm2, which has no depth"});
}

TEST(ConfigRoles, AnAutopilotIsNoReferenceOfItsOwnCompass) {
  EXPECT_TRUE(can_deliver(protocols::Protocol::mavlink, Role::heading));
  EXPECT_FALSE(can_deliver(protocols::Protocol::mavlink, Role::heading_reference));
}

TEST(ConfigRoles, AnUnknownRoleIsFound) {
  EXPECT_EQ(problems_with("headin = \"compass\"\n"),
            Problems{"t.toml:2: roles.headin: unknown key; did you mean heading?"});
}

TEST(ConfigRoles, EveryRoleHasAProtocolAndEveryProtocolARole) {
  for (const Role role : kRoles) {
    EXPECT_TRUE(std::any_of(kDeviceTypes.begin(), kDeviceTypes.end(), [&](const auto& device) {
      return can_deliver(device.protocol, role);
    })) << name_of(role);
    EXPECT_EQ(leader_of(leader_of(role)), leader_of(role)) << name_of(role);
  }
  for (const auto& device : kDeviceTypes) {
    EXPECT_TRUE(std::any_of(kRoles.begin(), kRoles.end(), [&](Role role) {
      return can_deliver(device.protocol, role);
    })) << device.name;
  }
}

}  // namespace
}  // namespace navcal::config
