// SPDX-License-Identifier: Apache-2.0
#include "identify/conventions/conventions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/angles.h"
#include "identify/conventions/agreement.h"
#include "identify/conventions/suspects.h"
#include "identify/data/actuator_inputs.h"

namespace navcal::identify {
namespace {

constexpr std::size_t kMost = 4;  ///< conventions that are named
constexpr double kLogPrior = -4;  ///< of each cause against "all is right"
constexpr double kSure = 0.9;
constexpr double kSame = 1e-6;
constexpr double kMended = 0.3;     ///< what is left of a residual's square where a convention explains it
constexpr double kLongest_s = 600;  ///< of a recording: more tells no more
constexpr double kTold_nats = 3;    ///< by which a convention's opposite has to be worse
constexpr double kHour_s = 3600, kQuarter_s = 900;

/// Channels, and signals of actuators, that lie whole quarters of an hour beside the others are moved there. A few
/// readings, or those of a short part of the others' time, may have been made at any time.
std::vector<Convention> mend_time_zones(const config::Layout& layout, RecordedMotion& motion) {
  constexpr std::size_t kFewest = 20;
  constexpr double kShortest = 0.5;
  struct Span {
    std::string name;
    std::vector<double*> times;
  };
  std::vector<Span> spans;
  for (std::size_t c = 0; c < kChannels; ++c) {
    Span span{std::string(kChannelDescriptions[c].name), {}};
    for (Reading& reading : motion.channels[c]) span.times.push_back(&reading.time_s);
    if (span.times.size() >= kFewest) spans.push_back(std::move(span));
  }
  const ActuatorInputs inputs(layout, motion);
  for (auto& [name, signal] : motion.signals) {
    if (signal.times_s.size() < kFewest || !inputs.use(name)) continue;
    Span& span = spans.emplace_back(Span{name, {}});
    for (double& time_s : signal.times_s) span.times.push_back(&time_s);
  }
  std::vector<Convention> found;
  const auto most = std::ranges::max_element(
      spans, [](const Span& a, const Span& b) { return a.times.size() < b.times.size(); });
  if (most == spans.end()) return found;
  const double begin_s = *most->times.front(), end_s = *most->times.back();
  for (const Span& span : spans) {
    const double first_s = *span.times.front(), last_s = *span.times.back();
    if ((first_s < end_s && last_s > begin_s) || last_s - first_s < kShortest * (end_s - begin_s)) continue;
    const double apart_s = (first_s + last_s - begin_s - end_s) / 2;
    const double zone_s = std::round(apart_s / kQuarter_s) * kQuarter_s;
    if (zone_s == 0 || std::abs(apart_s - zone_s) > (end_s - begin_s) / 2) continue;
    for (double* time_s : span.times) *time_s -= zone_s;
    found.push_back(
        {"time_zone", span.name, 0.99,
         fmt::format("The times of {} are {:+.2f} h from those of the others.", span.name, zone_s / kHour_s)});
  }
  motion.duration_s = end_s;
  return found;
}

/// Declination by the Earth's field and turn to the track: a heading that is true already.
std::optional<Convention> twice(const RecordedMotion& motion, const Agreement& agreement) {
  constexpr double kDeviation_rad = 0.035;  ///< of a calibrated compass
  constexpr double kFar = 4, kNear = 1.5;
  if (!motion.declination_rad || !agreement.track_turn_rad) return std::nullopt;
  const double declination = *motion.declination_rad, right = motion.heading_is_true ? 0 : declination;
  const double sigma = std::hypot(agreement.track_turn_std_rad, kDeviation_rad);
  const double off = base::wrapped(*agreement.track_turn_rad - right);
  if (std::abs(off) < kFar * sigma || std::abs(off + declination) > kNear * sigma) return std::nullopt;
  return Convention{"declination_twice", "heading", 0.95,
                    fmt::format("The track lies {:+.1f} degrees from the heading, with the declination of {:+.1f} "
                                "degrees taken into account: the heading contains it already.",
                                off * base::kDegreesPerRadian, declination * base::kDegreesPerRadian)};
}

/// All recordings with their commands.
class Bench {
 public:
  Bench(const config::Layout& layout, std::vector<RecordedMotion> motions)
      : layout_(layout), vehicle_(layout), motions_(std::move(motions)) {
    for (const RecordedMotion& motion : motions_) {
      const ActuatorInputs inputs(layout_, motion);
      for (const std::string& missing : inputs.missing()) missing_.push_back(motion.name + ": " + missing);
      actuators_.push_back(inputs.missing().empty() ? std::optional(inputs.trajectory(layout_)) : std::nullopt);
    }
  }
  [[nodiscard]] std::vector<Agreement> agreements(const Suspect& suspect) const {
    std::vector<Agreement> out;
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      RecordedMotion motion = motions_[i];
      suspect.motion(motion);
      out.push_back(agreement_of(vehicle_, motion, actuators_[i] ? &*actuators_[i] : nullptr,
                                 [&](sim::ActuatorValues& values) {
                                   for (const ActuatorChange& change : mended_) change(values);
                                   suspect.actuators(values);
                                 }));
    }
    return out;
  }
  void mend(const Suspect& suspect) {
    for (RecordedMotion& motion : motions_) suspect.motion(motion);
    mended_.push_back(suspect.actuators);
  }
  [[nodiscard]] const std::vector<RecordedMotion>& motions() const { return motions_; }
  [[nodiscard]] const std::vector<std::string>& missing() const { return missing_; }

