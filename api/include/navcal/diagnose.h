// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <navcal/export.h>
#include <navcal/progress.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace navcal::api {

/// Options of a diagnosis. The members have the names of the options of `navcal gap`.
struct DiagnoseOptions {
  std::vector<std::filesystem::path>
      holdouts;  ///< other missions of the same vehicle, on which the answer is judged
  /// Recordings of the same vehicle without a gap, which show what is no gap; a vehicle file is then
  /// compared as the layout that it is.
  std::vector<std::filesystem::path> nominals;
  bool steady = false;            ///< judge by mean forces over steady stretches alone
  std::filesystem::path vehicle;  ///< the nominal one, a vehicle file or a layout; empty: the reference vehicle
  std::filesystem::path config;   ///< of all recordings, instead of their own; empty: none
  std::optional<std::array<double, 3>>
      field_uT;                      ///< the Earth's: north, east, down; nullopt: as the recording states
  std::vector<std::string> exclude;  ///< effects that the library is to be without
  /// Instruments to be left out of all recordings, as if they were not there: compass, field, tilt, card, gyros,
  /// accelerometers, depth, gps or motor.
  std::vector<std::string> without;
  int bank = 100;               ///< simulated null missions, 10 to 10000; not with nominals
  std::uint64_t seed = 1;       ///< of their noise and tolerances
  std::filesystem::path cache;  ///< folder in which null banks are kept; empty: none are kept
  unsigned threads = 0;         ///< 0: as many as there are processors
  Progress progress;            ///< its steps are those of the diagnosis, several with shares of their own
};

/// Verdict of a diagnosis.
enum class Verdict : std::uint8_t {
  no_gap,     ///< nothing beyond the tolerances of the nominal vehicle
  explained,  ///< a set of effects explains the gap, and improves what was held out
  unknown,    ///< there is a gap, and nothing in the library explains it; or the recording cannot be diagnosed
};

/// A channel whose residuals exceed the nominal vehicle's, and the regime that explains the excess.
struct Where {
  std::string channel;  ///< "compass.field"
  std::string regime;   ///< "motor_current"
  double gap = 0;       ///< root mean square of the part that follows the regime
  double floor = 0;     ///< the same of the null missions
  std::string unit;     ///< of both: "uT"
  double p_value = 1;   ///< of such a value among nulls, over all channels and regimes together
};

/// A parameter of an effect.
struct EffectParameter {
  std::string name;      ///< with its unit: "x_uT_per_A"
  double value = 0;      ///< posterior mean
  double std_error = 0;  ///< posterior standard deviation
};

/// Another effect that explains much the same.
struct Confusion {
  std::string name;            ///< of the other effect
  std::string tie_breaker;     ///< manoeuvre that separates them
  double separation_nats = 0;  ///< expected log evidence between both in this mission
};

/// An effect as a cause.
struct Effect {
  std::string name;                         ///< as in the library of effects
  std::string of;                           ///< part of a layout, "thruster.2"; empty: of the whole vehicle
  double probability = 0;                   ///< posterior
  std::vector<EffectParameter> parameters;  ///< all of the effect
  std::vector<Confusion> confused_with;     ///< others that are hard to tell from it
};

/// Share of a gap that goes away with the effects: 1 - (after - floor) / (before - floor).
struct Closure {
  double before = 0;                               ///< of the nominal model
  double after = 0;                                ///< of the model with the effects
  double floor = 0;                                ///< of the null missions
  std::optional<double> closed;                    ///< nullopt: the gap is not significantly above the floor
  std::optional<std::array<double, 2>> closed_ci;  ///< interval of 95 %
};

/// Closure of one channel.
struct ChannelClosure {
  std::string channel;  ///< "compass.heading"
  std::string unit;     ///< of the root mean square of the innovations
  Closure closure;      ///< in that unit
};

/// A change of a channel's residuals within the mission.
struct ChangePoint {
  std::string channel;  ///< "compass.heading"
  double time_s = 0;    ///< since the beginning of the mission
  double before = 0;    ///< mean level
  double after = 0;     ///< mean level
  std::string unit;     ///< of both levels
};

/// The answer of a diagnosis.
struct Diagnosis {
  Verdict verdict = Verdict::unknown;    ///< for programs
  std::string sentence;                  ///< for people
  std::vector<Where> where;              ///< significant cells, strongest first
  std::vector<Effect> effects;           ///< the set on which the verdict rests
  std::vector<Effect> candidates;        ///< all that were considered likely, most probable first
  Closure gap;                           ///< power of whitened innovations; 1 is the noise of the nominal vehicle
  std::vector<ChannelClosure> channels;  ///< of each channel
  bool held_out = false;                 ///< judged on other missions; else on blocks of this one, which is weaker
  std::optional<std::array<double, 2>> heading_error_rad;          ///< root mean square, before and after
  std::optional<std::array<double, 2>> dead_reckoning_m_per_100m;  ///< before and after
  std::vector<std::string> unexplained;     ///< structure that is left in the residuals, for people
  std::vector<std::string> next;            ///< next steps, for people
  std::vector<std::string> remarks;         ///< about the recordings and limits of the diagnosis, for people
  std::array<double, 4> gyro_bias_rad_s{};  ///< of the gyros A-x, A-z, B-y, B-z
  std::vector<ChangePoint> changes;         ///< within the mission
  int bank_missions = 0;                    ///< null missions used
  bool bank_from_cache = false;             ///< they were kept from before
  double duration_s = 0;                    ///< of the mission
  double seconds = 0;                       ///< computing time, without the bank's
  std::string json;                         ///< the answer of `navcal gap --json -`, without its newline
  std::string effects_toml;  ///< the answer of `navcal gap --effects-out`: for SimulateOptions::effects_file
  std::string layout_toml;   ///< of a layout: the layout with the causes found, as of `--export layout`
};

/// Diagnoses where and why a recording departs from the model of the vehicle, as `navcal gap` does. `mission` is a
/// capture or a log. Takes minutes without a null bank in the cache. A recording that cannot be diagnosed gets the
/// verdict `unknown` and remarks that say why. Throws Error: bad_input for a file that is no recording,
/// bad_argument for an effect that is not in the library and for a hold-out that shares readings with another
/// file. Source: docs/gap.md.
[[nodiscard]] NAVCAL_API Diagnosis diagnose(const std::filesystem::path& mission,
                                            const DiagnoseOptions& options = {});

/// Diagnoses several recordings of one vehicle together: effects are common to all, biases and currents are each
/// recording's own. At least one. Throws as diagnose() does, and Error of the kind bad_argument without a
/// recording.
[[nodiscard]] NAVCAL_API Diagnosis diagnose_together(const std::vector<std::filesystem::path>& missions,
                                                     const DiagnoseOptions& options = {});

}  // namespace navcal::api
