// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/metrics.h"

#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "record/json/put_members.h"
#include "web/outlets/daemon_metrics.h"
#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

std::optional<double> cpu_s() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return std::nullopt;
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::optional<double> resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  if (!(in >> total >> resident)) return std::nullopt;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

std::optional<double> open_descriptors() {
  std::error_code error;
  const std::filesystem::directory_iterator begin("/proc/self/fd", error);
  if (error) return std::nullopt;
  // The iterator's own descriptor is not counted.
  return static_cast<double>(std::distance(begin, std::filesystem::directory_iterator())) - 1;
}

/// CPU time, memory and descriptors of this process, by the names that all programs use for Prometheus.
void append_process(Exposition& out) {
  out.single("process_cpu_seconds_total", "CPU time of navcal-web.", cpu_s());
  out.single("process_resident_memory_bytes", "Memory of navcal-web.", resident_bytes());
  out.single("process_open_fds", "Descriptors that navcal-web has open.", open_descriptors());
}

/// More than any vehicle has; a broken peer may name any number.
constexpr std::size_t kMaxBatteries = 16, kMaxSeverities = 8;

}  // namespace

Metrics::Metrics(Hub& hub) : hub_(hub) {
  hub_.add(*this, {false, {"/health", "/time", "/nav", "/battery", "/calib", "/event"}, 1});
}

Metrics::~Metrics() { hub_.remove(*this); }

void Metrics::on_record(const Record& record) {
  const bool wanted = record.topic == "/health" || record.topic == "/time" || record.topic == "/nav" ||
                      record.topic == "/battery" || record.topic == "/calib" || record.topic == "/event";
  if (!wanted) return;
  auto message = nlohmann::json::parse(record.message, nullptr, false);
  if (!message.is_object()) return;
  if (record.topic == "/health") {
    health_.take(std::move(message));
  } else if (record.topic == "/time") {
    time_ = std::move(message);
  } else if (record.topic == "/nav") {
    navigation_ = std::move(message);
  } else if (record.topic == "/battery") {
    const std::string device(record.device);
    if (batteries_.size() < kMaxBatteries || batteries_.contains(device)) batteries_[device] = std::move(message);
  } else if (record.topic == "/calib") {
    // Changes of the calibration are on the same topic.
    if (text_in(message, "class") == "CALIB") calibration_.take(std::move(message));
  } else {
    const std::string severity = text_in(message, "severity");
    if (events_.size() < kMaxSeverities || events_.contains(severity)) ++events_[severity];
  }
}

void Metrics::on_link(const Link& link) {
  if (link.connected) return;
  health_.forget();
  calibration_.forget();
  time_ = nullptr;
  navigation_ = nullptr;
  batteries_.clear();
}

void Metrics::append_daemon(Exposition& out) const {
  out.single("navcald_up", "1 while navcal-web is connected to navcald.", hub_.link().connected);
  append_health(out, health_.parts());
  append_clock(out, time_, health_.parts());
  append_navigation(out, navigation_);
  std::vector<nlohmann::json> batteries;
  for (const auto& [device, battery] : batteries_) batteries.push_back(battery);
  append_batteries(out, batteries);
  append_calibration(out, calibration_.parts());
  out.metric("navcald_events_total", "Events of navcald that navcal-web has seen.");
  for (const auto& [severity, count] : events_) out.sample({{"severity", severity}}, static_cast<double>(count));
}

void Metrics::append_program(Exposition& out) const {
  out.single("navcal_web_records_total", "Records taken from navcald.", hub_.published());
  if (source_ != nullptr) {
    nlohmann::json source;
    NAVCAL_PUT_MEMBERS(source, *source_, connections, lines, not_understood, missed);
    append_members(out, source, members_of("source"));
  }
  if (server_ != nullptr) {
    nlohmann::json server;
    NAVCAL_PUT_MEMBERS(server, *server_, connections, connections_refused, requests, requests_refused,
                       requests_broken, web_sockets, web_sockets_open, messages_sent, messages_dropped,
                       bytes_sent);
    append_members(out, server, members_of("server"));
  }
  append_process(out);
}

std::string Metrics::page() const {
  Exposition out;
  append_daemon(out);
  append_program(out);
  if (more_) more_(out);
  return out.text();
}

Handler Metrics::handler() const {
  return [this](const Request&) -> boost::asio::awaitable<Response> {
    co_return respond(boost::beast::http::status::ok, Exposition::kContentType, page());
  };
}

}  // namespace navcal::web
