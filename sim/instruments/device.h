// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "protocols/frame.h"
#include "sim/noise.h"
#include "sim/state.h"

namespace navcal::sim {

inline constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

/// Bytes that a device sends in one go.
struct Emission {
  std::int64_t start_ns = 0;  ///< the first bit is on the wire
  std::vector<std::uint8_t> bytes;
};

/// Behaviour of one instrument behind its serial line: no port, no clock. Times are UTC nanoseconds and never
/// decrease. The caller calls advance() at next_event_ns() and passes on the bytes of the host.
class Device {
 public:
  virtual ~Device() = default;
  /// Power comes (again): all that a device does not keep is forgotten.
  virtual void power_on(std::int64_t t_ns) = 0;
  /// The last of these bytes has arrived at t_ns.
  virtual void on_bytes(std::int64_t t_ns, protocols::Bytes bytes) = 0;
  /// Time of its next own action; kNever_ns while it waits for its host.
  [[nodiscard]] virtual std::int64_t next_event_ns() const = 0;
  /// Does what is due up to t_ns and appends what it sends for it.
  virtual void advance(std::int64_t t_ns, std::vector<Emission>& out) = 0;
  /// Speed of its line now.
  [[nodiscard]] virtual int baud() const = 0;
};

/// A serial line carries one byte after the other: what is sent while it is busy waits.
class Line {
 public:
  void put(std::int64_t t_ns, int baud, std::vector<std::uint8_t> bytes, std::vector<Emission>& out) {
    const std::int64_t start_ns = t_ns > free_ns_ ? t_ns : free_ns_;
    free_ns_ = start_ns + static_cast<std::int64_t>(bytes.size()) * 10'000'000'000 / baud;
    out.push_back({start_ns, std::move(bytes)});
  }
  [[nodiscard]] std::int64_t free_ns() const { return free_ns_; }

 private:
  std::int64_t free_ns_ = 0;
};

/// A device with a line of its own: what it does at the ticks of its clock, or at other times of its own, and
/// answers to its host, in their order.
class LineDevice : public Device {
 public:
  void on_bytes(std::int64_t, protocols::Bytes) override {}
  [[nodiscard]] std::int64_t next_event_ns() const final { return std::min(next_answer_ns(), next_act_ns()); }
  void advance(std::int64_t t_ns, std::vector<Emission>& out) final {
    for (std::int64_t now_ns = next_event_ns(); now_ns <= t_ns; now_ns = next_event_ns()) {
      if (next_answer_ns() > now_ns) {
        act(now_ns, out);
        continue;
      }
      const Answer answer = std::move(answers_.front());
      answers_.pop_front();
      send(now_ns, answer.make(now_ns), out);
    }
  }
  [[nodiscard]] int baud() const final { return baud_; }

 protected:
  using Message = std::vector<std::uint8_t>;
  using MakeMessage = std::function<Message(std::int64_t now_ns)>;

  explicit LineDevice(int baud) : baud_(baud) {}
  /// Its next action but for answers.
  [[nodiscard]] virtual std::int64_t next_act_ns() const { return ticks_.next_ns(); }
  virtual void act(std::int64_t now_ns, std::vector<Emission>& out) = 0;

  void send(std::int64_t t_ns, Message bytes, std::vector<Emission>& out) {
    line_.put(t_ns, baud_, std::move(bytes), out);
  }
  /// Made when it is due, which is not before the answers that wait already.
  void answer(std::int64_t due_ns, MakeMessage make) {
    answers_.push_back({answers_.empty() ? due_ns : std::max(due_ns, answers_.back().due_ns), std::move(make)});
  }
  void answer(std::int64_t due_ns, Message bytes) {
    answer(due_ns, [bytes = std::move(bytes)](std::int64_t) { return bytes; });
  }
  void forget_answers() { answers_.clear(); }

  int baud_;
  Line line_;
  Ticks ticks_;

 private:
  struct Answer {
    std::int64_t due_ns;
    MakeMessage make;
  };
  [[nodiscard]] std::int64_t next_answer_ns() const {
    return answers_.empty() ? kNever_ns : answers_.front().due_ns;
  }

  std::deque<Answer> answers_;
};

/// The same with commands from its host.
template <class Parser>
class CommandedDevice : public LineDevice {
 public:
  void on_bytes(std::int64_t t_ns, protocols::Bytes bytes) final {
    parser_.feed(bytes, [&](const protocols::Frame& frame) { obey(t_ns, frame); });
  }

 protected:
  using LineDevice::LineDevice;
  virtual void obey(std::int64_t t_ns, const protocols::Frame& command) = 0;
  /// Commands that are not whole, and answers that wait.
  void forget() {
    parser_ = {};
    forget_answers();
  }

 private:
  Parser parser_;
};

/// A device that measures the motion of a vehicle, with noise of its own.
template <class DeviceOptions, class Base = LineDevice>
class MeasuringDevice : public Base {
 public:
  using Options = DeviceOptions;
  MeasuringDevice(const Options& options, const Motion& motion)
      : Base(options.baud), options_(options), motion_(motion), noise_(options.seed) {}

 protected:
  [[nodiscard]] Vector3 noisy(Vector3 values, double noise) {
    for (double& value : values) value += noise_.normal(noise);
    return values;
  }

  Options options_;
  const Motion& motion_;
  Noise noise_;
};

}  // namespace navcal::sim
