// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "instruments/instrument.h"
#include "protocols/described/reading.h"

namespace navcal::instruments {

/// A device that a file describes (docs/devices.md). One frame can give samples of several kinds; the first of
/// them paces the device's clock.
class DescribedDevice : public Instrument {
 public:
  /// Without a description in the settings, every frame is ignored.
  explicit DescribedDevice(const config::PortSettings& settings);
  Verdict read(const protocols::Frame& frame, Receiver& receiver) override;

 private:
  using Meaning = protocols::described::Meaning;

  /// A mission sensor among the fields.
  struct Sensor {
    std::size_t field = 0;
    Text<24> quantity;
    Text<16> unit;
    std::optional<double> std;
  };
  /// One kind of frame: where its values go, and which samples they make.
  struct Kind {
    explicit Kind(const protocols::described::FrameKind& kind, bool is_text);

    protocols::FrameId id;
    protocols::described::FrameReader reader;
    std::vector<Meaning> meanings;  ///< of the fields, in their order
    std::vector<double> values;     ///< of the newest frame, in the same order; NaN: absent
    /// The same by meaning; those that the frame does not have are always NaN.
    std::array<double, protocols::described::kMeaningCount> by_meaning{};
    std::array<std::optional<double>, protocols::described::kMeaningCount> std_by_meaning;
    std::vector<Sensor> sensors;
    bool is_imu = false, is_compass = false, is_gps = false, is_motor = false, is_power = false, is_dvl = false,
         is_depth = false, is_altimeter = false, is_thermometer = false;
    bool has_card_state = false;

    [[nodiscard]] std::optional<double> value(Meaning meaning) const;
    [[nodiscard]] std::optional<double> std(Meaning meaning) const {
      return std_by_meaning[static_cast<std::size_t>(meaning)];
    }
    [[nodiscard]] bool flag(Meaning meaning) const { return value(meaning).value_or(0) != 0; }
    /// All three of consecutive meanings, or nothing.
    [[nodiscard]] std::optional<Vector3> vector(Meaning first) const;
  };

  /// Members by their meaning; the rules between members are those of the functions below.
  template <class S>
  [[nodiscard]] static S sample_of(const Kind& kind);
  [[nodiscard]] static CompassSample compass_of(const Kind& kind);
  [[nodiscard]] static GpsSample gps_of(const Kind& kind);
  [[nodiscard]] static DvlSample dvl_of(const Kind& kind);
  [[nodiscard]] static DepthSample depth_of(const Kind& kind);
  /// Hands over the samples of the newest frame; false when it has none.
  static bool hand_over(const Kind& kind, Receiver& receiver);

  std::vector<Kind> kinds_;
};

}  // namespace navcal::instruments