 private:
  const config::Layout& layout_;
  sim::LayoutVehicle vehicle_;
  std::vector<RecordedMotion> motions_;
  std::vector<std::optional<ActuatorTrajectory>> actuators_;
  std::vector<ActuatorChange> mended_;
  std::vector<std::string> missing_;
};

/// How much better the recordings agree: gain of log likelihood, and the relation that gains most.
struct Gain {
  double nats = 0, most = 0;
  std::size_t relation = 0;
  double before = 0, after = 0;  ///< its rms
  bool is_mended = false;
};
Gain gain_of(const std::vector<Agreement>& before, const std::vector<Agreement>& after) {
  Gain all;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t r = 0; r < kRelations; ++r) {
      const Residual &a = before[i].of[r], &b = after[i].of[r];
      // Windows that a suspect makes impossible do not speak for it.
      if (a.count <= 0 || b.count <= 0 || (b.windows < a.windows && b.mean_square < a.mean_square)) continue;
      const double nats =
          (a.mean_square > b.mean_square ? a.count : b.count) / 2 * std::log(a.mean_square / b.mean_square);
      all.nats += nats;
      if (nats <= all.most) continue;
      all.most = nats;
      all.relation = r;
      all.before = std::sqrt(a.mean_square);
      all.after = std::sqrt(b.mean_square);
      all.is_mended = b.mean_square < kMended * a.mean_square;
    }
  }
  return all;
}

/// Counts suspects that agree worse. Of those that would agree as well the motion does not tell.
void tell(ConventionCheck& all, const std::vector<Suspect>& suspects, const std::vector<Gain>& gains) {
  for (std::size_t i = 0; i < suspects.size(); ++i) {
    const double nats = gains[i].nats - suspects[i].log_prior;
    // A suspect that changes nothing at all concerns a channel that is not measured.
    if (suspects[i].name.empty() || std::abs(nats) <= kSame) continue;
    if (nats > -kTold_nats)
      all.untold.push_back(suspects[i].words);
    else
      ++all.told;
  }
}

std::string not_checked_words(const RecordedMotion& motion, const Agreement& agreement) {
  std::string out;
  for (std::size_t r = 0; r < kRelations; ++r)
    if (agreement.of[r].count <= 0)
      out += fmt::format("{}{}", out.empty() ? "" : ", ", kRelationDescriptions[r].words);
  return out.empty() ? out : motion.name + ": not measured: " + out;
}

}  // namespace

ConventionCheck check_conventions(const config::Layout& layout, std::vector<RecordedMotion> motions,
                                  const std::function<void(double)>& progress) {
  ConventionCheck all;
  for (RecordedMotion& motion : motions) {
    const auto zones = mend_time_zones(layout, motion);
    all.found.insert(all.found.end(), zones.begin(), zones.end());
    motion.duration_s = std::min(motion.duration_s, kLongest_s);
  }
  if (motions.empty()) return all;
  Bench bench(layout, std::move(motions));
  all.not_checked = bench.missing();
  std::vector<Suspect> suspects = suspects_of_instruments(bench.motions().front());
  for (Suspect& suspect : suspects_of_actuators(layout)) suspects.push_back(std::move(suspect));

  auto before = bench.agreements({});
  for (std::size_t i = 0; i < before.size(); ++i)
    if (const auto words = not_checked_words(bench.motions()[i], before[i]); !words.empty())
      all.not_checked.push_back(words);
  for (std::size_t round = 0; round < kMost; ++round) {
    std::vector<Gain> gains;
    std::size_t best = 0;
    for (std::size_t i = 0; i < suspects.size(); ++i) {
      progress((static_cast<double>(round) + static_cast<double>(i) / static_cast<double>(suspects.size())) /
               kMost);
      gains.push_back(gain_of(before, bench.agreements(suspects[i])));
      gains[i].nats += suspects[i].log_prior;
      if (gains[i].nats > gains[best].nats) best = i;
    }
    double sum = std::exp(-kLogPrior - gains[best].nats), of_name = 0, of_part = 0;
    for (std::size_t i = 0; i < gains.size(); ++i) {
      const double weight = std::exp(gains[i].nats - gains[best].nats);
      sum += weight;
      if (suspects[i].name != suspects[best].name) continue;
      of_name += weight;
      // Where a channel is missing, two suspects may be one.
      if (suspects[i].what == suspects[best].what || std::abs(gains[i].nats - gains[best].nats) < kSame)
        of_part += weight;
    }
    const Gain& gain = gains[best];
    if (of_name / sum < kSure || !gain.is_mended || suspects[best].name.empty()) {
      tell(all, suspects, gains);
      break;
    }
    bench.mend(suspects[best]);
    before = bench.agreements({});
    const RelationDescription& relation = kRelationDescriptions[gain.relation];
    all.found.push_back(
        {suspects[best].name, suspects[best].what, of_part / sum,
         fmt::format("With {}, the {} agrees within {:.2g} {} instead of {:.2g} {}.", suspects[best].words,
                     relation.words, gain.after, relation.unit, gain.before, relation.unit)});
  }
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (const auto convention = twice(bench.motions()[i], before[i])) {
      all.found.push_back(*convention);
      break;
    }
  }
  return all;
}

}  // namespace navcal::identify
