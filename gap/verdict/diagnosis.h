// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calib/suite/report.h"
#include "gap/actuators/command_check.h"
#include "gap/data/earth_field.h"
#include "gap/data/innovations.h"
#include "gap/data/mission.h"
#include "gap/data/silence.h"

// Results of a diagnosis: the numbers behind `navcal gap --json`, the text and the page (docs/gap.md).
namespace navcal::gap {

/// Positions over time: north and east in metres of the mission's first fix.
struct Track {
  std::vector<double> time_s, north_m, east_m;
};

/// Measured fixes, and the positions that the model reckons from the first fix on without any later correction.
/// Speed through the water follows from the recorded shaft speed, heading from the model's own estimate by
/// compass and gyros. A water current moves the fixes and not the reckoned tracks.
struct Tracks {
  Track fixes, nominal, improved;  ///< improved: with the effects found; empty without any
};

[[nodiscard]] Track track_of_fixes(const Mission& mission);
/// Dead reckoning along a replay's course from the mission's first fix on; empty without a fix.
[[nodiscard]] Track reckoned_track(const Trajectory10Hz& course, const Mission& mission);

enum class Verdict : std::uint8_t {
  no_gap,     ///< nothing beyond a tolerance of 2 % on everything
  explained,  ///< a set of effects wins, leaves nothing but noise, and improves what was held out
  unknown,    ///< anything else: UnknownKind
};
/// "no-gap", "explained", "unknown".
[[nodiscard]] std::string_view name_of(Verdict verdict);

enum class UnknownKind : std::uint8_t {
  ambiguous,   ///< several sets of effects explain the gap
  outside,     ///< there is a gap, and nothing in the library explains it
  cannot_say,  ///< the recordings do not tell
};
/// "ambiguous", "outside", "cannot say".
[[nodiscard]] std::string_view name_of(UnknownKind kind);

/// Cell of the residual map: a channel whose residuals exceed the nominal vehicle's, and the regime that
/// explains the excess.
struct WhereEntry {
  std::string channel;  ///< "compass.field"
  std::string regime;   ///< "motor_current"
  double gap = 0;       ///< root mean square of the part that follows the regime
  double floor = 0;     ///< the same of the null missions
  std::string unit;     ///< of both: "uT"
  double p_value = 1;   ///< probability of such a value among nulls, over all channels and regimes together
};

/// An error of one component of a source that follows a quantity of the mission.
struct ErrorFinding {
  std::string component;              ///< "x"
  std::string channel;                ///< of the residual map; empty: none belongs to it
  std::string regime;                 ///< of the residual map, nearest to the quantity
  std::string follows;                ///< the quantity: "yaw_rate x speed"
  std::vector<std::string> families;  ///< kinds of quantities in it: "rate", "speed"
  double rms = 0, std_error = 0;      ///< size of the error; negative: against the quantity
  std::string unit;
  double strength = 0;  ///< the size in typical ones of the component
};

/// An instrument or force by whose error the residuals can be described.
struct SourceFinding {
  std::string name;      ///< "compass.tilt"
  std::string words;     ///< "the inclinometer"
  double gain_nats = 0;  ///< log evidence over that of a vehicle within tolerance
  std::vector<ErrorFinding> errors;
  /// No channel of its errors has a significant place, although they are measured: it describes others only.
  bool closes_nothing = false;
};

struct EffectParameterEstimate {
  std::string name;  ///< with its unit: "x_uT_per_A"
  double value = 0, std_error = 0;
};

struct Confusion {
  std::string name;
  std::string tie_breaker;     ///< the manoeuvre that separates them
  double separation_nats = 0;  ///< expected log evidence between both in this mission
};

/// "fin_gain", or "thrust_scale of thruster.2" where it belongs to a part of a layout.
[[nodiscard]] inline std::string effect_words(const std::string& name, const std::string& of) {
  return of.empty() ? name : name + " of " + of;
}

struct EffectFinding {
  std::string name;
  double probability = 0;
  std::vector<EffectParameterEstimate> parameters;
  std::vector<Confusion> confused_with;
  std::string manoeuvre = {};  ///< the manoeuvre that shows the effect
  std::string of = {};         ///< part of a layout that it belongs to: "thruster.2"; empty: the vehicle

