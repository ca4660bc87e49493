// SPDX-License-Identifier: Apache-2.0
#include "daemon/marker_file.h"

#include <fmt/format.h>

#include <utility>

#include "record/log/checked_file.h"

namespace navcal::daemon {

MarkerFile::MarkerFile(std::filesystem::path file, std::string content)
    : file_(std::move(file)), content_(std::move(content)) {
  std::error_code error;
  was_there_ = std::filesystem::exists(file_, error) || error;
  wanted_ = was_there_;
}

MarkerFile::~MarkerFile() { stop(); }

std::string MarkerFile::keep(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  if (stopping_) return "navcald stops";
  wanted_ = true;
  const std::uint64_t mine = ++asked_;
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  wake_.notify_one();
  if (!done_.wait_for(lock, limit, [&] { return answered_ >= mine; }))
    return fmt::format("{}: the disk has not taken it within {} ms", file_.string(), limit.count());
  return problem_;
}

bool MarkerFile::is_kept() const {
  const std::lock_guard lock(mutex_);
  return wanted_ && asked_ > 0 && answered_ == asked_ && problem_.empty();
}

void MarkerFile::remove() {
  const std::lock_guard lock(mutex_);
  if (!wanted_ || stopping_) return;
  wanted_ = false;
  ++asked_;
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
    wake_.wait(lock, [this] { return asked_ != answered_ || stopping_; });
    if (asked_ == answered_) return;
    const bool there = wanted_;
    const std::uint64_t asked = asked_;
    lock.unlock();
    std::string problem = apply(there);
    lock.lock();
    answered_ = asked;
    if (!problem.empty() && problem != problem_) notices_.push_back(problem);
    problem_ = std::move(problem);
    done_.notify_all();
  }
}

std::string MarkerFile::apply(bool there) const {
  std::error_code error;
  if (!there) {
    std::filesystem::remove(file_, error);
    return error ? fmt::format("{} cannot be removed: {}", file_.string(), error.message()) : std::string();
  }
  // One that cannot be made anew, on a disk that has turned read-only, says what it is to say.
  if (record::read_checked(file_).content == content_) return {};
  std::filesystem::create_directories(file_.parent_path(), error);
  if (!error) error = record::write_checked(file_, content_);
  return error ? fmt::format("{} cannot be made: {}", file_.string(), error.message()) : std::string();
}

std::vector<std::string> MarkerFile::take_notices() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notices_, {});
}

}  // namespace navcal::daemon
