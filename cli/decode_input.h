// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "protocols/frame.h"
#include "record/recording.h"

namespace navcal::cli {

/// Bytes of one device, piece by piece.
class DecodeSource {
 public:
  DecodeSource() = default;
  DecodeSource(const DecodeSource&) = delete;
  DecodeSource& operator=(const DecodeSource&) = delete;
  virtual ~DecodeSource() = default;

  /// The next bytes, valid until the next call; empty at the end.
  virtual protocols::Bytes next() = 0;
  /// Tells a user who waits how far it has come.
  virtual void show(base::Progress& progress) const = 0;
};

/// A file, or standard input for "-", read from its beginning in large blocks. Throws Failure (bad input, the file
/// named) when it cannot be opened or read, and when it is a recording of several devices.
class Input final : public DecodeSource {
 public:
  explicit Input(const std::string& file);
  ~Input() override;

  protocols::Bytes next() override;
  void show(base::Progress& progress) const override { progress.show_bytes(done_, size_); }

 private:
  static constexpr std::size_t kBlock = std::size_t{256} << 10;

  void refuse_recording(protocols::Bytes first) const;

  std::string name_;
  int descriptor_ = -1;
  std::uint64_t done_ = 0;
  std::optional<std::uint64_t> size_;  ///< of a regular file; nullopt for pipes and devices
  std::vector<std::uint8_t> block_;
};

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
  void show(base::Progress& progress) const override { progress.show(recording_->progress()); }
  /// Remarks for the user once the end is reached: "last line cut short".
  [[nodiscard]] const std::vector<std::string>& remarks() const { return recording_->remarks(); }

 private:
  std::unique_ptr<record::Recording> recording_;
  std::uint16_t port_ = 0;
  std::vector<std::uint8_t> bytes_;
  std::optional<std::int64_t> arrival_ns_;
};

}  // namespace navcal::cli
