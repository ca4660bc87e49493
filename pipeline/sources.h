// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "config/settings.h"
#include "instruments/samples.h"
#include "pipeline/calibration_options.h"
#include "pipeline/role_ports.h"

namespace navcal::pipeline {

using protocols::RoleSet;

/// The roles that a sample fills. NMEA's ROT and XDR lines are no headings, and a receiver without a fix has
/// neither position nor velocity.
[[nodiscard]] RoleSet roles_of(const instruments::Sample& sample);

/// Ports that can fill a role, the best first: the one that [roles] names, then those whose protocol always says
/// it, then NMEA ports; each kind in the order of the configuration.
[[nodiscard]] std::vector<std::uint16_t> candidates(const config::Settings& settings, Role role);

/// Whether the first candidate is waited for: [roles] names it, or its protocol always says it.
[[nodiscard]] bool is_certain(const config::Settings& settings, Role role);

/// Ports that the calibrators may learn a role from: the first candidate where it is certain, else all.
[[nodiscard]] std::vector<std::uint16_t> learnable(const config::Settings& settings, Role role);
/// The role of the compass that is calibrated, before anything has come: the field where any port can give it,
/// else the heading.
[[nodiscard]] Role compass_role(const config::Settings& settings);

/// Which port serves which role, by what the ports deliver. The best port that delivers serves. Of receivers the
/// better is the one that states the smaller error: another one takes over when its dilution of precision,
/// averaged over some ten fixes, is less than 0.7 of that of the one that serves. Any other is better by its place
/// among the candidates. A port takes over, too, from one that has been silent for kSilent_ns and for five of its
/// own intervals, and gives way as soon as that one is back. Decided from samples and their arrivals alone, so
/// live and replay agree.
///
/// Calibrators learn from one instrument only: what they learn from does not fall over. It is the best port, where
/// its protocol always says what it takes or there is no other. Else it is the best that has delivered within
/// kSilent_ns of the first one. A field that may come and has not, kSilent_ns after the first heading, is not
/// waited for.
class Sources {
 public:
  static constexpr std::int64_t kSilent_ns = 3'000'000'000;

  struct Change {
    enum class Cause : std::uint8_t {
      delivers,  ///< it is the best that delivers
      silence,   ///< of the one before
      error,     ///< that it states is smaller
    };
    Role role{};
    std::uint16_t port = 0;               ///< serves now
    std::optional<std::uint16_t> before;  ///< served until now
    Cause cause = Cause::delivers;
  };

  explicit Sources(const config::Settings& settings);

  /// A sample, in the order of arrivals.
  [[nodiscard]] std::vector<Change> take(const instruments::Sample& sample);
  /// Nothing is known of what the ports deliver. The calibrators go on with the instruments they had.
  void begin_run();

  /// Ports that serve navigation.
  [[nodiscard]] RolePorts serving() const;
  /// Ports among them that have delivered.
  [[nodiscard]] RolePorts delivering() const;
  /// Ports from which the calibrators learn. The compass is the one that delivers the field, if there is one.
  [[nodiscard]] CalibratedPorts learnt() const;
  /// The calibrators have learnt from these before; a port that is no candidate is passed over.
  void go_on_with(const CalibratedPorts& learnt);

 private:
  struct Candidate {
    std::uint16_t port = 0;
    std::optional<std::int64_t> newest_ns{};
    std::int64_t interval_ns = 0;  ///< between its newest two
    double error = 0;              ///< that it states, averaged
    std::uint32_t error_statements = 0;
  };
  struct Service {
    std::vector<Candidate> candidates;
    std::optional<std::size_t> server;  ///< place among the candidates
    std::optional<std::size_t> learnt;
    std::optional<std::int64_t> began_ns;  ///< the first sample of any candidate
    bool is_certain = false;
    bool is_chosen = false;  ///< by [roles]
  };
  [[nodiscard]] const Service& service(Role role) const { return services_.at(static_cast<std::size_t>(role)); }
  void choose_compass(std::int64_t now_ns);
  static std::optional<Change> take(Service& service, Role role, const instruments::Sample& sample);
  static bool is_better(const Service& service, std::size_t place);

  std::array<Service, kRoles.size()> services_;
  std::optional<Role> compass_role_;  ///< field or heading, once it is known which is learnt from
};

}  // namespace navcal::pipeline
