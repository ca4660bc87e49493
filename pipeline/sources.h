#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "instruments/samples.h"
#include "pipeline/calibration_options.h"

namespace navcal::pipeline {

/// What a port can give to navigation and calibration.
enum class Role : std::uint8_t { heading, rates, position, shaft };
inline constexpr std::array kRoles{Role::heading, Role::rates, Role::position, Role::shaft};
[[nodiscard]] std::string_view name_of(Role role);

/// The role that a sample fills: a heading or a field, rates, a position, a shaft speed. nullopt where it has
/// none of them: NMEA's ROT and XDR lines are no headings, and a receiver without a fix has no position.
[[nodiscard]] std::optional<Role> role_of(const instruments::Sample& sample);

/// Ports that can fill a role, the best first: an instrument whose protocol always says it before an NMEA port,
/// and then in the order of the configuration.
[[nodiscard]] std::vector<std::uint16_t> candidates(const config::Settings& settings, Role role);

/// Which port serves which role, by what the ports deliver. The best port that delivers serves. Another one takes
/// over when it has been silent for kSilent_ns and for five of its own intervals, and gives way as soon as it is
/// back. Decided from samples and
/// their arrivals alone, so live and replay agree.
///
/// Calibrators learn from one instrument only: what they learn from does not fall over. It is the best port, where
/// its protocol always says what it takes or there is no other. Else it is the best that has delivered within
/// kSilent_ns of the first one.
class Sources {
 public:
  static constexpr std::int64_t kSilent_ns = 3'000'000'000;

  struct Change {
    Role role{};
    std::uint16_t port = 0;               ///< serves now
    std::optional<std::uint16_t> before;  ///< served until now
    bool silent = false;                  ///< because that one fell silent
  };

  explicit Sources(const config::Settings& settings);

  /// A sample, in the order of arrivals.
  [[nodiscard]] std::optional<Change> take(const instruments::Sample& sample);
  /// Nothing is known of what the ports deliver.
  void begin_run();

  /// Those that serve navigation.
  [[nodiscard]] CalibratedPorts serving() const;
  /// Those that the calibrators learn from.
  [[nodiscard]] CalibratedPorts learnt() const;

 private:
  struct Service {
    std::vector<std::uint16_t> candidates;
    std::vector<std::optional<std::int64_t>> newest_ns;  ///< of each candidate
    std::vector<std::int64_t> interval_ns;               ///< of each candidate: between its newest two
    std::optional<std::size_t> server;                   ///< place among the candidates
    std::optional<std::size_t> learnt;
    std::optional<std::int64_t> began_ns;  ///< the first sample of any candidate
    bool is_certain = false;               ///< the best candidate's protocol always says it
  };
  std::array<Service, kRoles.size()> services_;
};

}  // namespace navcal::pipeline
