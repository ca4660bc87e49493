// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "record/capture/capture_writer.h"
#include "validation/cases.h"
#include "validation/layout_cases.h"
#include "validation/reference/sink.h"

namespace navcal::validation {

/// Text of a capture of what a reference simulator transfers on these ports. Throws Failure when interrupted.
class CaptureText final : public reference::Sink {
 public:
  explicit CaptureText(std::span<const reference::Port> ports);
  void transfer(const reference::Transfer& transfer) override;
  void truth(const reference::Snapshot& snapshot) override;
  std::string text;

 private:
  std::span<const reference::Port> ports_;
  record::CaptureWriter writer_;
};

/// Whole or not at all. Throws std::system_error.
void write_file(const std::filesystem::path& path, std::string_view text);
/// Empty where the file cannot be read.
[[nodiscard]] std::string content_of(const std::filesystem::path& file);

/// The capture of one mission; empty when the vehicle was lost. Throws Failure when interrupted.
[[nodiscard]] std::string capture_of(const LayoutRecording& recording);

/// Writes into the folder what `navcal identify` and `navcal gap` need of a vehicle with a layout: its data sheet
/// sheet.toml, the configuration navcald.toml with the file that it names, and the nominal recordings, whose names
/// it returns. Throws as write_recordings().
[[nodiscard]] std::vector<std::string> write_vehicle(const LayoutVehicle& vehicle,
                                                     const std::filesystem::path& folder);

/// Swims the three missions of a case and writes a.cap (to be diagnosed), b.cap and c.cap (held out) into the
/// folder: nothing in or about them tells of the case. Throws Failure when the vehicle was lost or the trial is
/// interrupted, std::system_error.
[[nodiscard]] std::array<std::filesystem::path, 3> write_recordings(const TrialCase& drawn,
                                                                    const std::filesystem::path& folder);

/// Writes vehicle.toml with the density of the water: whoever swims somewhere knows how salt it is.
std::filesystem::path write_vehicle_file(const TrialPlace& place, const std::filesystem::path& folder);

/// Swims one mission and writes its capture. Throws as write_recordings().
void write_recording(const reference::Mission& mission, const reference::VehicleUnderTest& vehicle,
                     std::uint64_t seed, const std::filesystem::path& file);

}  // namespace navcal::validation
