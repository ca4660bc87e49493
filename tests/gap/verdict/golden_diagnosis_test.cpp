// SPDX-License-Identifier: Apache-2.0
// Answers of whole diagnoses as they were when this was written (fixtures/gap): a change of the search, of the
// judgement or of the words shows here, whether it was meant or not. Whether answers are right is for other tests.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "gap/verdict/request.h"
#include "tests/gap/simulated_mission.h"
#include "tests/support/golden.h"
#include "tests/support/temporary_folder.h"

namespace navcal::gap {
namespace {

/// A diagnosis line by line.
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
    if (found.commands)
      lines_.add("commands {:.3f} s {:.3f} {} {:.3f}", found.commands->delay_s.value_or(-9),
                 found.commands->correlation.value_or(-9), found.commands->by_reports, found.commands->saturated);
    for (const Interruption& each : found.instruments.interrupted)
      lines_.add("interrupted {} {:.1f} to {:.1f} s", each.what, each.from_s, each.until_s);
    for (const Course& course : found.courses)
      lines_.add("course {} {} {:.4g} {:.4g}", course.channel, course.time_s.size(), sum_of(course.before),
                 sum_of(course.after));
    if (found.scatter)
      lines_.add("scatter {} {} {:.4g} {:.4g}", found.scatter->channel, found.scatter->driver,
                 sum_of(found.scatter->before), sum_of(found.scatter->after));
    if (found.tracks)
      lines_.add("tracks {:.4g} {:.4g} {:.4g}", sum_of(found.tracks->fixes.north_m),
                 sum_of(found.tracks->nominal.east_m), sum_of(found.tracks->improved.north_m));
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
  /// The sum of absolute values. A value that is not a number counts nothing.
  static double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += std::isfinite(value) ? std::abs(value) : 0;
    return sum;
  }
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

TEST_F(GoldenDiagnosis, RecordingsThatDiffer) {
  Request request;
  request.missions = {slosh("a", 11), recorded("nominal", "", 100, 3)};
  expect_golden(of(request), "recordings_that_differ");
}

// Between a controller and the card the orders go through slew rates: the backlash of servos has nulls of its own.
TEST_F(GoldenDiagnosis, ShapedOrders) {
  Request request;
  request.missions = {*folder_ / "shaped.cap"};
  test::write_shaped_mission(request.missions.front(), "identification", "[fin_backlash]\nwidth_deg = 2\n", 100,
                             5);
  expect_golden(of(request), "shaped_orders");
}

TEST_F(GoldenDiagnosis, AReceiverThatIsSilentForAWhile) {
  const auto whole = recorded("current", "[water_current]\nnorth_m_s = 0.1\neast_m_s = -0.1\n", 120, 6);
  constexpr double kBegin_s = 1'767'225'600;  // of simulated captures
  Request request;
  request.missions = {*folder_ / "silent.cap"};
  std::ifstream in(whole);
  std::ofstream out(request.missions.front());
  for (std::string line; std::getline(in, line);) {
    const bool is_gps = line.find(" gps ") != std::string::npos;
    const double time_s = is_gps ? std::atof(line.c_str()) - kBegin_s : 0;
    if (!is_gps || time_s < 40 || time_s > 85) out << line << '\n';
  }
  out.close();
  expect_golden(of(request), "silent_receiver");
}

TEST_F(GoldenDiagnosis, TooBriefToSay) {
  Request request;
  request.missions = {recorded("brief", "[thrust_scale]\nscale = -0.1\n", 20, 4)};
  expect_golden(of(request), "brief");
}

}  // namespace
}  // namespace navcal::gap
