// SPDX-License-Identifier: Apache-2.0
#include "daemon/disk_thread.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/enum_name.h"
#include "record/log/reused_buffer.h"

namespace navcal::daemon {
namespace {

/// Waiting bytes at which the thread is woken ahead of its sync interval.
constexpr std::size_t kWakeAt_bytes = 256 << 10;
/// Written in one call: bounds how long the end of a stall takes to be seen in the state.
constexpr std::size_t kWriteStep_bytes = 1 << 20;
constexpr std::uint64_t kCheckSpaceEvery_bytes = 4ULL << 20;
/// Synced ahead of the interval: what is not yet synced is held in memory, too.
constexpr std::uint64_t kMostUnsynced_bytes = 4ULL << 20;
constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr int kAttemptsWhileStopping = 3;

DiskState::State state_after(const std::error_code& error) {
  const bool space =
      error == std::errc::no_space_on_device || error == std::error_code(EDQUOT, std::generic_category());
  return space ? DiskState::State::full : DiskState::State::failing;
}

}  // namespace

std::string_view name_of(DiskState::State state) {
  return base::enum_name<DiskState::State::stopped>(state, {"writing", "full", "failing", "stopped"});
}

DiskThread::DiskThread(std::function<record::LogFolder()> take_folder, const Options& options)
    : take_folder_(std::move(take_folder)), options_(options), thread_([this] { run(); }) {}

DiskThread::~DiskThread() { stop(); }

void DiskThread::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

DiskState DiskThread::state() const {
  const std::lock_guard lock(mutex_);
  DiskState state = state_;
  state.queued_bytes = waiting_.bytes.size() + being_written_;
  return state;
}

std::vector<std::string> DiskThread::take_notices() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notices_, {});
}

void DiskThread::wake_if_much() {
  // The thread is woken once, when the mark is passed, and takes all waiting bytes.
  if (waiting_.bytes.size() >= kWakeAt_bytes && being_written_ == 0) wake_.notify_one();
}

bool DiskThread::open_folder() {
  while (!folder_) {
    try {
      folder_.emplace(take_folder_());
    } catch (const std::system_error& error) {
      if (!retry(state_after(error.code()), error.what())) return false;
    }
  }
  recovered();
  for (const auto& repair : folder_->finish_unfinished()) note(repair.message());
  return true;
}

void DiskThread::run() {
  if (open_folder()) {
    write_all();
  } else {
    const std::lock_guard lock(mutex_);
    given_up_bytes_ = waiting_.bytes.size();
  }
  if (given_up_bytes_ > 0)
    note(fmt::format("{} bytes in the queue for the disk were never written", given_up_bytes_));
  update_state();
}

void DiskThread::write_all() {
  Batch batch;
  auto next_sync = std::chrono::steady_clock::now() + options_.sync_interval;
  for (bool last = false; !last;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait_until(lock, next_sync, [&] {
        return stopping_ || waiting_.bytes.size() >= kWakeAt_bytes || !waiting_.boundaries.empty();
      });
      last = stopping_;
      std::swap(batch, waiting_);
      being_written_ = batch.bytes.size();
    }
    write(batch);
    record::empty_for_reuse(batch.bytes);
    batch.boundaries.clear();
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_sync || last) {
      sync();
      next_sync = now + options_.sync_interval;
    }
    update_state();
  }
  finish_file();
}

void DiskThread::write(const Batch& batch) {
  std::size_t done = 0;
  for (const Boundary& boundary : batch.boundaries) {
    write_part(std::string_view(batch.bytes).substr(done, boundary.offset - done));
    done = boundary.offset;
    if (boundary.utc_ns) {
      change_file(*boundary.utc_ns);
    } else {
      end_without_next();
    }
  }
  write_part(std::string_view(batch.bytes).substr(done));
}

