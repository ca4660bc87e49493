// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/mavlink.h"

#include <boost/asio/steady_timer.hpp>
#include <cstdio>
#include <optional>
#include <vector>

#include "config/load.h"
#include "config/network_address.h"
#include "link/key.h"
#include "ports/port.h"
#include "protocols/mavlink.h"
#include "protocols/mavlink_signer.h"
#include "protocols/wire_fields.h"
#include "web/outlets/mavlink_messages.h"

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

class Mavlink final : public Subscriber, private ports::PortListener {
 public:
  Mavlink(const boost::asio::any_io_executor& executor, const MavlinkOptions& options, Hub& hub,
          MavlinkCounters& counters)
      : options_(options), hub_(hub), counters_(counters), timer_(executor),
        messages_(options, [this](std::uint32_t id, protocols::Bytes payload) { send(id, payload); }),
        port_(executor, settings_of(options), *this) {
    if (!options.key_file.empty()) signer_.emplace(link::Key::from_file(options.key_file).of_mavlink());
    hub_.add(*this, {false, {"/nav", "/time", "/health", "/event"}, std::nullopt});
    port_.start();
    wait();
  }
  ~Mavlink() override { hub_.remove(*this); }
  Mavlink(const Mavlink&) = delete;
  Mavlink& operator=(const Mavlink&) = delete;

  void on_record(const Record& record) override { messages_.take(record, Pacer::Clock::now()); }

 private:
  void wait() {
    timer_.expires_after(std::chrono::seconds(1));
    timer_.async_wait([this](boost::system::error_code error) {
      if (!error) tick();
    });
  }
  void tick() {
    messages_.tick();
    counters_.has_position = messages_.problem().empty();
    if (told_ != messages_.problem()) {
      told_ = messages_.problem();
      tell(told_.empty() ? "the position goes out" : "no position goes out: " + told_);
    }
    send(mavlink::encode_heartbeat(sender(), kOnboardController));
    wait();
  }
  mavlink::Sender sender() { return {options_.system, options_.component, sequence_++}; }
  void send(std::uint32_t id, protocols::Bytes payload) { send(mavlink::encode(id, sender(), payload)); }
  void send(std::vector<std::uint8_t> frame) {
    if (signer_) signer_->sign(frame);
    port_.send(frame);
  }

  void on_opened(std::int64_t /*now_ns*/, const ports::OpenPort& port) override {
    counters_.open = true;
    tell(port.path + " is open");
  }
  void on_lost(std::int64_t /*now_ns*/, std::string_view reason) override {
    counters_.open = false;
    tell(std::string(reason));
  }
  void on_sent(std::int64_t /*now_ns*/, protocols::Bytes bytes) override {
    sent_.feed(bytes, [this](const protocols::Frame&) { ++counters_.sent; });
  }
  void on_dropped(protocols::Bytes bytes) override {
    dropped_.feed(bytes, [this](const protocols::Frame&) { ++counters_.dropped; });
  }
  // PX4 asks for our clock, by which it understands our times: that of the times that are sent.
  void on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) override {
    received_.feed(bytes, [&](const protocols::Frame& frame) {
      ++counters_.received;
      if (signer_ && signer_->check(frame.bytes) != mavlink::Signer::Verdict::good) {
        ++counters_.refused;
        return;
      }
      const auto message = mavlink::find_message(frame.bytes).message;
      const mavlink::Payload asked(message.payload);
      if (message.id != kTimesync || asked.at<std::int64_t>(0) != 0 || !messages_.mapping()) return;
      send(kTimesync, protocols::packed_le(arrival_ns + messages_.mapping()->offset_ns, asked.at<std::int64_t>(8),
                                           message.system, message.component));
    });
  }

  MavlinkOptions options_;
  Hub& hub_;
  MavlinkCounters& counters_;
  boost::asio::steady_timer timer_;
  MavlinkMessages messages_;
  std::optional<mavlink::Signer> signer_;
  mavlink::Parser sent_, dropped_, received_;
  std::uint8_t sequence_ = 0;
  std::string told_;
  ports::Port port_;
};

}  // namespace

std::unique_ptr<Subscriber> make_mavlink(const boost::asio::any_io_executor& executor,
                                         const MavlinkOptions& options, Hub& hub, MavlinkCounters& counters) {
  return std::make_unique<Mavlink>(executor, options, hub, counters);
}

std::string problem_of_mavlink_address(const std::string& text) {
  const auto address = config::parse_network_address(text);
  const bool is_good =
      address ? address->kind != config::NetworkAddress::Kind::unix_listen : text.starts_with('/');
  return is_good ? ""
                 : "wants udp:ADDRESS:PORT, tcp:HOST:PORT, tcp-listen:ADDRESS:PORT or the path of a serial port";
}

}  // namespace navcal::web
