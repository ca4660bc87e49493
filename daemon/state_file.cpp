// SPDX-License-Identifier: Apache-2.0
#include "daemon/state_file.h"

#include <fmt/format.h>

#include <utility>

#include "record/log/checked_file.h"

namespace navcal::daemon {

StateFile::StateFile(std::filesystem::path file) : file_(std::move(file)) {}

StateFile::~StateFile() { stop(); }

std::uint64_t StateFile::change(std::optional<std::string> content, bool may_stay) {
  if (stopping_) return answered_;
  wanted_ = std::move(content);
  may_stay_ = may_stay;
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  wake_.notify_one();
  return ++asked_;
}

void StateFile::save(std::string content) {
  const std::lock_guard lock(mutex_);
  change(std::move(content));
}

void StateFile::remove() {
  const std::lock_guard lock(mutex_);
  change(std::nullopt);
}

std::string StateFile::keep(std::string content, std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  if (stopping_) return "navcald stops";
  const std::uint64_t mine = change(std::move(content), true);
  if (!done_.wait_for(lock, limit, [&] { return answered_ >= mine; }))
    return fmt::format("{}: the disk has not taken it within {} ms", file_.string(), limit.count());
  return problem_;
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
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return asked_ != answered_ || stopping_; });
    if (asked_ == answered_) return;
    const std::uint64_t asked = asked_;
    // Taken, not copied: the state of the calibrators is large.
    const auto content = std::exchange(wanted_, std::nullopt);
    const bool may_stay = may_stay_;
    lock.unlock();
    std::string problem = apply(content, may_stay);
    lock.lock();
    answered_ = asked;
    if (problem != problem_)
      notices_.push_back(problem.empty() ? file_.string() + " can be written again" : problem);
    problem_ = std::move(problem);
    done_.notify_all();
  }
}

std::string StateFile::apply(const std::optional<std::string>& content, bool may_stay) const {
  std::error_code error;
  if (!content) {
    std::filesystem::remove(file_, error);
    return error ? fmt::format("{} cannot be removed: {}", file_.string(), error.message()) : std::string();
  }
  // A disk that has turned read-only may have the file from before.
  if (may_stay && record::read_checked(file_).content == *content) return {};
  std::filesystem::create_directories(file_.parent_path(), error);
  if (!error) error = record::write_checked(file_, *content);
  return error ? fmt::format("{} cannot be written: {}", file_.string(), error.message()) : std::string();
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
