// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocols/pd0.h"
#include "sim/instruments/doppler_log.h"

namespace navcal::sim {

/// Teledyne log that sends PD0, with its own compass, inclinometer and pressure gauge.
class Pd0Doppler final : public DopplerLog {
 public:
  struct Options : DopplerLog::Options {
    protocols::pd0::Axes axes = protocols::pd0::Axes::instrument;
    bool uses_tilts = true;  ///< velocities in the ship's axes are made level
    bool convex = true;
  };
  Pd0Doppler(const Options& options, const Motion& motion) : DopplerLog(options, motion), sent_as_(options) {}

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const override;

 private:
  [[nodiscard]] std::array<std::optional<double>, 4> velocities_m_s(const DopplerPing& ping) const;

  Options sent_as_;
};

/// Teledyne log that sends PD6, with its own compass and inclinometer.
class Pd6Doppler final : public DopplerLog {
 public:
  using DopplerLog::DopplerLog;

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const override;
};

/// Water Linked log with lines wrz, and wru for each beam.
class WaterLinkedDoppler final : public DopplerLog {
 public:
  using DopplerLog::DopplerLog;

 protected:
  [[nodiscard]] std::vector<std::uint8_t> encode(const DopplerPing& ping, std::int64_t sent_ns) const override;
};

}  // namespace navcal::sim
