// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mavlink.h"

#include <cstdio>

#include "config/load.h"
#include "config/network_address.h"
#include "link/key.h"
#include "protocols/wire_fields.h"

namespace navcal::web {
namespace {

namespace mavlink = protocols::mavlink;
constexpr std::uint32_t kTimesync = 111;
constexpr std::uint8_t kOnboardController = 18;

config::PortSettings settings_of(const MavlinkOptions& options) {
  auto settings = config::default_port("mavlink", protocols::Protocol::mavlink, options.baud);
  (config::parse_network_address(options.address) ? settings.address : settings.path) = options.address;
  return settings;
}

void tell(const std::string& text) { std::fprintf(stderr, "navcal-web: MAVLink: %s\n", text.c_str()); }

}  // namespace

std::string problem_of_mavlink_address(const std::string& text) {
  const auto address = config::parse_network_address(text);
  const bool is_good =
      address ? address->kind != config::NetworkAddress::Kind::unix_listen : text.starts_with('/');
  return is_good ? ""
                 : "wants udp:ADDRESS:PORT, tcp:HOST:PORT, tcp-listen:ADDRESS:PORT or the path of a serial port";
}

Mavlink::Mavlink(const boost::asio::any_io_executor& executor, const MavlinkOptions& options, Hub& hub)
    : options_(options), hub_(hub), timer_(executor),
      messages_(options, [this](std::uint32_t id, protocols::Bytes payload) { send(id, payload); }),
      port_(executor, settings_of(options), *this) {
  if (!options.key_file.empty()) signer_.emplace(link::Key::from_file(options.key_file).of_mavlink());
  hub_.add(*this, {false, {"/nav", "/time", "/health", "/event"}, std::nullopt});
  port_.start();
  wait();
}

Mavlink::~Mavlink() { hub_.remove(*this); }

void Mavlink::tick() {
  messages_.tick();
  counters_.has_position = messages_.problem().empty();
  if (told_ != messages_.problem()) {
    told_ = messages_.problem();
    tell(told_.empty() ? "the position goes out" : "no position goes out: " + told_);
  }
  send(mavlink::encode_heartbeat(sender(), kOnboardController));
  wait();
}

void Mavlink::wait() {
  timer_.expires_after(std::chrono::seconds(1));
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) tick();
  });
}

void Mavlink::send(std::uint32_t id, protocols::Bytes payload) { send(mavlink::encode(id, sender(), payload)); }

void Mavlink::send(std::vector<std::uint8_t> frame) {
  if (signer_) signer_->sign(frame);
  port_.send(frame);
}

void Mavlink::on_opened(std::int64_t /*now_ns*/, const ports::OpenPort& port) {
  counters_.open = true;
  tell(port.path + " is open");
}

void Mavlink::on_lost(std::int64_t /*now_ns*/, std::string_view reason) {
  counters_.open = false;
  tell(std::string(reason));
}

void Mavlink::on_sent(std::int64_t /*now_ns*/, protocols::Bytes bytes) {
  sent_.feed(bytes, [this](const protocols::Frame&) { ++counters_.sent; });
}

void Mavlink::on_dropped(protocols::Bytes bytes) {
  dropped_.feed(bytes, [this](const protocols::Frame&) { ++counters_.dropped; });
}

// PX4 asks for our clock, by which it understands our times: that of the times that are sent.
void Mavlink::on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) {
  received_.feed(bytes, [&](const protocols::Frame& frame) {
    ++counters_.received;
    if (signer_ && signer_->check(frame.bytes) != mavlink::Signer::Verdict::good) {
      ++counters_.refused;
      return;
    }
    const auto message = mavlink::find_message(frame.bytes).message;
    const mavlink::Payload asked(message.payload);
    if (message.id != kTimesync || asked.at<std::int64_t>(0) != 0 || !messages_.mapping()) return;
    auto answer = protocols::packed_le(arrival_ns + messages_.mapping()->offset_ns, asked.at<std::int64_t>(8),
                                       message.system, message.component);
    send(kTimesync, answer);
  });
}

}  // namespace navcal::web
