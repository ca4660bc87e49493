// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/signalk.h"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/random_generator.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/utc_text.h"
#include "web/http.h"

namespace navcal::web {
namespace {

using nlohmann::json;

/// Version of the specification that this server follows.
constexpr std::string_view kSignalKVersion = "1.7.0";
constexpr double kSignalKRate_Hz = 10;

std::string signalk_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return base::utc_text(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

json signalk_source(const std::string& device) {
  json source{{"label", "navcal"}, {"type", "navcal"}};
  if (!device.empty()) source["src"] = device;
  return source;
}

std::string as_message(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

constexpr std::string_view kStreamPath = "/signalk/v1/stream";

Handler signalk_answer(std::string body) {
  return [body = std::move(body)](const Request&) -> boost::asio::awaitable<Response> {
    co_return respond_json(boost::beast::http::status::ok, body);
  };
}

}  // namespace

SignalKPeer::SignalKPeer(std::shared_ptr<SignalKFeed> feed, PeerLink& link, std::string_view target)
    : feed_(std::move(feed)), link_(link), subscriptions_(feed_->self()) {
  // "self" is what a client gets that does not say; of other vessels nothing is known, so that "all" is the same.
  if (query_value(target, "subscribe") != "none") subscriptions_.subscribe("*", SignalKSubscriptions::kMinPeriod);
}

SignalKPeer::~SignalKPeer() { feed_->remove(*this); }

void SignalKPeer::on_open() {
  link_.send_text(feed_->hello());
  feed_->add(*this);
  offer(feed_->newest());
}

void SignalKPeer::on_text(std::string_view text) {
  const auto outcome = subscriptions_.take(text);
  if (outcome.reply) link_.send_text(*outcome.reply);
  if (outcome.has_new) offer(feed_->newest());
}

void SignalKPeer::offer(const std::vector<SignalKUpdate>& updates) {
  const auto now = SignalKSubscriptions::Clock::now();
  json sent = json::array();
  for (const SignalKUpdate& update : updates) {
    json values = json::array(), metas = json::array();
    for (const SignalKValue& one : update.values) {
      // A value that is lost is told at once, whatever the period of the subscription.
      if (one.value.is_null() ? !subscriptions_.is_wanted(one.path) : !subscriptions_.is_due(one.path, now))
        continue;
      values.push_back({{"path", one.path}, {"value", one.value}});
      if (!described_.insert(one.path).second) continue;
      if (json meta = signalk_meta(one.path); !meta.is_null())
        metas.push_back({{"path", one.path}, {"value", std::move(meta)}});
    }
    if (values.empty()) continue;
    json entry{{"source", signalk_source(update.device)}, {"values", std::move(values)}};
    if (update.utc_ns) entry["timestamp"] = base::utc_text(*update.utc_ns);
    if (!metas.empty()) entry["meta"] = std::move(metas);
    sent.push_back(std::move(entry));
  }
  if (!sent.empty()) link_.send_text(as_message({{"context", feed_->self()}, {"updates", std::move(sent)}}));
}

SignalKFeed::SignalKFeed(Hub& hub, std::string self, std::string version)
    : hub_(&hub), self_(std::move(self)), version_(std::move(version)) {}

void SignalKFeed::add(SignalKPeer& peer) {
  const bool is_first = peers_.empty();
  peers_.insert(&peer);
  if (!is_first || hub_ == nullptr) return;
  Demand demand{false, {}, kSignalKRate_Hz};
  demand.topics.insert(std::begin(SignalKModel::kTopics), std::end(SignalKModel::kTopics));
  hub_->add(*this, std::move(demand));
  hub_->repeat_newest(*this);
}

void SignalKFeed::remove(SignalKPeer& peer) {
  peers_.erase(&peer);
  if (!peers_.empty() || hub_ == nullptr) return;
  hub_->remove(*this);
  [[maybe_unused]] const auto forgotten = model_.forget();
}

void SignalKFeed::detach() {
  if (hub_ != nullptr) hub_->remove(*this);
  hub_ = nullptr;
}

std::string SignalKFeed::hello() const {
  return as_message({{"name", "navcal-web"},
                     {"version", kSignalKVersion},
                     {"self", self_},
                     {"roles", {"master", "main"}},
                     {"timestamp", signalk_now()}});
}

void SignalKFeed::on_record(const Record& record) { publish(model_.take(record)); }

void SignalKFeed::on_link(const Link& link) {
  if (!link.connected) publish(model_.forget());
}

void SignalKFeed::publish(SignalKUpdate update) {
  if (update.values.empty()) return;
  const std::vector<SignalKUpdate> updates{std::move(update)};
  for (SignalKPeer* peer : std::vector(peers_.begin(), peers_.end())) {
    if (peers_.contains(peer)) peer->offer(updates);
  }
}

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
