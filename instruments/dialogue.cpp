// SPDX-License-Identifier: Apache-2.0
#include "instruments/dialogue.h"

#include <algorithm>
#include <utility>

namespace navcal::instruments {

void Dialogue::start_at(std::int64_t when_ns) {
  now_ns_ = when_ns;
  script_.reset();
  script_.reset(script().handle);
  due_ns_ = when_ns;
}

void Dialogue::end() {
  script_.reset();
  due_ns_ = std::numeric_limits<std::int64_t>::max();
}

void Dialogue::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (!script_) return;
  now_ns_ = now_ns;
  on_any_frame(frame);
  if (listening_ && answers_ && answers_(frame)) go_on(true);
}

std::optional<std::vector<std::uint8_t>> Dialogue::next(std::int64_t now_ns) {
  if (now_ns < due_ns_) return std::nullopt;
  now_ns_ = now_ns;
  while (attempts_left_ == 0) {
    go_on(false);
    if (now_ns < due_ns_) return std::nullopt;
  }
  --attempts_left_;
  listening_ = true;
  due_ns_ = now_ns + patience_ns_;
  auto command = command_;
  sign(command);
  return command;
}

void Dialogue::go_on(bool answered) {
  answered_ = answered;
  script_.get().resume();
  if (script_.get().done()) end();
}

Dialogue::Wait Dialogue::ask(std::vector<std::uint8_t> command, int attempts, std::int64_t patience_ns,
                             Answers answers) {
  command_ = std::move(command);
  attempts_left_ = attempts;
  patience_ns_ = patience_ns;
  answers_ = std::move(answers);
  listening_ = attempts == 0;
  due_ns_ = listening_ ? now_ns_ + patience_ns : now_ns_;
  return {answered_};
}

std::int64_t stopped_after_ns(double rate_Hz, std::int64_t least_ns) {
  return rate_Hz > 0 ? std::max(least_ns, static_cast<std::int64_t>(3e9 / rate_Hz)) : least_ns;
}

}  // namespace navcal::instruments