  [[nodiscard]] std::string words() const { return effect_words(name, of); }
};

/// Share of the gap that goes away: `closed` = 1 - (after - floor) / (before - floor), on held-out data. Empty
/// where the gap before is not significantly above the floor.
struct Closure {
  double before = 0, after = 0, floor = 0;
  std::optional<double> closed;
  std::optional<std::array<double, 2>> closed_ci;  ///< 95 %
};

/// A set of effects that explains an ambiguous gap.
struct Alternative {
  std::vector<EffectFinding> effects;
  double probability = 0;
  std::optional<double> closed;  ///< as in Closure
};

/// Description of what no effect explains, by the errors of the leading source. It is no cause.
struct Proposal {
  SourceFinding source;
  bool held_out = false;  ///< judged on other recordings; else on minutes of this one, which is weaker
  double held_out_gain_nats = 0;
  Closure power;  ///< of the whitened residuals on the same data, without and with the errors; `closed` is empty
};

struct ChannelClosure {
  std::string channel, unit;  ///< root mean square of the innovations, in the unit
  Closure closure;
};
struct Gap {
  Closure pooled;  ///< power of whitened innovations; 1 is the noise of the nominal vehicle
  std::vector<ChannelClosure> channels;
  bool held_out = false;  ///< on other missions; else on blocks of this one, which is weaker
  /// Navigation errors by the model, before and after: heading error RMS, and position error per 100 m between
  /// fixes.
  std::optional<std::array<double, 2>> heading_error_rad;
  std::optional<std::array<double, 2>> dead_reckoning_m_per_100m;
};

/// Data of a figure: innovations of one channel against a covariate, before and after.
struct Scatter {
  std::string channel, unit;  ///< of the innovations
  std::string driver, driver_unit;
  std::vector<double> driver_value, before, after;
};
/// Data of a figure: innovations of one channel against time, means of equal intervals.
struct Course {
  std::string channel, unit;
  std::vector<double> time_s, before, after;
};

/// Whether and when a channel's residuals changed in mid-mission.
struct ChangePoint {
  std::string channel;
  double time_s = 0;
  double before = 0, after = 0;  ///< mean level
  std::string unit;
};

struct BankFacts {
  int missions = 0;
  std::uint64_t seed = 0;
  bool from_cache = false;
  double seconds = 0;  ///< computing time of the bank
};

/// Instruments of the diagnosed recording that are silent, all the time or for a while, and the consequence.
struct InstrumentFacts {
  std::vector<std::string> missing;  ///< "GPS", "magnetic field"
  std::vector<Interruption> interrupted;
  std::vector<std::string> not_judged;  ///< effects that the other instruments hardly show
};

/// What one of several recordings says by itself.
struct RecordingFinding {
  std::string recording;
  std::vector<EffectFinding> effects;  ///< those of the joint answer, as this recording alone estimates them
  /// The most probable effects of a search in this recording alone.
  struct Alone {
    std::vector<std::string> effects;
    double probability = 0;
  };
  std::optional<Alone> alone;  ///< only where effects do not explain all recordings together, or differ among them
};

/// Whether an effect is the same in all recordings.
struct EffectDifference {
  std::string name;
  double p_value = 1;  ///< of estimates that differ as much by their errors
  bool differs = false;
  std::string of = {};  ///< part of a layout that it belongs to

  [[nodiscard]] std::string words() const { return effect_words(name, of); }
};

/// Smallest size of an effect that would have stood out.
struct LeastVisible {
  std::string name, of, parameter;  ///< of its parameters the one that shows least
  std::optional<double> value;      ///< its size, in the parameter's unit; empty: no size would
  double typical = 1;

  [[nodiscard]] std::string words() const { return effect_words(name, of); }
};

struct Diagnosis {
  Verdict verdict = Verdict::unknown;
  UnknownKind kind = UnknownKind::cannot_say;  ///< of the verdict unknown
  std::vector<Alternative> alternatives;       ///< of an ambiguous gap, most probable first
  std::string sentence;                        ///< the verdict for people
  std::vector<WhereEntry> where;               ///< significant cells, strongest first
  std::vector<WhereEntry> map;                 ///< every channel and regime, for the figure
  std::vector<SourceFinding> sources;          ///< where the error enters, best description first
  std::optional<Proposal> proposal;            ///< only where the verdict is unknown
  std::vector<EffectFinding> effects;          ///< the set on which the verdict rests
  std::vector<EffectFinding> candidates;       ///< all that were considered likely, most probable first
  Gap gap;
  std::vector<std::string> unexplained;  ///< structure that is left in the residuals
  std::vector<std::string> next;         ///< next steps: a manoeuvre, an effect to add
  std::vector<std::string> remarks;  ///< about the recording: gaps, missing instruments, limits of the diagnosis
  std::array<double, 4> gyro_bias_rad_s{};  ///< A-x, A-z, B-y, B-z; a nuisance, never a cause
  InstrumentFacts instruments;
  std::optional<CommandCheck> commands;  ///< empty: the recording could not be read so far
  /// Smallest ratio to their floor of the residuals by which the motion departs from the model of the vehicle,
  /// root mean square. Empty without a null bank, and where hardly a channel shows the motion.
  std::optional<double> least_ratio;
  std::vector<ChangePoint> changes;
  std::optional<Scatter> scatter;   ///< of the strongest channel
  std::vector<Course> courses;      ///< of each channel
  std::optional<EarthField> field;  ///< of the nominal model in this mission
  std::optional<Tracks> tracks;
  /// Comparison of the instruments with each other, where one is missing that the search for causes needs.
  std::optional<calib::Report> instruments_alone;
  std::vector<RecordingFinding> recordings;   ///< of several that were diagnosed together; else empty
  std::vector<EffectDifference> differences;  ///< among them
  BankFacts bank;
  double duration_s = 0;                    ///< of the missions together
  double seconds = 0;                       ///< computing time of the diagnosis, without the bank
  std::vector<LeastVisible> least_visible;  ///< of the causes of a layout, where the verdict is no gap
};

}  // namespace navcal::gap
