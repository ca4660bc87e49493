// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>
#include <navcal/samples.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace navcal::api {

/// How a mapping to UTC was found.
enum class UtcSource : std::uint8_t {
  file,                 ///< a file states it
  system,               ///< the system clock, which nothing synchronises
  system_synchronised,  ///< the system clock, which is synchronised
};

/// utc = monotonic + offset, to within `bound`.
struct UtcMapping {
  UtcSource source = UtcSource::system;  ///< how it was found
  std::int64_t offset_ns = 0;            ///< UTC since 1970-01-01, less the monotonic time
  std::int64_t bound_ns = 0;             ///< half width of the interval in which the offset lies, at `at_ns`
  std::int64_t at_ns = 0;                ///< monotonic time at which it was found
};

/// Counters of one port's stream, from the beginning on. Every byte is framed, skipped or held.
struct PortCounters {
  std::uint64_t framed_bytes = 0;   ///< in intact frames
  std::uint64_t skipped_bytes = 0;  ///< in no frame
  std::uint64_t held_bytes = 0;     ///< in a frame that is not complete yet
  std::uint64_t samples = 0;        ///< made of the frames
};

/// Bytes of serial ports to stamped and calibrated samples: the pipeline of navcald, without ports or clock of its
/// own. The same calls give bit-identical samples, however the bytes of one arrival are cut. An object may be used
/// by one thread at a time. Source: docs/timing.md.
class NAVCAL_API Pipeline {
 public:
  /// The pipeline of a configuration of navcald (docs/configuration.md). Throws Error (bad_input).
  [[nodiscard]] static Pipeline from_file(const std::filesystem::path& config);
  /// The same from memory; `name` stands for the file in messages. Throws Error (bad_input).
  [[nodiscard]] static Pipeline from_text(std::string_view toml, std::string_view name = "configuration");
  ~Pipeline();
  Pipeline(Pipeline&& other) noexcept;             ///< Takes over; `other` can only be destroyed or assigned to.
  Pipeline& operator=(Pipeline&& other) noexcept;  ///< Takes over; `other` can only be destroyed or assigned to.

  /// Ports of the configuration, in its order.
  [[nodiscard]] const std::vector<Port>& ports() const;
  /// Index of the port of that name. Throws Error (bad_argument) when there is none.
  [[nodiscard]] std::size_t port(std::string_view name) const;

  /// The bytes of one completed read of a port, and its monotonic time. Returns the samples that they complete, of
  /// this port and of others that waited. Throws Error (bad_argument) for a port that there is not, and for a time
  /// before that of an earlier call.
  std::vector<Sample> push(std::size_t port, std::int64_t arrival_ns, std::span<const std::uint8_t> bytes);
  /// Time has passed without bytes: frames that have waited too long are given up. push() does so itself. Throws
  /// Error (bad_argument) for a time before that of an earlier call.
  std::vector<Sample> advance(std::int64_t now_ns);
  /// Sets the mapping to UTC. Without it, UTC is not known before a GPS receiver states it.
  std::vector<Sample> set_mapping(const UtcMapping& mapping);

  /// Counters of a port. Throws Error (bad_argument) for a port that there is not.
  [[nodiscard]] PortCounters counters(std::size_t port) const;

 private:
  struct State;
  explicit Pipeline(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace navcal::api
