// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnosis/steady_recording.h"

namespace navcal::diagnosis {

/// Effects of a layout that mean forces can tell: those of actuators and of the hull at rest that move the balance
/// of this recording. Of an actuator the gain is one: the offset, the dead band and the gain of a steady command
/// are not told apart. `library`: all causes of the layout; the first recording that can be judged counts. Throws
/// as SteadyRecording does.
[[nodiscard]] CauseLibrary steady_causes_of(const config::Layout& layout,
                                            std::span<const identify::RecordedMotion* const> recordings,
                                            CauseLibrary library);

/// Recordings by their steady stretches. Layout and library must outlive it and its models.
class SteadySource final : public ModelSource {
 public:
  SteadySource(const config::Layout& layout, const CauseLibrary& library) : layout_(layout), library_(library) {}

  [[nodiscard]] std::unique_ptr<RecordingModel> nominal(const identify::RecordedMotion& recording) override;
  void refine(std::size_t round, std::span<const Eigen::VectorXd> at) override;
  /// The scatter is in the balances: with what all of them share.
  [[nodiscard]] std::vector<RecordingPower> nominal_powers(std::span<const Eigen::VectorXd> at) const override;
  [[nodiscard]] std::unique_ptr<RecordingModel> compared(const identify::RecordedMotion& recording,
                                                         const Eigen::VectorXd& nominal) const override;
  [[nodiscard]] std::unique_ptr<RecordingModel> joined(std::span<RecordingModel* const> compared) const override {
    return std::make_unique<SteadyRecording>(compared, balances_);
  }
  [[nodiscard]] Leads leads() const override;

 private:
  const config::Layout& layout_;
  const CauseLibrary& library_;
  std::vector<SteadyRecording*> nominals_;  ///< those that nominal() made
  NominalBalances balances_;
};

}  // namespace navcal::diagnosis
