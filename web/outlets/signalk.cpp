// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/signalk.h"

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/random_generator.hpp>
#include <boost/uuid/string_generator.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/utc_text.h"
#include "web/http.h"
#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

/// Paths of Signal K are shorter.
constexpr std::size_t kMaxPattern = 200;
/// Paths of this server are fewer.
constexpr std::size_t kMaxPacers = 256;
constexpr double kMaxPeriod_ms = 3'600'000;
constexpr std::string_view kSelf = "vessels.self";

/// Period of one entry of `subscribe`. The policy "fixed" repeats at `period`; the others send what is new, at
/// most once in `minPeriod`.
std::chrono::milliseconds signalk_period(const nlohmann::json& entry) {
  const bool is_fixed = text_in(entry, "policy") == "fixed" || !entry.contains("minPeriod");
  const char* key = is_fixed && text_in(entry, "policy") != "instant" ? "period" : "minPeriod";
  const double period_ms = number_in(entry, key).value_or(0);
  return std::chrono::milliseconds(static_cast<long>(std::clamp(period_ms, 0.0, kMaxPeriod_ms)));
}

std::optional<std::string> refusal_of_request(const nlohmann::json& message) {
  const std::string id = text_in(message, "requestId");
  if (id.empty() || id.size() > kMaxPattern) return std::nullopt;
  if (!message.contains("put") && !message.contains("delete") && !message.contains("login")) return std::nullopt;
  return json_text({{"requestId", id},
                    {"state", "COMPLETED"},
                    {"statusCode", 405},
                    {"message", "navcal-web is read-only for Signal K"}});
}

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

constexpr std::string_view kStreamPath = "/signalk/v1/stream";

}  // namespace

bool matches_pattern(std::string_view pattern, std::string_view path) {
  std::size_t p = 0, t = 0;
  std::size_t star = std::string_view::npos, retry = 0;
  while (t < path.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = t;
    } else if (p < pattern.size() && pattern[p] == path[t]) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

SignalKSubscriptions::Outcome SignalKSubscriptions::take(std::string_view text) {
  Outcome outcome;
  const auto message = nlohmann::json::parse(text, nullptr, false);
  if (!message.is_object()) return outcome;
  if (is_self(message)) {
    take_unsubscribe(member_of(message, "unsubscribe"));
    outcome.has_new = take_subscribe(member_of(message, "subscribe"));
  }
  outcome.reply = refusal_of_request(message);
  return outcome;
}

void SignalKSubscriptions::subscribe(std::string pattern, Clock::duration period) {
  period = std::max<Clock::duration>(period, kMinPeriod);
  for (Wanted& wanted : wanted_) {
    if (wanted.pattern != pattern) continue;
    wanted.period = period;
    return;
  }
  if (wanted_.size() < kMaxPatterns) wanted_.push_back({std::move(pattern), period});
}

bool SignalKSubscriptions::is_due(std::string_view path, Clock::time_point now) {
  const auto period = period_of(path);
  if (!period) return false;
  auto found = pacers_.find(path);
  if (found == pacers_.end()) {
    if (pacers_.size() >= kMaxPacers) return false;
    found = pacers_.emplace(path, Pacer()).first;
  }
  return found->second.pass(now, *period);
}

/// Without a context a message is about this vessel.
bool SignalKSubscriptions::is_self(const nlohmann::json& message) const {
  if (!message.contains("context")) return true;
  const std::string context = text_in(message, "context");
  return matches_pattern(context.substr(0, kMaxPattern), self_) || context == kSelf;
}

bool SignalKSubscriptions::take_subscribe(const nlohmann::json& list) {
  if (!list.is_array()) return false;
  bool has_new = false;
  for (const auto& entry : list) {
    std::string path = entry.is_object() ? text_in(entry, "path") : std::string();
    if (path.empty() || path.size() > kMaxPattern) continue;
    subscribe(std::move(path), signalk_period(entry));
    has_new = true;
  }
  return has_new;
}

void SignalKSubscriptions::take_unsubscribe(const nlohmann::json& list) {
  if (!list.is_array()) return;
  for (const auto& entry : list) {
    const std::string path = entry.is_object() ? text_in(entry, "path") : std::string();
    if (path.empty() || path.size() > kMaxPattern) continue;
    std::erase_if(wanted_, [&](const Wanted& wanted) { return matches_pattern(path, wanted.pattern); });
  }
}

/// The shortest period of the patterns that match.
std::optional<SignalKSubscriptions::Clock::duration> SignalKSubscriptions::period_of(std::string_view path) const {
  std::optional<Clock::duration> period;
  for (const Wanted& wanted : wanted_) {
    if ((!period || wanted.period < *period) && matches_pattern(wanted.pattern, path)) period = wanted.period;
  }
  return period;
}

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
  if (!sent.empty()) link_.send_text(json_text({{"context", feed_->self()}, {"updates", std::move(sent)}}));
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
  hub_->repeat_newest([this](const Record& record) { on_record(record); });
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
  return json_text({{"name", "navcal-web"},
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

std::shared_ptr<SignalKFeed> add_signalk(Hub& hub, Site& site, const std::string& vessel,
                                         const std::string& version) {
  auto feed = std::make_shared<SignalKFeed>(hub, "vessels." + vessel, version);
  site.add("GET", "/signalk", [version](const Request& request) -> boost::asio::awaitable<Response> {
    const auto host = request[boost::beast::http::field::host];
    co_return respond_json(boost::beast::http::status::ok, signalk_discovery({host.data(), host.size()}, version));
  });
  site.add("GET", "/signalk/v1/api/self", json_handler(nlohmann::json(feed->self()).dump()));
  site.add({.path = std::string(kStreamPath),
            .make_peer = [feed](PeerLink& link, std::string_view target) -> std::unique_ptr<Peer> {
              return std::make_unique<SignalKPeer>(feed, link, target);
            }});
  return feed;
}

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
  return json_text(answer);
}

}  // namespace navcal::web
