// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <coroutine>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "protocols/frame.h"

namespace navcal::instruments {

/// A dialogue with a device, without I/O or clock: it gets frames and the time, and returns the bytes to send and
/// the next deadline. Each has a script, a coroutine that sends commands and waits for frames.
class Dialogue {
 public:
  virtual ~Dialogue() = default;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns);
  /// Bytes to send now, if any; call again until nullopt.
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns);
  /// Time at which next() should be called again, monotonic; INT64_MAX when only a frame can change something.
  [[nodiscard]] std::int64_t deadline_ns() const { return due_ns_; }

 protected:
  /// In a script no temporary that is an aggregate with a string stands within a co_await expression: g++ 12 frees
  /// its characters twice. A function outside the expression makes it.
  struct Script {
    struct promise_type {
      Script get_return_object() { return {std::coroutine_handle<promise_type>::from_promise(*this)}; }
      static std::suspend_never initial_suspend() noexcept { return {}; }
      static std::suspend_always final_suspend() noexcept { return {}; }
      static void return_void() {}
      static void unhandled_exception() { throw; }
    };
    std::coroutine_handle<> handle;
  };
  /// Awaited by a script; true when a frame has answered, false when the time for it has passed.
  struct Wait {
    const bool& answered;
    static bool await_ready() noexcept { return false; }
    static void await_suspend(std::coroutine_handle<>) noexcept {}
    bool await_resume() const noexcept { return answered; }
  };
  /// Whether a frame is the awaited one. It may refer to what the script holds, and must not start it again.
  using Answers = std::function<bool(const protocols::Frame&)>;

  virtual Script script() = 0;
  /// Before each time that a command is sent.
  virtual void sign(std::vector<std::uint8_t>& /*command*/) {}
  /// For what counts whenever it comes.
  virtual void on_any_frame(const protocols::Frame&) {}

  /// Sends a command, again while it is not answered. Frames before the first time are no answers.
  Wait ask(std::vector<std::uint8_t> command, int attempts, std::int64_t patience_ns, Answers answers);
  /// Sends a command and waits, whatever comes.
  Wait send(std::vector<std::uint8_t> command, std::int64_t pause_ns) {
    return ask(std::move(command), 1, pause_ns, {});
  }
  Wait wait(std::int64_t patience_ns, Answers answers = {}) { return ask({}, 0, patience_ns, std::move(answers)); }
  /// The script from its beginning. Not to be called by the script.
  void start_at(std::int64_t when_ns);
  void end();
  [[nodiscard]] bool under_way() const { return script_ != nullptr; }
  [[nodiscard]] std::int64_t now_ns() const { return now_ns_; }

 private:
  struct Destroy {
    using pointer = std::coroutine_handle<>;
    void operator()(pointer handle) const { handle.destroy(); }
  };
  void go_on(bool answered);

  std::unique_ptr<void, Destroy> script_;
  std::int64_t now_ns_ = 0;
  std::int64_t due_ns_ = std::numeric_limits<std::int64_t>::max();
  std::vector<std::uint8_t> command_;
  int attempts_left_ = 0;
  std::int64_t patience_ns_ = 0;
  Answers answers_;
  bool listening_ = false, answered_ = false;
};

/// Time without measurements after which they have stopped: three periods of `rate_Hz`, if it is given, or more.
[[nodiscard]] std::int64_t stopped_after_ns(double rate_Hz, std::int64_t least_ns);

}  // namespace navcal::instruments
