// SPDX-License-Identifier: Apache-2.0
#include "daemon/marker_file.h"

#include <fmt/format.h>

#include <fstream>
#include <utility>

namespace navcal::daemon {

MarkerFile::MarkerFile(std::filesystem::path file) : file_(std::move(file)), wanted_(is_there()), done_(wanted_) {}

MarkerFile::~MarkerFile() { stop(); }

bool MarkerFile::is_there() const {
  std::error_code ignored;
  return std::filesystem::exists(file_, ignored);
}

void MarkerFile::set(bool there) {
  const std::lock_guard lock(mutex_);
  if (there == wanted_ || stopping_) return;
  wanted_ = there;
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  wake_.notify_one();
}

void MarkerFile::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void MarkerFile::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return wanted_ != done_ || stopping_; });
    if (wanted_ == done_) return;
    const bool there = wanted_;
    lock.unlock();
    std::string problem = apply(there);
    lock.lock();
    done_ = there;
    if (!problem.empty()) notices_.push_back(std::move(problem));
  }
}

std::string MarkerFile::apply(bool there) const {
  std::error_code error;
  if (!there) {
    std::filesystem::remove(file_, error);
    return error ? fmt::format("{} cannot be removed: {}", file_.string(), error.message()) : std::string();
  }
  std::filesystem::create_directories(file_.parent_path(), error);
  if (!std::ofstream(file_)) return fmt::format("{} cannot be made", file_.string());
  return {};
}

std::vector<std::string> MarkerFile::take_notices() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notices_, {});
}

}  // namespace navcal::daemon
