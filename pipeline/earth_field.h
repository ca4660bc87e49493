// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "config/settings.h"
#include "instruments/samples.h"

namespace navcal::pipeline {

/// The Earth's magnetic field where the vehicle is, and whence it is known.
struct EarthField {
  enum class Source : std::uint8_t { none, configuration, model };

  double declination_rad = 0;  ///< positive east; 0 when not known
  Source declination_source = Source::none;
  double size_uT = 0;  ///< 0 when not known
  double dip_rad = 0;  ///< positive down
  Source size_source = Source::none;

  EarthField() = default;
  /// Begins with the configured field.
  explicit EarthField(const config::EnvironmentSettings& settings);
};

/// "none", "configuration", "model".
[[nodiscard]] std::string_view name_of(EarthField::Source source);

/// "declination 8.21 deg west by the model, ...", for people.
[[nodiscard]] std::string words_for(const EarthField& field);

/// Place and time for which the model was evaluated.
struct FieldPlace {
  double latitude_rad = 0, longitude_rad = 0;
  std::int64_t time_utc_ns = 0;
  template <class Archive>
  void archive(Archive& archive) {
    archive(latitude_rad, longitude_rad, time_utc_ns);
  }
};

/// The field by the World Magnetic Model at the fixes, where the configuration leaves it open; as the vehicle
/// moves, by steps of some 10 km. A fix without a time, or of a year that the model does not cover, says nothing.
class EarthFieldWatch {
 public:
  explicit EarthFieldWatch(const config::EnvironmentSettings& settings);

  /// Whether the field is another one since this fix.
  bool take(const instruments::GpsSample& fix);
  /// The vehicle was there before; whether the field is another one now.
  bool go_on_at(const FieldPlace& place);
  [[nodiscard]] const EarthField& field() const { return field_; }
  /// The place for which the model was asked last.
  [[nodiscard]] const std::optional<FieldPlace>& place() const { return place_; }

 private:
  config::EnvironmentSettings settings_;
  EarthField field_;
  std::optional<FieldPlace> place_;
};

}  // namespace navcal::pipeline
