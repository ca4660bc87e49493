// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/world_magnetic_model.h"
#include "sim/state.h"

namespace navcal::gap {

using sim::Vector3;

struct CompassReading;

/// The Earth's magnetic field along one mission, as the nominal model has it, and its source.
struct EarthField {
  enum class Source : std::uint8_t {
    reference,  ///< that of sim::State, of no real place
    given,      ///< by the user (--field)
    stated,     ///< by a simulated recording
    model,      ///< the World Magnetic Model's, at the place and date of the first fix
    fitted,     ///< to the readings of the compass; its declination is unknown and set to 0
  };
  Source source = Source::reference;
  Vector3 north_east_down_uT = sim::State{}.field_world_uT;
  std::optional<base::GeodeticPosition> place{};  ///< of the first fix
  std::optional<std::int64_t> utc_ns{};           ///< of the first fix

  /// Sets the World Magnetic Model's field at `place` and `utc_ns`, which both must be there.
  void set_by_model();
  /// Sets a field that replaces the recording's own statement.
  void set_given(const Vector3& uT) {
    source = Source::given;
    north_east_down_uT = uT;
  }
  /// Whether the field is the World Magnetic Model's for a date outside of its years.
  [[nodiscard]] bool is_extrapolated() const;
  /// "2026-06-01"; empty: no date.
  [[nodiscard]] std::string date() const;
};

/// "reference", "given", "stated", "model", "fitted".
[[nodiscard]] std::string_view name_of(EarthField::Source source);

/// "model WMM2025 at 59.33 N 18.07 E on 2026-06-01: north 15.12, east 1.86, down 49.20 uT".
[[nodiscard]] std::string text_of(const EarthField& field);

/// Warning about the field for the reader of a diagnosis; empty: no warning.
[[nodiscard]] std::string doubt_of(const EarthField& field);

/// Parses the field that an `#event` line of a simulated recording states, uT: "simulated field of the Earth:
/// north 19.000, east 0.600, down 44.000 uT". Empty for any other text.
[[nodiscard]] std::optional<Vector3> stated_field_uT(std::string_view event);

/// Fits size and dip of the Earth's field, and iron along x and y, to the readings and their own tilt. Iron
/// along z remains in the field. North is magnetic north. Without readings: the reference field.
[[nodiscard]] EarthField fitted_field(std::span<const CompassReading> readings);

}  // namespace navcal::gap