void DiskThread::write_part(std::string_view bytes) {
  while (!bytes.empty() && file_) {
    const std::string_view step = bytes.substr(0, kWriteStep_bytes);
    if (written_since_check_ >= kCheckSpaceEvery_bytes) keep_floor();
    if (const auto error = file_->append(step)) {
      if (state_after(error) == DiskState::State::full && remove_oldest()) continue;
      if (!retry(state_after(error), error.message())) break;
      continue;
    }
    recovered();
    written_since_check_ += step.size();
    bytes.remove_prefix(step.size());
    {
      const std::lock_guard lock(mutex_);
      being_written_ -= std::min(being_written_, step.size());
    }
    if (file_->bytes() - file_->synced_bytes() >= kMostUnsynced_bytes) sync();
  }
  given_up_bytes_ += bytes.size();
}

void DiskThread::note_removed(const record::LogFolder::Space& space) {
  for (const auto& removed : space.removed) note("removed to make room: " + removed);
}

bool DiskThread::remove_oldest() {
  const auto space = folder_->remove_oldest();
  note_removed(space);
  return !space.removed.empty();
}

void DiskThread::keep_floor() {
  const auto space = folder_->keep_free(options_.free_floor_bytes);
  written_since_check_ = 0;
  note_removed(space);
  const bool is_below = !space.error && space.free_bytes < options_.free_floor_bytes;
  if (is_below && !std::exchange(below_floor_, is_below))
    note(
        fmt::format("{} MB free, less than log.free_floor_MB = {}: no old log is removed, since all of them would "
                    "not be enough; the log goes on until the disk is full",
                    space.free_bytes / kMegabyte, options_.free_floor_bytes / kMegabyte));
  below_floor_ = is_below;
}

void DiskThread::change_file(std::int64_t utc_ns) {
  finish_file();
  keep_floor();
  for (;;) {
    std::error_code error;
    file_ = folder_->create(utc_ns, error);
    if (file_) break;
    if (state_after(error) == DiskState::State::full && remove_oldest()) continue;
    if (!retry(state_after(error), "cannot make a file: " + error.message())) return;
  }
  recovered();
  update_state();
}

void DiskThread::end_without_next() {
  finish_file();
  const std::lock_guard lock(mutex_);
  state_.file.clear();
  state_.file_bytes = state_.synced_bytes = 0;
}

void DiskThread::sync() {
  if (!file_ || file_->synced_bytes() == file_->bytes()) return;
  bool failed = false;
  while (const auto error = file_->sync()) {
    failed = true;
    if (!retry(state_after(error), "cannot be synced: " + error.message())) return;
  }
  if (failed) recovered();
}

void DiskThread::finish_file() {
  if (!file_) return;
  const std::string name = file_->path().filename().string();
  if (const auto error = file_->finish()) note(fmt::format("{} could not be finished: {}", name, error.message()));
  file_.reset();
}

bool DiskThread::retry(DiskState::State state, const std::string& reason) {
  std::unique_lock lock(mutex_);
  if (state_.state != state) notices_.push_back(fmt::format("log {}: {}", name_of(state), reason));
  state_.state = state;
  state_.reason = reason;
  if (stopping_ && ++attempts_while_stopping_ >= kAttemptsWhileStopping) return false;
  wake_.wait_for(lock, options_.retry_interval, [&] { return stopping_ && attempts_while_stopping_ == 0; });
  return true;
}

void DiskThread::recovered() {
  const std::lock_guard lock(mutex_);
  if (state_.state == DiskState::State::writing) return;
  notices_.push_back("log is being written again");
  state_.state = DiskState::State::writing;
  state_.reason.clear();
}

void DiskThread::note(std::string notice) {
  const std::lock_guard lock(mutex_);
  notices_.push_back(std::move(notice));
}

void DiskThread::update_state() {
  const std::lock_guard lock(mutex_);
  being_written_ = 0;
  if (!file_) return;
  state_.file = file_->path().string();
  state_.file_bytes = file_->bytes();
  state_.synced_bytes = file_->synced_bytes();
  state_.is_gone = file_->is_gone();
}

}  // namespace navcal::daemon
