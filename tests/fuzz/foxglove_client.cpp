// SPDX-License-Identifier: Apache-2.0
// Whatever a client of Foxglove's protocol sends, between records, losses of the link and changes of topics: every
// answer is well-formed, and nothing goes to a subscription that it does not have.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <string_view>

#include "tests/fuzz/target.h"
#include "tests/web/foxglove_link.h"
#include "web/foxglove/peer.h"

namespace navcal::fuzz::foxglove_client_target {

using navcal::web::foxglove::FakeLink;

void check_answers(FakeLink& link, std::set<std::uint32_t>& channels) {
  for (const auto& payload : link.sent) {
    if (payload.binary) {
      const std::size_t least = (*payload.bytes)[0] == 1 ? 13 : 9;
      if (payload.bytes->size() < least || (least == 9 && (*payload.bytes)[0] != 2)) std::abort();
      continue;
    }
    const auto json = nlohmann::json::parse(*payload.bytes);
    if (json.at("op") == "advertise") {
      for (const auto& channel : json.at("channels")) {
        if (!channels.insert(channel.at("id").get<std::uint32_t>()).second) std::abort();
      }
    } else if (json.at("op") == "unadvertise") {
      for (const auto& id : json.at("channelIds")) {
        if (channels.erase(id.get<std::uint32_t>()) == 0) std::abort();
      }
    } else if (json.at("op") == "status" && json.at("message").get<std::string>().size() > 400) {
      std::abort();
    }
  }
  link.sent.clear();
}

NAVCAL_FUZZ(foxglove_client) {
  using namespace navcal::web;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  Hub hub;
  hub.set_link({true, ""});
  const std::vector<Topic> few{{"/gps", "navcal.Gps", "{}"}};
  const std::vector<Topic> all{
      {"/gps", "navcal.Gps", "{}"}, {"/nav", "navcal.Nav", "{}"}, {"/event", "navcal.Event", "{}"}};
  hub.set_topics(all);
  FakeLink link;
  const auto peer = foxglove::endpoint(hub, "0", [] { return std::int64_t{1}; }).make_peer(link, "/");
  peer->on_open();
  std::set<std::uint32_t> channels;
  std::int64_t time_ns = 0;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const char what = line.empty() ? '\0' : line.front();
    const std::string_view rest = line.empty() ? line : line.substr(1);
    if (what == 'r') hub.publish({"/gps", "gps", time_ns += 1'000'000, rest});
    if (what == 'n') hub.publish({"/nav", "navigation", std::nullopt, rest});
    if (what == 'e') hub.publish({"/event", "", time_ns, rest});
    if (what == 't') hub.set_topics(rest.empty() ? few : all);
    if (what == 'l') hub.set_link({!hub.link().connected, std::string(rest.size() % 300, 'x')});
    if (what == 'f') link.is_full = !link.is_full;
    if (what == 'd' && !link.is_full) peer->on_drained();
    if (what == 'b') peer->on_binary(rest);
    if (what == '{' || what == '[') peer->on_text(line);
    check_answers(link, channels);
    if (!hub.link().connected && !link.is_full && what == 'l' && !channels.empty()) std::abort();
  }
  return 0;
}

}  // namespace navcal::fuzz::foxglove_client_target
