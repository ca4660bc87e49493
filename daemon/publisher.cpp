// SPDX-License-Identifier: Apache-2.0
#include "daemon/publisher.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "daemon/json_text.h"
#include "record/json/message_json.h"

namespace navcal::daemon {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};
template <class... Ts>
Overloaded(Ts...) -> Overloaded<Ts...>;

ReportClass class_of(const instruments::Sample& sample) {
  using enum ReportClass;
  // In the order of the kinds of samples.
  constexpr std::array kClasses{att, att, tpv, sky, motor, altimeter, power, dvl, depth, sensor};
  static_assert(kClasses.size() == std::variant_size_v<decltype(sample.value)>);
  return kClasses[sample.value.index()];
}

}  // namespace

Publisher::Publisher(const config::Settings& settings, StatusServer& server)
    : settings_(settings), server_(server), earth_field_(settings.environment), last_(settings.ports.size()) {}

void Publisher::sample(const instruments::Sample& sample) {
  auto& last = last_[sample.port];
  if (const auto* gps = std::get_if<instruments::GpsSample>(&sample.value)) {
    last.gps = *gps;
    last.gps_stamp = sample.stamp;
  } else if (const auto* sky = std::get_if<instruments::SkySample>(&sample.value)) {
    last.sky = *sky;
    last.sky_stamp = sample.stamp;
  }
  const ReportClass report = class_of(sample);
  if (!server_.watched(report, sample.port)) return;
  report_.clear();
  ReportSource from = source(sample.port);
  from.calibration = sample.calibration;
  append(sample, from);
  server_.publish(report, sample.port, report_);
}

void Publisher::navigation(const pipeline::NavigationSample& sample) {
  last_navigation_ = sample;
  const std::uint16_t device = navigation_device(settings_);
  if (server_.watched(ReportClass::nav, device)) {
    report_.clear();
    record::append_json(report_, sample);
    report_ += kLineEnd;
    server_.publish(ReportClass::nav, device, report_);
  }
  const bool is_reckoned = sample.source == pipeline::PositionSource::reckoned;
  if (!is_reckoned || !server_.watched(ReportClass::tpv, device)) return;
  report_.clear();
  append_tpv(report_, sample, utc_known_);
  server_.publish(ReportClass::tpv, device, report_);
}

void Publisher::battery(const pipeline::BatterySample& sample) {
  if (!server_.watched(ReportClass::battery, sample.port)) return;
  report_.clear();
  record::append_json(report_, sample, settings_.ports[sample.port].name);
  report_ += kLineEnd;
  server_.publish(ReportClass::battery, sample.port, report_);
}

void Publisher::append(const instruments::Sample& sample, ReportSource source) {
  const auto& stamp = sample.stamp;
  std::visit(Overloaded{
                 [&](const instruments::CompassSample& compass) {
                   append_att(report_, compass, earth_field_, stamp, source);
                 },
                 [&](const instruments::ImuSample& imu) { append_att(report_, imu, stamp, source); },
                 [&](const instruments::GpsSample& gps) { append_tpv(report_, gps, stamp, source); },
                 [&](const instruments::SkySample& sky) {
                   const auto& gps = last_[sample.port].gps;
                   append_sky(report_, sky, gps ? &*gps : nullptr, stamp, source);
                 },
                 // gpsd has no words for these: they go out as `navcal replay` writes them.
                 [&](const auto&) {
                   record::append_json(report_, sample, source.device);
                   report_ += kLineEnd;
                 },
             },
             sample.value);
}

void Publisher::append_poll(std::string& out, std::optional<std::int64_t> utc_ns) const {
  out += "{\"class\":\"POLL\"";
  if (utc_ns) {
    out += ",\"time\":";
    append_utc(out, *utc_ns, 3);
  }
  const auto active = std::ranges::count_if(last_, [](const Last& last) { return last.gps.has_value(); });
  fmt::format_to(std::back_inserter(out), FMT_STRING(",\"active\":{},\"tpv\":["), active);
  bool first = true;
  const auto list = [&](auto&& append_one) {
    first = true;
    const auto ports = static_cast<std::uint16_t>(last_.size());
    for (std::uint16_t port = 0; port < ports; ++port) {
      const std::size_t before = out.size();
      if (!first) out += ',';
      if (append_one(last_[port], port)) {
        out.resize(out.size() - kLineEnd.size());  // here it is no line of its own
        first = false;
      } else {
        out.resize(before);
      }
    }
  };
  list([&](const Last& last, std::uint16_t port) {
    if (last.gps) append_tpv(out, *last.gps, last.gps_stamp, source(port));
    return last.gps.has_value();
  });
  if (last_navigation_ && last_navigation_->source == pipeline::PositionSource::reckoned) {
    if (!first) out += ',';
    append_tpv(out, *last_navigation_, utc_known_);
    out.resize(out.size() - kLineEnd.size());
  }
  out += "],\"gst\":[],\"sky\":[";
  list([&](const Last& last, std::uint16_t port) {
    if (last.sky) append_sky(out, *last.sky, last.gps ? &*last.gps : nullptr, last.sky_stamp, source(port));
    return last.sky.has_value();
  });
  out += "]}\r\n";
}

}  // namespace navcal::daemon
