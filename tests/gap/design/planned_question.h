// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gap/design/planner.h"
#include "gap/design/question.h"
#include "gap/verdict/prepare.h"

namespace navcal::gap::test {

/// What is open after a short recording that tells little: which of these effects is there. A small null bank.
class PlannedQuestion {
 public:
  /// Typical strength of each effect; none is probable before.
  explicit PlannedQuestion(const std::vector<std::string>& effects);

  [[nodiscard]] Question question(MissionPurpose purpose = MissionPurpose::separate) const;
  [[nodiscard]] RehearsalProblem problem() const {
    return {vehicle_,
            library_,
            prepared_->bank.whitening,
            {{}, prepared_->mission.field},
            curved_estimates(question(), library_),
            2};
  }
  [[nodiscard]] const Library& library() const { return library_; }

 private:
  std::vector<std::string> effects_;
  Library library_;
  config::VehicleSettings vehicle_;
  std::unique_ptr<Prepared> prepared_;
};

}  // namespace navcal::gap::test
