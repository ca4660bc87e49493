// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace navcal::cli {

/// A log in the folder of a running navcald.
struct RemoteLog {
  std::string name;
  std::uint64_t bytes = 0;
  bool finished = false;
  std::string begin, end;  ///< UTC as the daemon writes it; empty: not known
};

/// The log commands of navcald, through whatever carries them. Every function throws base::Failure for an answer
/// that cannot be read, and what the carrier throws.
class LogLink {
 public:
  /// The answer to a request that navcald has granted.
  using Ask = std::function<nlohmann::json(const nlohmann::json& request)>;
  /// `part_bytes`: so many are asked for at once.
  LogLink(Ask ask, std::uint64_t part_bytes) : ask_(std::move(ask)), part_bytes_(part_bytes) {}

  [[nodiscard]] std::vector<RemoteLog> list();
  /// Those of these names, or all that are finished. Throws base::Failure for a name that is none.
  [[nodiscard]] std::vector<RemoteLog> wanted(const std::vector<std::string>& names);
  /// Bytes from `offset` on, as many as one answer holds; their checksum is right. Empty at the end of the log.
  [[nodiscard]] std::string read(const std::string& name, std::uint64_t offset);
  /// CRC-32 of `length` bytes from `offset` on.
  [[nodiscard]] std::uint32_t sum(const std::string& name, std::uint64_t offset, std::uint64_t length);

 private:
  Ask ask_;
  std::uint64_t part_bytes_;
};

/// Downloads a log; false: it is there already. `target`.part grows; one that is left of an earlier attempt is
/// continued as far as its bytes are those of the log. It is renamed to `target` once every byte has been compared
/// by checksum. A file of that name is never overwritten. `progress` gets the bytes that are there. Throws
/// base::Failure, std::system_error and what `link` throws; the part then stays.
bool fetch_log(LogLink& link, const RemoteLog& log, const std::filesystem::path& target,
               const std::function<void(std::uint64_t bytes)>& progress);

}  // namespace navcal::cli
