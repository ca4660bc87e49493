// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

#include "analysis/calibrate_run.h"
#include "calib/suite/report.h"
#include "pipeline/earth_field.h"
#include "record/recording.h"

namespace navcal::analysis {

/// Gives the accepted estimates of the whole their standard errors at the next use (Quantity::next_std): the
/// stated variance, and what the accepted estimates of k >= 2 parts scatter beyond their own stated variances,
/// times 1 + 1/k and the square of half of Student's 97.5 % point for k - 1 degrees of freedom. Two of these
/// errors then hold the value of another part in 95 %. Worst heading: the largest such error over the headings of
/// a level hull, by what the parts' hard and soft iron make of one field; its scatter contains that of the
/// readings.
void add_next_use(calib::Report& whole, std::span<const calib::Report> parts, const pipeline::EarthField& field);

/// The same by parts of the recordings of `run`, each calibrated alone: its files, or quarters of a single one
/// that lasts 80 s at least. `progress` gets the share of the parts that was read, in the thread of the caller.
/// Throws as CalibrateRun::play().
void add_next_use(calib::Report& whole, const CalibrateRun& run, const record::TimeWindow& window,
                  const std::function<void(double)>& progress);

}  // namespace navcal::analysis
