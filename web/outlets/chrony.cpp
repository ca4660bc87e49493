// SPDX-License-Identifier: Apache-2.0
#include "web/outlets/chrony.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "base/durations.h"
#include "web/outlets/json_members.h"

namespace navcal::web {
namespace {

constexpr std::int64_t kYoung_ns = 5 * base::kSecond_ns;
constexpr std::int64_t kMicrosecond_ns = 1000;
/// The clocks are read anew when the process was interrupted between the readings.
constexpr std::int64_t kAtOnce_ns = 20 * kMicrosecond_ns;
constexpr int kReadings = 5;

std::int64_t clock_ns(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return now.tv_sec * base::kSecond_ns + now.tv_nsec;
}

std::int64_t nanoseconds_of(double seconds) { return std::llround(seconds * 1e9); }

}  // namespace

std::optional<ClockMapping> read_mapping(std::string_view message) {
  const auto time = nlohmann::json::parse(message, nullptr, false);
  if (!time.is_object()) return std::nullopt;
  const auto offset_s = number_in(time, "offset"), at_s = number_in(time, "at");
  constexpr double kMaxSeconds = 9e9;  // more is no count of nanoseconds of 64 bits
  if (!offset_s || !at_s || std::abs(*offset_s) > kMaxSeconds || std::abs(*at_s) > kMaxSeconds)
    return std::nullopt;
  return ClockMapping{text_in(time, "source") == "gps", nanoseconds_of(*offset_s), nanoseconds_of(*at_s)};
}

ClockPair read_clocks() {
  ClockPair best;
  std::int64_t shortest_ns = INT64_MAX;
  for (int i = 0; i < kReadings && shortest_ns > kAtOnce_ns; ++i) {
    const std::int64_t before_ns = clock_ns(CLOCK_MONOTONIC), system_ns = clock_ns(CLOCK_REALTIME),
                       after_ns = clock_ns(CLOCK_MONOTONIC);
    if (after_ns - before_ns >= shortest_ns) continue;
    shortest_ns = after_ns - before_ns;
    best = {before_ns + shortest_ns / 2, system_ns};
  }
  return best;
}

std::optional<ChronySample> chrony_sample(const ClockMapping& mapping, const ClockPair& now) {
  const std::int64_t age_ns = now.monotonic_ns - mapping.at_ns;
  // A mapping from the future is that of another machine's clock.
  if (!mapping.is_gps || age_ns < 0 || age_ns > kYoung_ns || now.system_ns < 0) return std::nullopt;
  ChronySample sample{};
  sample.tv.tv_sec = static_cast<time_t>(now.system_ns / base::kSecond_ns);
  sample.tv.tv_usec = static_cast<suseconds_t>(now.system_ns % base::kSecond_ns / kMicrosecond_ns);
  sample.offset = static_cast<double>(now.monotonic_ns + mapping.offset_ns - now.system_ns) * 1e-9;
  sample.magic = ChronySample().magic;
  return sample;
}

Chrony::Chrony(const boost::asio::any_io_executor& executor, std::string socket_path, Hub& hub)
    : hub_(hub), path_(std::move(socket_path)), socket_(executor) {
  hub_.add(*this, {false, {"/time"}, 1});
}

Chrony::~Chrony() { hub_.remove(*this); }

void Chrony::on_record(const Record& record) {
  if (record.topic != "/time") return;
  const auto mapping = read_mapping(record.message);
  if (!mapping || mapping->at_ns == last_at_ns_) return;
  last_at_ns_ = mapping->at_ns;
  if (const auto sample = chrony_sample(*mapping, read_clocks())) send(*sample);
}

/// The socket is opened anew for each sample: chronyd makes its own anew whenever it starts.
void Chrony::send(const ChronySample& sample) {
  boost::system::error_code error, ignored;
  socket_.close(ignored);
  socket_.open(boost::asio::local::datagram_protocol(), error);
  if (!error) socket_.non_blocking(true, error);
  if (!error) socket_.connect(boost::asio::local::datagram_protocol::endpoint(path_), error);
  if (!error) socket_.send(boost::asio::buffer(&sample, sizeof sample), 0, error);
  ++(error ? counters_.not_sent : counters_.samples);
  const std::string problem = error ? error.message() : std::string();
  if (error && problem != told_problem_)
    std::fprintf(stderr, "navcal-web: chronyd's socket %s: %s\n", path_.c_str(), problem.c_str());
  told_problem_ = problem;
}

}  // namespace navcal::web
