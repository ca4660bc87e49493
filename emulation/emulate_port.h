// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "emulation/emulate_misbehaviour.h"
#include "ports/paced_writer.h"
#include "ports/pty_host.h"
#include "record/capture/capture_writer.h"
#include "sim/effects/effect_set.h"
#include "sim/instruments/device.h"

namespace navcal::emulation {

/// A capture of exactly what went over the emulated lines, with the time at which it was on the wire. Directions
/// are the host's: `<` is what a device sent and a client could read, `>` what the client sent.
class SentLog {
 public:
  /// Throws Failure when the file cannot be made.
  SentLog(const std::filesystem::path& file, const std::vector<config::PortSettings>& ports);
  /// "#TEXT", such as "event 12.5 dive begins".
  void comment(std::string_view text);
  void add(std::uint16_t port, record::Direction direction, std::int64_t utc_ns, protocols::Bytes bytes);

 private:
  record::CaptureWriter writer_;
  std::ofstream file_;
  std::string line_;
};

/// One emulated instrument, live: the device's behaviour, its line at its pace, and a pseudo-terminal at the end.
class EmulatedPort {
 public:
  struct Place {
    std::filesystem::path dir;
    std::string name;
    std::uint16_t index = 0;
    std::int64_t utc_minus_monotonic_ns =
        0;  ///< fixed at the start: steps of the system clock do not reach the devices
    std::uint64_t seed = 1;
    sim::EffectSet* effects = nullptr;  ///< on the line; the index is that of the sim::Instrument
  };
  /// `log` may be nullptr.
  EmulatedPort(const boost::asio::any_io_executor& executor, const Place& place,
               std::unique_ptr<sim::Device> device, SentLog* log);

  [[nodiscard]] const std::string& name() const { return place_.name; }
  [[nodiscard]] const ports::PtyHost& host() const { return host_; }
  [[nodiscard]] sim::Device& device() { return *device_; }
  [[nodiscard]] Misbehaviour& misbehaviour() { return misbehaviour_; }

  void power_cycle();
  void unplug();
  void replug();
  /// Bytes are held back so long and then come all at once.
  void stall(double seconds);

 private:
  [[nodiscard]] std::int64_t utc_ns(std::int64_t monotonic_ns) const {
    return monotonic_ns + place_.utc_minus_monotonic_ns;
  }
  void on_host_bytes(std::int64_t now_ns, protocols::Bytes bytes);
  void advance();
  void send(const sim::Emission& emission);
  void wait();
  void put(std::int64_t now_ns, protocols::Bytes piece);
  void deliver(std::int64_t now_ns, protocols::Bytes bytes);
  /// A client set to another speed hears, and is heard as, garbage.
  [[nodiscard]] int client_baud() const;

  Place place_;
  std::unique_ptr<sim::Device> device_;
  SentLog* log_;
  Misbehaviour misbehaviour_;
  ports::PtyHost host_;
  ports::PacedWriter writer_;
  boost::asio::steady_timer timer_;
  boost::asio::steady_timer stall_timer_;
  std::vector<sim::Emission> emissions_;
  std::vector<std::uint8_t> held_back_;
  bool stalled_ = false;
};

}  // namespace navcal::emulation
