// SPDX-License-Identifier: Apache-2.0
#include "daemon/state_file.h"

#include <fmt/format.h>

#include <utility>

#include "record/log/checked_file.h"

namespace navcal::daemon {

StateFile::StateFile(std::filesystem::path file) : file_(std::move(file)) {}

StateFile::~StateFile() { stop(); }

void StateFile::save(std::string content) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return;
  waiting_ = std::move(content);
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  wake_.notify_one();
}

void StateFile::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void StateFile::run() {
  for (;;) {
    std::string content;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return waiting_ || stopping_; });
      if (!waiting_) return;
      content = *std::exchange(waiting_, std::nullopt);
    }
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    if (!error) error = record::write_checked(file_, content);
    if (error && !std::exchange(failing_, true)) {
      note(fmt::format("{} cannot be written: {}", file_.string(), error.message()));
    } else if (!error && std::exchange(failing_, false)) {
      note(fmt::format("{} can be written again", file_.string()));
    }
  }
}

void StateFile::note(std::string notice) {
  const std::lock_guard lock(mutex_);
  notices_.push_back(std::move(notice));
}

std::vector<std::string> StateFile::take_notices() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notices_, {});
}

}  // namespace navcal::daemon
