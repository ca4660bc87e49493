// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace navcal::record {

/// Recordings that were given before, so that none counts twice. They are compared by the bytes that the
/// instruments of rates, heading and field sent, cut into pieces by their content: a log, its capture, and a
/// recording that was played and recorded again have the same pieces.
class SeenRecordings {
 public:
  struct Repetition {
    std::filesystem::path of;  ///< given before
    std::size_t number = 0;    ///< its number among those given, from 0
    double shared_s = 0;       ///< length of the stretch that both hold
    bool is_whole = false;     ///< most of the shorter one
  };
  /// The first one given before that shares a stretch with it. Throws BadRecording.
  std::optional<Repetition> see(const std::filesystem::path& file);
  /// Whether it is to be counted. A repetition becomes a remark for the user. Throws BadRecording.
  bool is_new(const std::filesystem::path& file, std::vector<std::string>& remarks);

 private:
  struct Pieces {
    std::filesystem::path file;
    std::unordered_map<std::uint64_t, double> seconds{};  ///< of each piece, by its hash
    double total_s = 0, duration_s = 0;                   ///< of all pieces; of the recording
  };
  static void read(Pieces& into);
  std::vector<Pieces> seen_;
};

}  // namespace navcal::record
