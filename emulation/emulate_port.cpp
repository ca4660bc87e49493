// SPDX-License-Identifier: Apache-2.0
#include "emulation/emulate_port.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/failure.h"
#include "ports/port.h"
#include "sim/instruments/wrong_speed.h"

namespace navcal::emulation {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

EmulatedPort::EmulatedPort(const boost::asio::any_io_executor& executor, const Place& place,
                           std::unique_ptr<sim::Device> device, SentLog* log)
    : place_(place), device_(std::move(device)), log_(log), misbehaviour_(place.seed),
      host_(executor, place.dir / place.name, device_->baud(),
            [this](std::int64_t now_ns, protocols::Bytes bytes) { on_host_bytes(now_ns, bytes); }),
      writer_(executor, [this](std::int64_t now_ns, protocols::Bytes piece) { put(now_ns, piece); }),
      timer_(executor), stall_timer_(executor) {
  power_cycle();
}

void EmulatedPort::power_cycle() {
  writer_.clear();
  device_->power_on(utc_ns(ports::monotonic_ns()));
  wait();
}

void EmulatedPort::wait() {
  const std::int64_t next_ns = device_->next_event_ns();
  if (next_ns == sim::kNever_ns) {
    timer_.cancel();
    return;
  }
  timer_.expires_at(steady_clock::time_point(nanoseconds(next_ns - place_.utc_minus_monotonic_ns)));
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (!error) advance();
  });
}

void EmulatedPort::advance() {
  emissions_.clear();
  device_->advance(utc_ns(ports::monotonic_ns()), emissions_);
  for (sim::Emission& emission : emissions_) {
    emission.bytes = misbehaviour_.corrupt(std::move(emission.bytes));
    send(emission);
  }
  wait();
}

void EmulatedPort::send(const sim::Emission& emission) {
  sim::Transmission way;
  std::int64_t start_ns = emission.start_ns;
  if (place_.effects != nullptr) {
    const double time_s = place_.effects->time_s(start_ns);
    way = place_.effects->line(static_cast<sim::Instrument>(place_.index), time_s);
    start_ns += std::llround(std::max(way.late_s, way.held_until_s - time_s) * 1e9);
    start_ns = std::max(start_ns, emission.start_ns);
  }
  for (int copy = 0; copy < way.copies; ++copy) {
    writer_.send(start_ns - place_.utc_minus_monotonic_ns, device_->baud(), emission.bytes);
  }
}

void EmulatedPort::on_host_bytes(std::int64_t now_ns, protocols::Bytes bytes) {
  if (log_ != nullptr) log_->add(place_.index, record::Direction::sent, utc_ns(now_ns), bytes);
  device_->on_bytes(utc_ns(now_ns), sim::heard_at(bytes, client_baud(), device_->baud()));
  wait();
}

void EmulatedPort::put(std::int64_t now_ns, protocols::Bytes piece) {
  if (stalled_) {
    held_back_.insert(held_back_.end(), piece.begin(), piece.end());
  } else {
    deliver(now_ns, piece);
  }
}

void EmulatedPort::deliver(std::int64_t now_ns, protocols::Bytes bytes) {
  const auto heard = sim::heard_at(bytes, device_->baud(), client_baud());
  const std::size_t taken = host_.write(heard);
  if (log_ != nullptr && taken > 0) {
    log_->add(place_.index, record::Direction::received, utc_ns(now_ns), protocols::Bytes(heard).first(taken));
  }
}

int EmulatedPort::client_baud() const {
  const int baud = host_.client_baud();
  return baud > 0 ? baud : device_->baud();
}

void EmulatedPort::stall(double seconds) {
  stalled_ = true;
  stall_timer_.expires_after(std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(seconds)));
  stall_timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) return;
    stalled_ = false;
    const auto held = std::exchange(held_back_, {});
    if (!held.empty()) deliver(ports::monotonic_ns(), held);
  });
}

void EmulatedPort::unplug() {
  // Bytes on the wire are lost when the plug is pulled; the device itself goes on.
  writer_.clear();
  held_back_.clear();
  host_.unplug();
}

void EmulatedPort::replug() { host_.replug(); }

SentLog::SentLog(const std::filesystem::path& file, const std::vector<config::PortSettings>& ports)
    : writer_(ports), file_(file) {
  if (!file_) throw base::Failure(base::Exit::failed, file.string() + ": cannot be written");
  writer_.begin(line_);
  file_ << line_ << std::flush;
}

void SentLog::comment(std::string_view text) {
  line_.clear();
  record::CaptureWriter::comment(line_, text);
  file_ << line_ << std::flush;
}

void SentLog::add(std::uint16_t port, record::Direction direction, std::int64_t utc_ns, protocols::Bytes bytes) {
  line_.clear();
  writer_.bytes(line_, port, direction, utc_ns, bytes);
  // Flushed line by line: whoever compares may look while we run.
  file_ << line_ << std::flush;
}

}  // namespace navcal::emulation
