// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace navcal::report
