// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "config/settings.h"
#include "devices/instrument_model.h"
#include "gap/data/earth_field.h"
#include "gap/data/silence.h"
#include "instruments/samples.h"
#include "pipeline/pipeline.h"
#include "protocols/motor_card.h"
#include "record/recording.h"
#include "sim/state.h"

namespace navcal::gap {

// Times are seconds since the recording's first byte, body axes x forward, y starboard, z down. NaN is what an
// instrument does not measure: all components of a vector, roll with pitch, the first three gyros together.

struct CompassReading {
  double time_s = 0;
  std::optional<double> heading_rad;  ///< magnetic
  double roll_rad = 0, pitch_rad = 0;
  Vector3 field_uT{};
  std::optional<double> electronics_C;
};

struct CardReading {
  double time_s = 0;
  std::array<double, 4> gyro_rad_s{};  ///< A-x, A-z, B-y, B-z
  Vector3 force_m_s2{};
  double depth_m = 0;
};

struct FixReading {
  double time_s = 0;
  std::array<double, 2> position_m{};                   ///< north, east of the mission's first fix
  std::optional<std::array<double, 2>> velocity_m_s{};  ///< north, east over ground; none below the course gate
  int number = 0;  ///< count since the sky came in sight; the first ones are poor
};

struct MotorReading {
  double time_s = 0;
  double rpm = 0;
  Vector3 fins_rad{};
  double current_A = 0;
};

/// A command to the motor card: what the vehicle was told, not what it did.
struct Order {
  double time_s = 0;
  double rpm = 0;
  Vector3 fins_rad{};
};

[[nodiscard]] Order order_of(const protocols::motor_card::Command& command, double time_s);

/// Readings of the instruments of one mission, each in order of time.
struct Mission {
  std::vector<CompassReading> compass;
  std::vector<CardReading> card;
  std::vector<FixReading> fixes;
  std::vector<MotorReading> motor;
  /// Quantities that no sample of an instrument was complete for, such as "shaft speed (rpm)". They count only
  /// where not a single sample is complete. Empty: none is missing, or there is no such sample.
  struct Lacks {
    std::string compass, card, motor;
  };
  Lacks lacks;
  /// Commands as they were recorded, each that differs from the one before. Empty: not recorded.
  std::vector<Order> orders;
  /// Times of all commands, repeated ones too.
  std::vector<double> commanded_s;
  /// Times of new commands by which the fins are thought to have moved: recorded, or estimated.
  std::vector<double> order_times_s;
  /// Fins that each of them commanded: what the vehicle was told, not what it did. Empty: not recorded.
  std::vector<Vector3> ordered_fins_rad;
  /// Whether `motor` is not reported but computed from the commands.
  bool motor_is_commanded = false;
  /// Mission sensors that may be outputs to actuators ("output1"): nothing says what they move.
  std::vector<std::string> outputs;
  std::vector<Silence> silences;
  /// The time for which the mission can be judged.
  double judged_from_s = 0, judged_until_s = std::numeric_limits<double>::infinity();
  double duration_s = 0;
  std::uint64_t distorted = 0;  ///< words of the compass with its remark of magnetic distortion (E001)
  std::vector<std::string> remarks;
  EarthField field;
  /// Instrument model from the configuration of the recording.
  devices::InstrumentModel instruments;

  [[nodiscard]] std::vector<double> fix_times_s() const;
  /// Sets order_times_s and ordered_fins_rad to those of `orders`.
  void take_order_times();
  /// Whether a quantity is silent at a time, and whether it is silent at all.
  [[nodiscard]] bool is_silent(Quantity quantity, double time_s) const;
  [[nodiscard]] bool is_silent(Quantity quantity) const;
  /// All reasons why the mission cannot be diagnosed ("no inertial card in the recording: ...; ..."); empty: it
  /// can.
  [[nodiscard]] std::string shortcoming() const;
};

/// Gathers a mission from a pipeline. Where an instrument gives complete samples, incomplete ones are left out;
/// where it is silent otherwise (kSilent_s), the parts of incomplete samples serve.
class MissionGatherer final : public pipeline::Sink {
 public:
  void on_sample(const instruments::Sample& sample) override;
  /// A command to the motor card. Its own time is not used.
  void on_order(const Order& order, std::int64_t time_ns) { orders_.add(order, time_ns); }
  /// Statements of the recording beside its readings.
  struct Said {
    std::optional<Vector3> field_uT{};     ///< the Earth's
    std::int64_t utc_minus_stamps_ns = 0;  ///< by its mapping
  };
  /// The mission, its readings sorted and timed from `begin_ns` on (the scale of the stamps).
  [[nodiscard]] Mission take(std::int64_t begin_ns, const Said& said);

 private:
  void add(const instruments::CompassSample& sample, std::int64_t time_ns);
  void add(const instruments::ImuSample& sample, std::int64_t time_ns);
  void add(const instruments::GpsSample& sample, std::int64_t time_ns);
  void add(const instruments::MotorSample& sample, std::int64_t time_ns);
  void add(const instruments::ScalarSample& sample, std::int64_t time_ns);

  [[nodiscard]] EarthField field(const Said& said) const;

  /// Readings with the times of their samples, in order of arrival.
  template <class Reading>
  struct Gathered {
    std::vector<Reading> readings;
    std::vector<std::int64_t> times_ns;
    void add(const Reading& reading, std::int64_t time_ns) {
      readings.push_back(reading);
      times_ns.push_back(time_ns);
    }
  };
  Mission mission_;
  Gathered<CompassReading> compass_, compass_parts_;
  Gathered<CardReading> card_, card_parts_;
  Gathered<FixReading> fixes_;
  Gathered<MotorReading> motor_, motor_parts_;
  Gathered<Order> orders_;
  std::vector<bool> heading_is_true_;  ///< of compass_parts_
};

/// Settings under which the pipeline makes stamped samples and nothing else.
[[nodiscard]] config::Settings samples_only(config::Settings settings);

/// Reads a log or a capture through the pipeline. `stated`: the configuration to use instead of the recording's
/// own; ports that it lacks are left out, with a remark. `window`: the part to read. `progress` gets 0 to 1.
/// Throws record::BadRecording.
[[nodiscard]] Mission load_mission(const std::filesystem::path& file, const std::function<void(double)>& progress,
                                   const std::optional<config::Settings>& stated = std::nullopt,
                                   const record::TimeWindow& window = {});

}  // namespace navcal::gap
