// SPDX-License-Identifier: Apache-2.0
#include "tests/ports/harness.h"

#include <fcntl.h>
#include <sys/resource.h>

#include <cstdlib>
#include <stdexcept>

#include "ports/raw_mode.h"

namespace navcal::ports::testing {

namespace fs = std::filesystem;

bool run_until(boost::asio::io_context& io, const std::function<bool()>& condition,
               std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    if (io.stopped()) io.restart();
    io.run_one_for(std::chrono::milliseconds(5));
  }
  return true;
}

void run_for(boost::asio::io_context& io, std::chrono::milliseconds duration) {
  if (io.stopped()) io.restart();
  io.run_for(duration);
}

protocols::Bytes bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

void Recorder::on_opened(std::int64_t, const OpenPort& port) { opened.push_back(port); }
void Recorder::on_bytes(std::int64_t arrival_ns, protocols::Bytes bytes) {
  arrivals_ns.push_back(arrival_ns);
  received.append(bytes.begin(), bytes.end());
  if (at_bytes) at_bytes();
}
void Recorder::on_sent(std::int64_t, protocols::Bytes bytes) { sent.append(bytes.begin(), bytes.end()); }
void Recorder::on_lost(std::int64_t, std::string_view reason) { lost.emplace_back(reason); }

config::PortSettings settings_for(const fs::path& path, int baud) {
  config::PortSettings settings;
  settings.name = "compass";
  settings.path = path;
  settings.baud = baud;
  return settings;
}

base::Descriptor open_client(const fs::path& path) {
  base::Descriptor client(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (!client || !set_raw(client.get(), 9600)) throw std::runtime_error("cannot open " + path.string());
  return client;
}

std::size_t open_descriptors() {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

std::chrono::microseconds cpu_time() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& t) {
    return std::chrono::seconds(t.tv_sec) + std::chrono::microseconds(t.tv_usec);
  };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

}  // namespace navcal::ports::testing
