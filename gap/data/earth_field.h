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

/// The Earth's field along one mission, as the nominal model has it, and how it is known.
struct EarthField {
  enum class Source : std::uint8_t {
    reference,  ///< that of sim::State, of no real place
    given,      ///< by whoever asks
    stated,     ///< by a simulated recording
    model,      ///< the World Magnetic Model's, at the place and date of the first fix
    fitted,     ///< to the readings of the compass; its declination is unknown and set to 0
  };
  Source source = Source::reference;
  Vector3 north_east_down_uT = sim::State{}.field_world_uT;
  std::optional<base::GeodeticPosition> place{};  ///< of the first fix
  std::optional<std::int64_t> utc_ns{};           ///< of the first fix

  /// The model's field at `place` and `utc_ns`, which both must be there.
  void set_by_model();
  /// Whatever the recording says of it.
  void set_given(const Vector3& uT) {
    source = Source::given;
    north_east_down_uT = uT;
  }
  /// Whether the field is the model's, but of a date outside of its years.
  [[nodiscard]] bool is_extrapolated() const;
  /// "2026-06-01"; empty: no date.
  [[nodiscard]] std::string date() const;
};

/// "reference", "given", "stated", "model", "fitted".
[[nodiscard]] std::string_view name_of(EarthField::Source source);

/// "model WMM2025 at 59.33 N 18.07 E on 2026-06-01: north 15.12, east 1.86, down 49.20 uT".
[[nodiscard]] std::string text_of(const EarthField& field);

/// What to bear in mind when a diagnosis is read; empty: nothing.
[[nodiscard]] std::string doubt_of(const EarthField& field);

/// What an `#event` line of a simulated recording states: "simulated field of the Earth: north 19.000, east 0.600,
/// down 44.000 uT". Nothing for any other text.
[[nodiscard]] std::optional<Vector3> stated_field_uT(std::string_view event);

/// Size and dip that make the readings, with their own tilt, those of one field and of iron along x and y.
/// Iron along z is left to the field. North is magnetic north. Without readings: the reference field.
[[nodiscard]] EarthField fitted_field(std::span<const CompassReading> readings);

}  // namespace navcal::gap
