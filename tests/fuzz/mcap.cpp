// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdlib>
#include <string>

#include "record/log/log_encoder.h"
#include "record/log/log_reader.h"
#include "record/log/log_recording.h"
#include "tests/fuzz/target.h"
#include "tests/record/memory_source.h"

namespace navcal::fuzz::mcap_target {

using namespace navcal;

/// A short log to be damaged: the fuzzer would not find checksums by itself.
std::string small_log() {
  config::Settings settings;
  settings.ports.resize(1);
  settings.ports[0].name = "imu";
  record::LogEncoder encoder(settings, "");
  std::string out;
  encoder.begin(out, 1, {});
  for (std::uint8_t i = 0; i < 8; ++i) encoder.raw(out, 0, record::Direction::received, i, {&i, 1});
  encoder.event(out, 9, "info", "x", "", "y");
  return out;
}

// The first byte chooses: the bytes as a file, or behind a whole log, or as changes to one.

NAVCAL_FUZZ(mcap) {
  static const std::string kLog = small_log();
  if (size == 0) return 0;
  const std::string_view input(reinterpret_cast<const char*>(data) + 1, size - 1);
  std::string file = data[0] % 3 == 0 ? std::string(input) : kLog;
  if (data[0] % 3 == 1) file += input;
  if (data[0] % 3 == 2) {
    for (std::size_t i = 0; i + 2 < input.size(); i += 3) {
      const auto high = static_cast<std::size_t>(static_cast<unsigned char>(input[i]));
      const std::size_t at = high << 8 | static_cast<unsigned char>(input[i + 1]);
      file[at % file.size()] = input[i + 2];
    }
  }
  try {
    record::LogReader reader(std::make_unique<record::MemorySource>(file), "fuzz");
    std::uint64_t last = 0;
    while (const auto message = reader.next()) {
      if (message->offset < last || message->offset + message->data.size() > file.size()) std::abort();
      last = message->offset;
    }
    const auto& findings = reader.findings();
    if (findings.data_end > file.size() || findings.damaged_bytes > file.size()) std::abort();
    record::LogRecording recording(std::make_unique<record::MemorySource>(file), "fuzz");
    while (recording.next()) {
    }
  } catch (const record::BadRecording&) {
  }
  return 0;
}

}  // namespace navcal::fuzz::mcap_target
