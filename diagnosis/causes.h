// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "config/layout.h"
#include "identify/data/recorded_motion.h"
#include "identify/parameters.h"
#include "identify/replay/calibration.h"

namespace navcal::diagnosis {

/// One number of a cause. Its unknown is a column of the fit of one recording (identify::FilteredReplay):
/// numbers of the layout, then parameters of effects, then the recording's nuisances.
struct CauseParameter {
  std::string name;          ///< with its unit, as files and answers say it: "scale", "angle_deg"
  double typical = 1;        ///< value of strength 1, in the unit of the name
  double per_unit = 1;       ///< unknown of the fit over value in the unit of the name (degrees: radians)
  double low = 0, high = 0;  ///< in the unit of the name
  Eigen::Index column = 0;

  /// An actuator that is dead, a lag, or a dead band beside none. It is no tolerance: that would have both signs,
  /// and zero is not within a linear stretch.
  [[nodiscard]] bool is_one_sided() const { return low == 0; }
  /// An actuator that is dead or reversed, or is not.
  [[nodiscard]] bool is_switch() const { return is_one_sided() && high == typical; }
};

/// What may be the cause of a gap: an effect of the layout's library on one part of it, or an error of an
/// instrument.
struct Cause {
  std::string name = {};       ///< "thrust_scale"
  std::string of = {};         ///< "thruster.2"; empty: the vehicle or its instruments
  std::string manoeuvre = {};  ///< that shows it
  std::vector<CauseParameter> parameters = {};
  bool is_instrument = false;

  /// Of "thruster.2", and not of "sway" or of the vehicle.
  [[nodiscard]] bool is_of_actuator() const { return of.find('.') != std::string::npos; }
  /// "thrust_scale of thruster.2"
  [[nodiscard]] std::string words() const { return of.empty() ? name : name + " of " + of; }
  [[nodiscard]] std::vector<Eigen::Index> columns() const;
};

/// The causes that a layout and the instruments of a recording can have.
struct CauseLibrary {
  std::vector<Cause> causes;
  /// Numbers of the layout that are uncertain by its file (they stand for its tolerances), then the parameters of
  /// all effects on the layout and on the instruments, with a prior about zero.
  std::vector<identify::Parameter> parameters;
  std::size_t layout_numbers = 0;            ///< the first so many of `parameters`
  std::vector<identify::Nuisance> replaced;  ///< by a cause that says the same in other terms
  std::vector<std::string> not_judged;       ///< why an instrument's errors are no candidates here, for people

  [[nodiscard]] Eigen::Index columns() const;
};

/// `excluded`: names of effects that are left out. Throws std::invalid_argument for a name that no cause has.
[[nodiscard]] CauseLibrary causes_of(const config::Layout& layout, const identify::RecordedMotion& recording,
                                     std::span<const std::string> excluded);

}  // namespace navcal::diagnosis
