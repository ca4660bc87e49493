// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/samples.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace navcal::instruments {

// What the installed library has as well, in one place: its header says what each member is. Members `..._std_...`
// are standard errors of one reading: as the device states them, else by the configuration's table [instruments]
// (pipeline/standard_errors.h).
using api::AltimeterSample, api::CalibrationName, api::CardState, api::CompassSample, api::DepthSample,
    api::DvlSample, api::Fix, api::GpsSample, api::ImuSample, api::MotorSample, api::PowerSample, api::Stamp,
    api::Vector3, api::VelocityFrame;

/// A short text of fixed size, so that a sample needs no memory of its own. Longer ones are cut.
template <std::size_t Size>
class Text {
 public:
  constexpr Text() = default;
  constexpr explicit Text(std::string_view text) {
    for (std::size_t i = 0; i < text.size() && i < Size; ++i) text_[i] = text[i];
  }
  [[nodiscard]] constexpr std::string_view view() const {
    std::size_t n = 0;
    while (n < Size && text_[n] != '\0') ++n;
    return {text_.data(), n};
  }
  constexpr bool operator==(const Text&) const = default;

 private:
  std::array<char, Size> text_{};
};

/// Satellites in view.
struct SkySample {
  struct Satellite {
    std::uint16_t prn = 0;
    std::optional<float> elevation_deg, azimuth_deg, cn0_dBHz;
    bool used = false;
  };
  static constexpr std::size_t kMaxSatellites = 64;
  std::array<Satellite, kMaxSatellites> satellites{};
  std::size_t count = 0;
};

/// A mission sensor: one quantity with its name and unit as the sender writes them ("oxygen", "umol/l").
struct ScalarSample {
  Text<24> quantity;
  Text<16> unit;
  double value = 0;
  std::optional<double> value_std;
};

struct Sample {
  std::uint16_t port = 0;  ///< index into the configuration's ports
  Stamp stamp;
  CalibrationName calibration;
  std::variant<CompassSample, ImuSample, GpsSample, SkySample, MotorSample, AltimeterSample, PowerSample,
               DvlSample, DepthSample, ScalarSample>
      value;
};

}  // namespace navcal::instruments
