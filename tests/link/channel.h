// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "link/host.h"
#include "link/vehicle.h"

namespace navcal::link {

/// Defects of one direction of a simulated line, each with its probability per frame.
struct Defects {
  double loss = 0;
  double repeat = 0;    ///< a frame arrives a second time, up to three seconds later
  double truncate = 0;  ///< its end is missing
  double flip = 0;      ///< one bit is wrong
  double garbage = 0;   ///< bytes that nobody sent come before it
  double latency_s = 0;
  double jitter_s = 0;  ///< at most added to the latency: frames overtake each other
  double rate_B_s = 5760;
};

/// One direction of a line in virtual time.
class Channel {
 public:
  Channel(const Defects& defects, unsigned seed) : defects_(defects), random_(seed) {}

  void put(std::int64_t now_ns, Buffer frame) {
    ++frames_;
    bytes_ += frame.size();
    // Truncated like this, it is as long on the line as whole.
    free_ns_ = std::max(free_ns_, now_ns) + seconds(static_cast<double>(frame.size()) / defects_.rate_B_s);
    if (happens(defects_.loss)) return;
    if (happens(defects_.garbage)) {
      Buffer noise(1 + random_() % 40);
      for (auto& byte : noise) byte = static_cast<std::uint8_t>(random_());
      frame.insert(frame.begin(), noise.begin(), noise.end());
    }
    if (happens(defects_.truncate)) frame.resize(random_() % frame.size());
    if (!frame.empty() && happens(defects_.flip))
      frame[random_() % frame.size()] ^= static_cast<std::uint8_t>(1U << random_() % 8);
    if (happens(defects_.repeat)) arrive(3 * share(), frame);
    arrive(0, std::move(frame));
  }
  [[nodiscard]] std::int64_t next_ns() const { return arrivals_.empty() ? kNoDeadline : arrivals_.begin()->first; }
  /// What has arrived by now, in pieces.
  template <class Take>
  void deliver(std::int64_t now_ns, Take&& take) {
    while (!arrivals_.empty() && arrivals_.begin()->first <= now_ns) {
      const Buffer bytes = std::move(arrivals_.begin()->second);
      arrivals_.erase(arrivals_.begin());
      const std::size_t cut = bytes.empty() ? 0 : random_() % bytes.size();
      take(Bytes(bytes).first(cut));
      take(Bytes(bytes).subspan(cut));
    }
  }
  void set_defects(const Defects& defects) { defects_ = defects; }
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }

  static std::int64_t seconds(double value) { return static_cast<std::int64_t>(value * 1e9); }

 private:
  double share() { return static_cast<double>(random_() >> 8) / (1U << 24); }
  bool happens(double probability) { return share() < probability; }
  void arrive(double later_s, Buffer bytes) {
    const double wait_s = defects_.latency_s + defects_.jitter_s * share() + later_s;
    arrivals_.emplace(free_ns_ + seconds(wait_s), std::move(bytes));
  }

  Defects defects_;
  std::mt19937 random_;
  std::int64_t free_ns_ = 0;
  std::multimap<std::int64_t, Buffer> arrivals_;
  std::uint64_t bytes_ = 0, frames_ = 0;
};

/// Both ends with a line between them.
class World {
 public:
  World(const Defects& defects, unsigned seed, EndOptions vehicle_options = {}, EndOptions host_options = {})
      : vehicle(with_nonces(std::move(vehicle_options), seed)),
        host(with_nonces(std::move(host_options), seed + 1)), up(defects, 2 * seed + 1),
        down(defects, 2 * seed + 2) {}

  /// Runs until `done()` or for `limit_s` of virtual time. False: the time is over. `work` is called at every
  /// step.
  bool run(
      double limit_s, const std::function<bool()>& done = [] { return false; }) {
    const std::int64_t end_ns = now_ns + Channel::seconds(limit_s);
    for (;;) {
      up.deliver(now_ns, [&](Bytes bytes) { vehicle.take(now_ns, bytes); });
      down.deliver(now_ns, [&](Bytes bytes) { host.take(now_ns, bytes); });
      vehicle.advance(now_ns);
      if (work) work();
      if (vehicle.is_report_due(now_ns)) vehicle.report(now_ns, encode_report(report));
      while (auto frame = vehicle.next(now_ns)) {
        if (on_frame) on_frame(true, now_ns, *frame);
        down.put(now_ns, std::move(*frame));
      }
      while (auto frame = host.next(now_ns)) {
        if (on_frame) on_frame(false, now_ns, *frame);
        up.put(now_ns, std::move(*frame));
      }
      if (done()) return true;
      if (now_ns >= end_ns) return false;
      const std::int64_t next_ns =
          std::min({vehicle.deadline_ns(), host.deadline_ns(), up.next_ns(), down.next_ns(), wake_ns, end_ns});
      now_ns = std::max(now_ns + 1'000'000, next_ns);
    }
  }
  bool connect(double limit_s = 60) {
    return run(limit_s, [&] { return host.has_session() && vehicle.peer() == Vehicle::Peer::alive; });
  }

  static EndOptions with_nonces(EndOptions options, unsigned seed) {
    auto random = std::make_shared<std::minstd_rand>(seed + 1);
    options.nonce = [random] {
      Nonce nonce{};
      for (auto& byte : nonce) byte = static_cast<std::uint8_t>((*random)() >> 4);
      return nonce;
    };
    return options;
  }
  static EndOptions with_key(std::string_view key) {
    EndOptions options;
    options.key = Key::from_text(key);
    return options;
  }

  std::int64_t now_ns = 1'000'000'000;
  std::int64_t wake_ns = kNoDeadline;  ///< when `work` wants to be called
  Vehicle vehicle;
  Host host;
  Channel up, down;
  Report report;
  std::function<void()> work;
  std::function<void(bool is_down, std::int64_t now_ns, const Buffer& frame)> on_frame;
};

}  // namespace navcal::link
