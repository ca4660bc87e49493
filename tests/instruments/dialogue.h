// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_up.h"

// A start-up dialogue run on a simulated clock against a device made of a few lines.
namespace navcal::instruments::test {

struct Sent {
  std::int64_t at_ns;
  std::string text;
};

class Dialogue {
 public:
  using Device = std::function<void(Dialogue&, const std::string& command)>;

  explicit Dialogue(
      std::unique_ptr<StartUp> start_up, Device device = [](Dialogue&, const std::string&) {})
      : start_up_(std::move(start_up)), device_(std::move(device)) {}

  void begin() { start_up_->begin(now_ns_); }

  /// The device sends a frame after `delay_ns`.
  void answer(std::string_view id, std::string bytes = "", std::int64_t delay_ns = 20 * base::kMillisecond_ns) {
    pending_.push_back({now_ns_ + delay_ns, std::string(id), std::move(bytes)});
  }

  /// Lets time pass; `each_ms` is called before every millisecond.
  void run_for(
      std::int64_t duration_ns, const std::function<void()>& each_ms = [] {}) {
    for (const std::int64_t end = now_ns_ + duration_ns; now_ns_ < end; now_ns_ += base::kMillisecond_ns) {
      each_ms();
      deliver();
      if (start_up_->deadline_ns() > now_ns_) continue;  // nobody calls next() before its time
      while (const auto bytes = start_up_->next(now_ns_)) {
        sent.push_back({now_ns_, {bytes->begin(), bytes->end()}});
        device_(*this, sent.back().text);
      }
    }
  }

  /// Sends a frame of the device at once.
  void frame(std::string_view id, std::string_view bytes = "") {
    start_up_->on_frame(
        {protocols::FrameId(id), 0, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}}, now_ns_);
  }

  /// What was sent, one after the other, CR shown as a blank.
  [[nodiscard]] std::string transcript() const {
    std::string text;
    for (const Sent& command : sent) text += command.text;
    for (char& c : text) c = c == '\r' ? ' ' : c;
    return text;
  }
  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }
  [[nodiscard]] std::string state() const { return start_up_->state(); }
  [[nodiscard]] StartUp& start_up() { return *start_up_; }

  std::vector<Sent> sent;

 private:
  struct Pending {
    std::int64_t due_ns;
    std::string id, bytes;
  };

  void deliver() {
    for (std::size_t i = 0; i < pending_.size();) {
      if (pending_[i].due_ns > now_ns_) {
        ++i;
        continue;
      }
      const Pending due = pending_[i];
      pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(i));
      frame(due.id, due.bytes);
    }
  }

  std::unique_ptr<StartUp> start_up_;
  Device device_;
  std::vector<Pending> pending_;
  std::int64_t now_ns_ = 5 * base::kSecond_ns;
};

/// The same command is never repeated within `least_ns`.
inline bool never_repeated_within(const std::vector<Sent>& sent, std::int64_t least_ns) {
  for (std::size_t i = 0; i < sent.size(); ++i) {
    for (std::size_t j = i + 1; j < sent.size(); ++j) {
      if (sent[j].text == sent[i].text && sent[j].at_ns - sent[i].at_ns < least_ns) return false;
    }
  }
  return true;
}

}  // namespace navcal::instruments::test
