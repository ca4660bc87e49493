// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/descriptor.h"
#include "web/hub.h"

namespace navcal::web {

/// The JSON messages of a log, in the order of their arrivals, each to be had at once. It is read once to its end
/// when it is opened, past damage as record::LogReader does.
class RecordedLog {
 public:
  struct Entry {
    std::int64_t time_ns = 0;  ///< log_time: the arrival, on a scale near UTC
    std::uint64_t offset = 0;  ///< of its bytes in the file
    std::uint32_t length = 0;
    std::uint16_t topic = 0;  ///< index into topics()
  };
  /// Called now and then with how far the file has been read, 0..1.
  using Progress = std::function<void(double)>;

  /// Throws record::BadRecording, which names the file, when it is no log or has no messages to show.
  RecordedLog(const std::filesystem::path& file, const Progress& progress);

  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] const std::vector<std::string>& topics() const { return topics_; }
  /// The text of a message; valid until the next call. Empty when the file cannot be read any more.
  [[nodiscard]] std::string_view text(const Entry& entry);
  /// Remarks for the user: damage, an unfinished end.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void read(const std::filesystem::path& file, const Progress& progress);

  std::vector<Entry> entries_;
  std::vector<std::string> topics_;
  std::vector<std::string> remarks_;
  base::Descriptor file_;
  std::string text_;
};

/// Plays the messages of a log into the hub, at any speed, from any place. It begins when the first viewer has
/// come.
class RecordedSource final : public Player, public std::enable_shared_from_this<RecordedSource> {
 public:
  static constexpr double kLeastSpeed = 0.001, kGreatestSpeed = 1e6;

  /// `name` is shown for the file. Stands at the beginning until start().
  RecordedSource(const boost::asio::any_io_executor& executor, Hub& hub, RecordedLog log, std::string name,
                 double speed);
  void start();
  void stop();

  void command(std::string_view json) override;
  void viewer_came() override { has_viewer_ = true; }
  void append_state(std::string& out) const override;

  /// Plays on by so much of real time. start() does it by the clock.
  void advance(std::chrono::nanoseconds elapsed);
  void seek(double position_s);
  void set_speed(double speed);
  void set_playing(bool playing);

  [[nodiscard]] double position_s() const;
  [[nodiscard]] double duration_s() const;
  [[nodiscard]] bool playing() const { return playing_; }
  [[nodiscard]] double speed() const { return speed_; }

 private:
  void schedule();
  /// Publishes the messages up to the position. Of very many, as at a great speed, samples are left out evenly.
  void publish_due();
  /// Publishes what a viewer needs who begins here: of each topic the last messages, and the track so far.
  void publish_before(std::size_t end);
  void publish(const RecordedLog::Entry& entry);

  boost::asio::steady_timer timer_;
  Hub& hub_;
  RecordedLog log_;
  std::string name_;
  double speed_;
  bool playing_ = true;
  bool stopped_ = false;
  bool has_viewer_ = false;
  std::int64_t position_ns_ = 0;  ///< from the first message on
  std::size_t next_ = 0;          ///< entry
  std::chrono::steady_clock::time_point ticked_;
};

struct ViewerSettings {
  std::filesystem::path log;  ///< .mcap
  std::string name;           ///< of the recording, as the page shows it
  std::string version;
  std::uint16_t port = 0;  ///< of the loopback address; 0: any that is free
  double speed = 1;
  std::function<void(double)> progress;            ///< of reading the log, 0..1
  std::function<void(const std::string&)> remark;  ///< for the user: damage of the log
  std::function<void(const std::string&)> ready;   ///< the address of the page, once it is served
};

/// Serves the page with a recording until SIGINT or SIGTERM. Throws record::BadRecording when the log is none,
/// std::runtime_error when the port is taken.
void view_recording(const ViewerSettings& settings);

}  // namespace navcal::web
