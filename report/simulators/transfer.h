// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "config/layout.h"
#include "config/vehicle.h"
#include "devices/instrument_model.h"
#include "gap/verdict/diagnosis.h"
#include "report/simulators/representation.h"

namespace navcal::report {

/// Nominal model that found effects correct, and where they were found.
struct CorrectedModel {
  gap::Diagnosis diagnosis;
  std::string origin;  ///< file of the recording, or of the saved diagnosis
  config::VehicleSettings vehicle;
  devices::InstrumentModel instruments;
};

/// One found effect of which all parameters are determined.
class TransferredEffect {
 public:
  explicit TransferredEffect(const gap::EffectFinding& finding) : finding_(&finding) {}
  [[nodiscard]] const gap::EffectFinding& finding() const { return *finding_; }
  [[nodiscard]] const std::string& name() const { return finding_->name; }
  /// Value of a parameter of the effect, by its name in the library.
  [[nodiscard]] double operator[](std::string_view parameter) const;

 private:
  const gap::EffectFinding* finding_;
};

struct LeftOutEffect {
  std::string effect, reason;
};

/// The found effects of a diagnosis on their way to one simulator. Only effects on which the verdict rests are
/// taken, and only with the verdict "explained": the others are not certain.
class Transfer {
 public:
  /// `diagnosis` must outlive the transfer.
  Transfer(const gap::Diagnosis& diagnosis, Simulator simulator);

  [[nodiscard]] Simulator simulator() const { return simulator_; }
  [[nodiscard]] const std::vector<TransferredEffect>& effects() const { return effects_; }
  /// nullptr when the effect is not among them.
  [[nodiscard]] const TransferredEffect* find(std::string_view name) const;
  /// Takes an effect out of effects(): the simulator cannot have it with these values.
  void leave_out(std::string_view name, std::string reason);
  [[nodiscard]] const std::vector<LeftOutEffect>& left_out() const { return left_out_; }

 private:
  Simulator simulator_;
  std::vector<TransferredEffect> effects_;
  std::vector<LeftOutEffect> left_out_;
};

/// A simulator's file with what it carries, for people.
struct SimulatorFile {
  std::string text;
  std::string summary;  ///< one sentence: "hard_iron and buoyancy; left out: gyro_drift (...)"
};

/// What a file contains and what was left out, in words: the comment at its head. Plain text, one paragraph each,
/// without control characters.
[[nodiscard]] std::vector<std::string> about(const CorrectedModel& model, const Transfer& transfer);
/// Size and certainty of one effect, and how the simulator has it, as about() has them: one paragraph.
[[nodiscard]] std::string about(const TransferredEffect& effect, Simulator simulator);
/// The sentence of SimulatorFile.
[[nodiscard]] std::string summary_of(const gap::Diagnosis& diagnosis, const Transfer& transfer);
/// Why there is no correction; empty if the verdict rests on effects.
[[nodiscard]] std::string why_no_correction(const gap::Diagnosis& diagnosis);

/// Lines of at most `width` bytes, each with `prefix` before it; words that are longer are cut.
[[nodiscard]] std::string comment_lines(std::string_view paragraph, std::string_view prefix, std::size_t width);

/// A scenario of HoloOcean 2.3: the nominal vehicle as a TorpedoAUV with Fossen's dynamics, its sensors with their
/// noise, and the found effects. HoloOcean's torpedo is another model: only numbers that it has too are taken
/// over. The key "navcal", which HoloOcean does not read, says what the file contains and what was left out.
[[nodiscard]] SimulatorFile holoocean_scenario(const CorrectedModel& model);

/// Found effects as elements of a Stonefish scenario (XML), to be taken over into the user's own: only elements
/// and attributes that an effect changes, without geometry, materials and looks. Comments say what the file
/// contains and what was left out.
[[nodiscard]] SimulatorFile stonefish_scenario(const CorrectedModel& model);

/// Found effects as SIM_* parameters of ArduPilot SITL (ArduSub 4.7): a file for `sim_vehicle.py --add-param-file`
/// and for MAVProxy's `param load`. One "NAME value" a line; comments begin with # and, since ArduPilot reads
/// lines of at most 98 characters, are shorter than that.
[[nodiscard]] SimulatorFile sitl_parameters(const CorrectedModel& model);

/// A layout with the found effects, as a layout file. Errors of instruments are left out, which its comment and
/// the summary say. `origin`: as in CorrectedModel.
[[nodiscard]] SimulatorFile corrected_layout(const gap::Diagnosis& diagnosis, std::string_view origin,
                                             config::Layout layout);

/// Roll, pitch and yaw about fixed axes, rad, of R = Rz(yaw) Ry(pitch) Rx(roll): the convention of the
/// rotations in files of HoloOcean and Stonefish.
[[nodiscard]] inline Eigen::Vector3d fixed_axis_angles(const Eigen::Matrix3d& R) {
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0))};
}

/// The found effects in a file for the simulator (docs/simulator-export.md). A verdict other than "explained"
/// gives a file without any correction, which says so.
[[nodiscard]] SimulatorFile simulator_file(Simulator simulator, const CorrectedModel& model);

}  // namespace navcal::report
