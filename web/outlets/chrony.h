// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/time.h>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/local/datagram_protocol.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "web/hub.h"

namespace navcal::web {

/// One measurement for chrony's refclock driver SOCK, as chrony's refclock_sock.c reads it.
struct ChronySample {
  timeval tv;     ///< of the system clock, at the measurement
  double offset;  ///< of the true time from the system clock, in seconds
  int pulse = 0;  ///< 0: the offset is whole, not only its fraction of a second
  int leap = 0;   ///< no leap second is announced
  int padding = 0;
  int magic = 0x534f434b;
};

/// navcald's mapping from the monotonic clock to UTC.
struct ClockMapping {
  bool is_gps = false;
  std::int64_t offset_ns = 0;  ///< UTC minus monotonic
  std::int64_t at_ns = 0;      ///< monotonic time at which it was found
};
/// Reads a message of the topic /time. Nullopt when it is none.
[[nodiscard]] std::optional<ClockMapping> read_mapping(std::string_view message);

/// Both clocks at one instant, in nanoseconds.
struct ClockPair {
  std::int64_t monotonic_ns = 0;
  std::int64_t system_ns = 0;
};
[[nodiscard]] ClockPair read_clocks();

/// The sample of a mapping. Nullopt when chrony must not have it: the mapping is not GPS's, or it is not fresh.
///
/// chrony slews the monotonic clock together with the system clock. A mapping that is used later therefore shows
/// the old offset although chrony has corrected it, and chrony would correct it again and again. So each mapping
/// gives one sample, and only while it is young.
[[nodiscard]] std::optional<ChronySample> chrony_sample(const ClockMapping& mapping, const ClockPair& now);

struct ChronyCounters {
  std::uint64_t samples = 0;
  std::uint64_t not_sent = 0;  ///< nobody took them: chronyd is away, or its socket is not ours to write
};

/// Hands UTC from GPS to chronyd on this machine.
class Chrony final : public Subscriber {
 public:
  Chrony(const boost::asio::any_io_executor& executor, std::string socket_path, Hub& hub);
  ~Chrony() override;
  Chrony(const Chrony&) = delete;
  Chrony& operator=(const Chrony&) = delete;

  [[nodiscard]] const ChronyCounters& counters() const { return counters_; }
  void on_record(const Record& record) override;

 private:
  void send(const ChronySample& sample);

  Hub& hub_;
  std::string path_;
  boost::asio::local::datagram_protocol::socket socket_;
  ChronyCounters counters_;
  std::int64_t last_at_ns_ = 0;
  std::string told_problem_;
};

}  // namespace navcal::web
