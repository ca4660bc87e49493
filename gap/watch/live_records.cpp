// SPDX-License-Identifier: Apache-2.0
#include "gap/watch/live_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/angles.h"
#include "config/load.h"
#include "gap/data/mission.h"
#include "protocols/motor_card.h"
#include "record/port_matching.h"
#include "record/recording.h"

namespace navcal::gap {

void watch_recording(const std::filesystem::path& file, const std::optional<config::Settings>& settings,
                     Watch& watch, const std::function<bool(double)>& go_on) {
  const auto recording = record::Recording::open(file);
  const config::Settings& used = settings ? *settings : recording->settings();
  const record::PortMatch ports(recording->settings(), used);
  pipeline::Pipeline pipeline(samples_only(used));
  while (const auto entry = recording->next()) {
    ports.give(*entry, pipeline, watch);
    if (const auto command = record::sent_command(*entry))
      watch.on_order(std::get<record::RawRead>(*entry).time_ns, order_of(*command, 0));
    if (!go_on(recording->progress())) return;
  }
  watch.finish();
}

namespace {

using Json = nlohmann::json;

/// A pipeline of one port, at which samples come in as lines. UTC is its monotonic scale.
config::Settings samples_port() {
  constexpr auto kProtocol = protocols::Protocol::samples;
  config::Settings settings;
  settings.ports = {config::default_port("records", kProtocol, config::default_baud(kProtocol))};
  return samples_only(settings);
}

/// The payload of a record as it was sent, so that its times keep all their digits.
std::string_view message_of(std::string_view line) {
  constexpr std::string_view kKey = "\"message\":";
  const auto at = line.find(kKey);
  if (at == std::string_view::npos || line.empty()) return {};
  line.remove_prefix(at + kKey.size());
  const auto end = line.rfind('}');
  return end == std::string_view::npos ? std::string_view() : line.substr(0, end);
}

std::optional<Order> order_of(const Json& command) {
  const auto rpm = command.find("shaft_sent_rpm"), fins = command.find("fins_sent_deg");
  if (rpm == command.end() || !rpm->is_number() || fins == command.end() || !fins->is_array() || fins->size() != 3)
    return std::nullopt;
  Order order{0, rpm->get<double>(), {}};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(*fins)[i].is_number()) return std::nullopt;
    order.fins_rad[i] = (*fins)[i].get<double>() * base::kRadiansPerDegree;
  }
  return order;
}

/// Times beyond this are none of a vehicle, and do not fit into nanoseconds.
constexpr double kLatest_s = 9e9;

bool is_time(double seconds) { return seconds > 0 && seconds <= kLatest_s; }

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

/// Hands samples on, and notes the first fix.
class LiveRecords::Counting final : public pipeline::Sink {
 public:
  Counting(LiveRecords& records, std::uint16_t port, Watch* watch)
      : records_(records), port_(port), watch_(watch) {}
  void on_sample(const instruments::Sample& sample) override {
    ++records_.samples_;
    if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value); gps != nullptr && !records_.field_) {
      const bool is_fix = gps->fix == instruments::Fix::fix_2d || gps->fix == instruments::Fix::fix_3d;
      if (is_fix && gps->latitude_rad && gps->longitude_rad) {
        EarthField field;
        field.place = {*gps->latitude_rad, *gps->longitude_rad, gps->height_m.value_or(0)};
        field.utc_ns = sample.stamp.validity_ns;
        field.set_by_model();
        records_.field_ = field;
      }
    }
    if (watch_ == nullptr) return;
    instruments::Sample of_device = sample;
    of_device.port = port_;
    watch_->on_sample(of_device);
  }

 private:
  LiveRecords& records_;
  std::uint16_t port_;
  Watch* watch_;
};

std::string_view live_request() {
  return "?WATCH={\"enable\":true,\"json\":true,\"classes\":[\"RECORD\",\"HEALTH\"],"
         "\"topics\":[\"/compass\",\"/imu\",\"/gps\",\"/motor\",\"/dvl\",\"/depth\",\"/sensor\",\"/command\"]};\n";
}

LiveRecords::LiveRecords(const std::optional<config::Settings>& settings) : pipeline_(samples_port()) {
  for (std::size_t i = 0; settings && i < settings->ports.size(); ++i)
    ports_.emplace(settings->ports[i].name, static_cast<std::uint16_t>(i));
  struct NoSink final : pipeline::Sink {
  } nobody;
  pipeline::UtcMapping identity;
  identity.source = pipeline::UtcMapping::Source::file;
  identity.bound_ns = 0;
  pipeline_.set_mapping(identity, nobody);
}

void LiveRecords::take(std::string_view line, Watch* watch) {
  try {
    take_record(line, watch);
  } catch (const Json::exception&) {
    ++bad_;
  }
}

void LiveRecords::take_record(std::string_view line, Watch* watch) {
  const Json json = Json::parse(line);
  if (!json.is_object()) {
    ++bad_;
    return;
  }
  const std::string of = json.value("class", "");
  if (of == "HEALTH") {
    if (const auto lost = json.find("dropped"); lost != json.end() && lost->is_number_unsigned())
      dropped_ = lost->get<std::uint64_t>();
    return;
  }
  if (of != "RECORD") return;
  if (json.at("topic") == "/command") {
    const Json& command = json.at("message");
    const auto order = order_of(command);
    const auto sent = command.find("sent");
    if (!order || sent == command.end() || !sent->is_number()) return;  // a refused order moves nothing
    const double sent_s = sent->get<double>();
    if (!is_time(sent_s)) {
      ++bad_;
    } else if (watch != nullptr) {
      watch->on_order(nanoseconds(sent_s), *order);
    }
    return;
  }
  const auto port = ports_.find(json.value("device", ""));
  const double time_s = json.at("time").get<double>();
  if (!is_time(time_s) || (!ports_.empty() && port == ports_.end())) {
    ++bad_;
    return;
  }
  // Arrivals never decrease; the time in the message places the sample.
  newest_ns_ = std::max(newest_ns_, nanoseconds(time_s));
  const std::string_view message = message_of(line);
  const std::array<std::uint8_t, 1> end{'\n'};
  const std::uint64_t before = samples_;
  Counting sink(*this, port == ports_.end() ? 0 : port->second, watch);
  pipeline_.bytes(0, newest_ns_, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()}, sink);
  pipeline_.bytes(0, newest_ns_, end, sink);
  if (samples_ == before) ++bad_;
}

}  // namespace navcal::gap
