// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "record/log/log_folder.h"

namespace navcal::daemon {

/// Where the log stands, for HEALTH and LOG.
struct DiskState {
  enum class State {
    writing,
    full,     ///< no space, and no finished log that may be removed
    failing,  ///< the disk refuses for another reason
    stopped,  ///< by log.stop: the file is ended and no other begun
  };
  State state = State::writing;
  std::string reason;  ///< empty while writing
  std::string file;
  std::uint64_t file_bytes = 0;
  std::uint64_t synced_bytes = 0;
  std::uint64_t queued_bytes = 0;  ///< accepted and not written yet
  std::uint64_t dropped = 0;       ///< records refused because the queue was full
  bool is_gone = false;            ///< somebody has removed the file
};

/// "writing", "full", "failing", "stopped".
[[nodiscard]] std::string_view name_of(DiskState::State state);

/// The one thread that waits for the disk. Records are appended to a bounded buffer by the I/O thread; this thread
/// is woken by its sync interval, or when much is waiting, not by each record.
class DiskThread {
 public:
  struct Options {
    std::chrono::nanoseconds sync_interval{std::chrono::seconds(1)};
    std::chrono::nanoseconds retry_interval{std::chrono::seconds(1)};  ///< after the disk refused
    std::uint64_t queue_bytes = 32ULL << 20;
    std::uint64_t free_floor_bytes = 0;
  };

  /// `take_folder` is called on the thread, again and again as long as it throws std::system_error: until then the
  /// state is `failing`.
  DiskThread(std::function<record::LogFolder()> take_folder, const Options& options);
  /// Calls stop().
  ~DiskThread();
  DiskThread(const DiskThread&) = delete;
  DiskThread& operator=(const DiskThread&) = delete;

  /// `encode(std::string& buffer)` appends one whole record, if there is room; otherwise the record is counted as
  /// dropped. Returns whether there was.
  template <class Encode>
  bool append(Encode&& encode) {
    const std::lock_guard lock(mutex_);
    if (waiting_.bytes.size() + being_written_ >= options_.queue_bytes) {
      ++state_.dropped;
      return false;
    }
    encode(waiting_.bytes);
    wake_if_much();
    return true;
  }

  /// Appends the end of the present file. It is accepted even without room, because a log without its end has
  /// to be repaired.
  template <class Encode>
  void end_file(Encode&& encode_end) {
    const std::lock_guard lock(mutex_);
    encode_end(waiting_.bytes);
  }

  /// Begins a new file, named after `utc_ns`, with the bytes that `encode_begin` appends. Later records go to
  /// this file.
  template <class Encode>
  void next_file(std::int64_t utc_ns, Encode&& encode_begin) {
    const std::lock_guard lock(mutex_);
    waiting_.boundaries.push_back({waiting_.bytes.size(), utc_ns});
    encode_begin(waiting_.bytes);
    wake_.notify_one();
  }

  /// Finishes the present file once all before it is written, and begins no other. end_file() came before.
  void close_file() {
    const std::lock_guard lock(mutex_);
    waiting_.boundaries.push_back({waiting_.bytes.size(), std::nullopt});
    wake_.notify_one();
  }

  /// Writes everything that waits, finishes the file and ends the thread. A disk that keeps refusing is given up.
  void stop();

  [[nodiscard]] DiskState state() const;
  /// Notices since the last call, for people: files repaired or removed, and errors.
  [[nodiscard]] std::vector<std::string> take_notices();

 private:
  struct Boundary {
    std::size_t offset = 0;              ///< in the batch: what is before it belongs to the file before
    std::optional<std::int64_t> utc_ns;  ///< of the file that begins here; nullopt: none does
  };
  struct Batch {
    std::string bytes;
    std::vector<Boundary> boundaries;
  };

  void wake_if_much();
  void run();
  void write_all();
  /// False when the thread is to give up.
  bool open_folder();
  void write(const Batch& batch);
  void write_part(std::string_view bytes);
  void change_file(std::int64_t utc_ns);
  void end_without_next();
  void keep_floor();
  /// Whether there was an old log to remove.
  bool remove_oldest();
  void note_removed(const record::LogFolder::Space& space);
  void sync();
  void finish_file();
  /// Waits before another attempt; false when the thread is to give up.
  bool retry(DiskState::State state, const std::string& reason);
  void recovered();
  void note(std::string notice);
  void update_state();

  const std::function<record::LogFolder()> take_folder_;
  std::optional<record::LogFolder> folder_;  ///< nullopt: not taken yet
  const Options options_;
  std::unique_ptr<record::LogFile> file_;  ///< the disk thread's alone
  std::uint64_t written_since_check_ = 0;  ///< of free space
  std::uint64_t given_up_bytes_ = 0;
  int attempts_while_stopping_ = 0;
  bool below_floor_ = false;  ///< told already

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Batch waiting_;
  std::size_t being_written_ = 0;
  DiskState state_;
  std::vector<std::string> notices_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace navcal::daemon
