// SPDX-License-Identifier: Apache-2.0
#include "web/site.h"

#include <gtest/gtest.h>

namespace navcal::web {
namespace {

WebSocketEndpoint endpoint_at(std::string path, std::vector<std::string> subprotocols) {
  WebSocketEndpoint endpoint;
  endpoint.path = std::move(path);
  endpoint.subprotocols = std::move(subprotocols);
  return endpoint;
}

TEST(Site, AWrongMethodIsToldFromAnUnknownPath) {
  Site site;
  site.add("GET", "/metrics", {});
  bool exists = false;
  EXPECT_NE(site.handler("GET", "/metrics", exists), nullptr);
  EXPECT_NE(site.handler("HEAD", "/metrics", exists), nullptr);
  EXPECT_EQ(site.handler("POST", "/metrics", exists), nullptr);
  EXPECT_TRUE(exists);
  EXPECT_EQ(site.handler("GET", "/metric", exists), nullptr);
  EXPECT_FALSE(exists);
  EXPECT_EQ(site.handler("GET", "/metrics2", exists), nullptr);
  EXPECT_FALSE(exists);
}

TEST(Site, TheClientsFirstKnownSubprotocolIsChosen) {
  Site site;
  site.add(endpoint_at("/", {"foxglove.sdk.v1", "foxglove.websocket.v1"}));
  site.add(endpoint_at("/live", {}));
  std::string chosen;
  EXPECT_NE(site.endpoint("/", "other, foxglove.websocket.v1, foxglove.sdk.v1", chosen), nullptr);
  EXPECT_EQ(chosen, "foxglove.websocket.v1");
  EXPECT_EQ(site.endpoint("/", "", chosen), nullptr);
  EXPECT_EQ(site.endpoint("/", "other", chosen), nullptr);
  EXPECT_NE(site.endpoint("/live", "", chosen), nullptr);
  EXPECT_EQ(chosen, "");
  EXPECT_EQ(site.endpoint("/live", "something", chosen), nullptr);
  EXPECT_EQ(site.endpoint("/nothing", "", chosen), nullptr);
}

}  // namespace
}  // namespace navcal::web
