// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "cli/decode_input.h"
#include "record/recording.h"

namespace navcal::cli {

/// Bytes that one port of a recording received, as one stream.
class PortBytes final : public DecodeSource {
 public:
  /// Throws Failure when the file is no recording (bad input) or has no such port (usage; names those it has).
  PortBytes(const std::string& file, const std::string& port);

  /// Protocol of the port, from the recording's port line or configuration.
  [[nodiscard]] protocols::Protocol protocol() const;
  /// Its settings, likewise.
  [[nodiscard]] const config::PortSettings& settings() const { return recording_->settings().ports[port_]; }
  /// When the bytes of the newest next() arrived; nullopt before the first.
  [[nodiscard]] std::optional<std::int64_t> arrival_ns() const { return arrival_ns_; }
  protocols::Bytes next() override;
  void show(analysis::Progress& progress) const override { progress.show(recording_->progress()); }
  /// Remarks for the user once the end is reached: "last line cut short".
  [[nodiscard]] const std::vector<std::string>& remarks() const { return recording_->remarks(); }

 private:
  std::unique_ptr<record::Recording> recording_;
  std::uint16_t port_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::optional<std::int64_t> arrival_ns_;
};

}  // namespace navcal::cli
