// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/signalk.h"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/random_generator.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "web/outlets/signalk_feed.h"

namespace navcal::web {
namespace {

constexpr std::string_view kStreamPath = "/signalk/v1/stream";

Handler signalk_answer(std::string body) {
  return [body = std::move(body)](const Request&) -> boost::asio::awaitable<Response> {
    co_return respond_json(boost::beast::http::status::ok, body);
  };
}

}  // namespace

SignalK::SignalK(Hub& hub, Site& site, std::string vessel, std::string version)
    : feed_(std::make_shared<SignalKFeed>(hub, "vessels." + std::move(vessel), version)) {
  site.add("GET", "/signalk",
           [version = std::move(version)](const Request& request) -> boost::asio::awaitable<Response> {
             const auto host = request[boost::beast::http::field::host];
             co_return respond_json(boost::beast::http::status::ok,
                                    signalk_discovery({host.data(), host.size()}, version));
           });
  site.add("GET", "/signalk/v1/api/self", signalk_answer(nlohmann::json(feed_->self()).dump()));
  WebSocketEndpoint stream;
  stream.path = kStreamPath;
  stream.make_peer = [feed = feed_](PeerLink& link, std::string_view target) -> std::unique_ptr<Peer> {
    return std::make_unique<SignalKPeer>(feed, link, target);
  };
  site.add(std::move(stream));
}

SignalK::~SignalK() { feed_->detach(); }

std::string default_vessel() {
  // A namespace of navcal's own, so that the same machine has another name with other programs.
  const auto own = boost::uuids::string_generator()("5d0e3a52-2a0f-4a6e-9c1b-6e61766c6163");
  std::ifstream in("/etc/machine-id");
  std::string machine;
  boost::uuids::uuid id = in && std::getline(in, machine) && !machine.empty()
                              ? boost::uuids::name_generator_sha1(own)(machine)
                              : boost::uuids::random_generator()();
  // Signal K takes version 4 only.
  id.data[6] = static_cast<std::uint8_t>((id.data[6] & 0x0F) | 0x40);
  return "urn:mrn:signalk:uuid:" + boost::uuids::to_string(id);
}

std::string problem_of_vessel(const std::string& vessel) {
  const std::string_view name(vessel);
  constexpr std::string_view kMmsi = "urn:mrn:imo:mmsi:", kUuid = "urn:mrn:signalk:uuid:";
  const auto all_of = [](std::string_view text, std::string_view characters) {
    return text.find_first_not_of(characters) == std::string_view::npos;
  };
  if (name.starts_with(kMmsi) && name.size() == kMmsi.size() + 9 &&
      all_of(name.substr(kMmsi.size()), "0123456789"))
    return {};
  if (name.starts_with(kUuid) && name.size() == kUuid.size() + 36 &&
      all_of(name.substr(kUuid.size()), "0123456789abcdefABCDEF-"))
    return {};
  return "wants urn:mrn:imo:mmsi:NINE_DIGITS or urn:mrn:signalk:uuid:UUID";
}

std::string signalk_discovery(std::string_view host, std::string_view version) {
  nlohmann::ordered_json answer;
  answer["endpoints"]["v1"] = {{"version", "1.7.0"},
                               {"signalk-http", "http://" + std::string(host) + "/signalk/v1/api/"},
                               {"signalk-ws", "ws://" + std::string(host) + std::string(kStreamPath)}};
  answer["server"] = {{"id", "navcal-web"}, {"version", version}};
  return answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace navcal::web
