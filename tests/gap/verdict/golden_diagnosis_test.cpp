// SPDX-License-Identifier: Apache-2.0
// Answers of whole diagnoses as they were when this was written (fixtures/gap): a change of the search, of the
// judgement or of the words shows here, whether it was meant or not. Whether answers are right is for other tests.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <memory>

#include "gap/verdict/request.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/golden.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

/// What a diagnosis says, line by line.
class Digest {
 public:
  explicit Digest(const Diagnosis& found) {
    lines_.add("verdict {} {}", name_of(found.verdict),
               found.verdict == Verdict::unknown ? name_of(found.kind) : "");
    lines_.add("sentence {}", found.sentence);
    for (const WhereEntry& where : found.where)
      lines_.add("where {} {} {:.4g} {:.4g} {} p {:.3g}", where.channel, where.regime, where.gap, where.floor,
                 where.unit, where.p_value);
    lines_.add("map {} cells", found.map.size());
    for (const SourceFinding& source : found.sources) add("source", source);
    if (found.proposal) {
      add("proposal", found.proposal->source);
      lines_.add("proposal gains {:.4g} {}", found.proposal->held_out_gain_nats, found.proposal->held_out);
      add("proposal", found.proposal->power);
    }
    for (const EffectFinding& effect : found.effects) add("effect", effect);
    for (const EffectFinding& effect : found.candidates) add("candidate", effect);
    for (const Alternative& alternative : found.alternatives) {
      lines_.add("alternative {:.3f} closed {:.3f}", alternative.probability, alternative.closed.value_or(-9));
      for (const EffectFinding& effect : alternative.effects) add("  ", effect);
    }
    lines_.add("held out {}", found.gap.held_out);
    add("pooled", found.gap.pooled);
    for (const ChannelClosure& each : found.gap.channels) add(each.channel, each.closure);
    if (found.gap.heading_error_rad)
      lines_.add("heading error {:.4g} {:.4g}", (*found.gap.heading_error_rad)[0],
                 (*found.gap.heading_error_rad)[1]);
    for (const std::string& each : found.unexplained) lines_.add("unexplained {}", each);
    for (const std::string& each : found.next) lines_.add("next {}", each);
    for (const std::string& each : found.remarks) lines_.add("remark {}", each);
    for (const std::string& each : found.instruments.missing) lines_.add("missing {}", each);
    for (const std::string& each : found.instruments.not_judged) lines_.add("not judged {}", each);
    for (const ChangePoint& change : found.changes)
      lines_.add("change {} {:.1f} {:.4g} {:.4g}", change.channel, change.time_s, change.before, change.after);
    for (const RecordingFinding& each : found.recordings) {
      lines_.add("recording");
      for (const EffectFinding& effect : each.effects) add("  ", effect);
      if (each.alone)
        lines_.add("  alone {:.3f} {}", each.alone->probability, fmt::join(each.alone->effects, ", "));
    }
    for (const EffectDifference& each : found.differences)
      lines_.add("difference {} p {:.3g} {}", each.name, each.p_value, each.differs);
    lines_.add("least ratio {:.3g}", found.least_ratio.value_or(-9));
    lines_.add("nulls {} of {:.1f} s", found.bank.missions, found.duration_s);
  }
  [[nodiscard]] const navcal::test::GoldenLines& lines() const { return lines_; }

 private:
  void add(std::string_view what, const EffectFinding& effect) {
    lines_.add("{} {} p {:.3f} shown by {}", what, effect.words(), effect.probability, effect.manoeuvre);
    for (const EffectParameterEstimate& each : effect.parameters)
      lines_.add("{}   {} {:.4g} +- {:.3g}", what, each.name, each.value, each.std_error);
    for (const Confusion& each : effect.confused_with)
      lines_.add("{}   not {} {:.3g} {}", what, each.name, each.separation_nats, each.tie_breaker);
  }
  void add(std::string_view what, const SourceFinding& source) {
    lines_.add("{} {} ({}) {:.4g} {}", what, source.name, source.words, source.gain_nats, source.closes_nothing);
    for (const ErrorFinding& error : source.errors)
      lines_.add("{}   {} {} {} {} {:.3g} +- {:.3g} {} {:.3g}", what, error.component, error.channel, error.regime,
                 error.follows, error.rms, error.std_error, error.unit, error.strength);
  }
  void add(std::string_view what, const Closure& closure) {
    lines_.add("{} {:.4g} {:.4g} {:.4g} closed {:.3f}", what, closure.before, closure.after, closure.floor,
               closure.closed.value_or(-9));
    if (closure.closed_ci)
      lines_.add("{} from {:.2f} to {:.2f}", what, (*closure.closed_ci)[0], (*closure.closed_ci)[1]);
  }

  navcal::test::GoldenLines lines_;
};

class GoldenDiagnosis : public testing::Test {
 protected:
  static void SetUpTestSuite() { folder_ = std::make_unique<navcal::test::TemporaryFolder>(); }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path recorded(const std::string& name, std::string_view effects, double seconds,
                                        std::uint64_t seed) {
    const auto file = *folder_ / (name + ".cap");
    if (!std::filesystem::exists(file)) test::write_mission(file, "identification", effects, seconds, seed);
    return file;
  }
  static std::filesystem::path slosh(const std::string& name, std::uint64_t seed) {
    return recorded("slosh" + name, "[tilt_slosh]\ngain = 0.4\n", 100, seed);
  }
  static Diagnosis of(Request request) {
    request.cache = *folder_ / "banks";
    request.bank_missions = 12;
    return diagnose(request, [](std::string_view, double) {});
  }
  static void expect_golden(const Diagnosis& found, const std::string& name) {
    Digest(found).lines().expect_same_as("gap/" + name);
  }

  static std::unique_ptr<navcal::test::TemporaryFolder> folder_;
};
std::unique_ptr<navcal::test::TemporaryFolder> GoldenDiagnosis::folder_;

TEST_F(GoldenDiagnosis, TwoEffectsHeldOut) {
  constexpr std::string_view kEffects = "[thrust_scale]\nscale = -0.1\n[motor_field]\nx_uT_per_A = 0.8\n";
  Request request;
  request.missions = {recorded("two", kEffects, 100, 1)};
  request.holdouts = {recorded("two held out", kEffects, 100, 2)};
  expect_golden(of(request), "two_effects");
}

TEST_F(GoldenDiagnosis, SeveralRecordingsOfOneEffect) {
  Request request;
  request.missions = {slosh("a", 11), slosh("b", 12)};
  expect_golden(of(request), "several_recordings");
}

TEST_F(GoldenDiagnosis, ACauseThatTheLibraryLacks) {
  Request request;
  request.missions = {slosh("a", 11)};
  request.holdouts = {slosh("b", 12)};
  request.excluded = {"tilt_slosh"};
  expect_golden(of(request), "cause_removed");
}

TEST_F(GoldenDiagnosis, ANominalMissionWithoutItsField) {
  Request request;
  request.missions = {recorded("nominal", "", 100, 3)};
  request.without = {Quantity::field};
  expect_golden(of(request), "nominal");
}

TEST_F(GoldenDiagnosis, TooBriefToSay) {
  Request request;
  request.missions = {recorded("brief", "[thrust_scale]\nscale = -0.1\n", 20, 4)};
  expect_golden(of(request), "brief");
}

}  // namespace
}  // namespace navcal::gap
