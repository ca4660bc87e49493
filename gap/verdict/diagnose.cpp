#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "gap/verdict/answer.h"
#include "gap/nulls/bank_cache.h"
#include "gap/inference/biases.h"
#include "gap/inference/blocks.h"
#include "gap/verdict/holdout.h"
#include "gap/data/instruments_alone.h"
#include "gap/nulls/null_gains.h"
#include "gap/inference/order_times.h"
#include "base/parallel.h"
#include "gap/nulls/play_twins.h"
#include "gap/verdict/request.h"
#include "gap/inference/search.h"
#include "gap/data/shared_content.h"
#include "gap/verdict/verdict.h"
#include "gap/verdict/where.h"

namespace navcal::gap {
namespace {

/// A mission ready to be compared with its nulls.
struct Prepared {
  Mission mission;
  std::unique_ptr<Replay> replay;
  Eigen::VectorXd at;
  Course10Hz course;
  NullBank bank;
  bool from_cache = false;
};

/// What is left with all that was found in the model, as far as that can be nothing.
Innovations rest_of(const Replay& replay, const Library& library, const Explanation& best) {
  Innovations rest = replay.run(library.model(best.mean));
  // Rolling comes from the small sum of three fins' angles, and its gyro feels each turning point of a servo
  // between two reports. Twins, steered by what was reported, have none there.
  if (has_play(library, best.effects)) rest.grid.col(gyro_roll).setZero();
  return rest;
}

/// Simulated vehicles with the play or without the gap that was found: enough for a floor, few enough to wait for.
constexpr int kTwins = 16;
/// No mission of a vehicle without a gap makes so much evidence of its own noise.
constexpr double kBeyondChance_nats = 300;

/// Of orders that were recorded, with twice the noise that a report should have.
constexpr double kMostMisfit = 4;

/// What a search found, and what it was compared with.
struct Searched {
  SearchResult found;
  Priors priors;
  std::optional<PlayTwins> twins;  ///< of a vehicle with play
  CauseSet hidden;                 ///< what the mission hardly shows, and what was allowed for therefore
  CauseSet by_chance;              ///< what was found, but vehicles without a gap show as well
};

class Diagnosing {
 public:
  Diagnosing(const Request& request, const Progress& progress)
      : request_(request),
        progress_(progress),
        library_(request.excluded),
        cache_(request.cache, request.vehicle, library_),
        threads_(request.threads > 0 ? request.threads : std::max(1U, std::thread::hardware_concurrency())) {}

  [[nodiscard]] Diagnosis run();

 private:
  /// nullptr: nothing can be said from it, and a remark says why.
  [[nodiscard]] std::unique_ptr<Prepared> prepare(const std::filesystem::path& file, Diagnosis& answer);
  /// A mission is held out only when it shares no readings with those before it.
  void expect_other_content(const std::string& name, const Mission& mission);
  void find_bank(Prepared& prepared, const std::string& name, Diagnosis& answer);
  [[nodiscard]] SearchResult search_by(const Priors& priors, const Prepared& a, const Linearised& nominal) const;
  /// A play is judged by vehicles that have it.
  [[nodiscard]] Searched searched_with_twins(const Prepared& a, const Linearised& nominal) const;
  [[nodiscard]] Searched searched(const Prepared& a) const;
  /// Whether some channel follows something as nulls hardly do.
  [[nodiscard]] bool is_seen(const Prepared& a) const;
  /// Whether simulated vehicles without a gap would show the effects found as well, noise as it comes.
  [[nodiscard]] bool is_chance(const Prepared& a, const Linearised& nominal, const Searched& searched) const;
  /// What is clear of vehicles without a gap although all that was found is in the model; `seen`: something was
  /// clear of them before.
  [[nodiscard]] std::vector<WhereEntry> leftover_of(const Prepared& a, const Searched& result,
                                                    const Comparison& here, bool seen) const;
  void diagnose(const Prepared& a, const std::vector<std::unique_ptr<Prepared>>& holdouts, Diagnosis& answer);
  void say_without_causes(const std::string& why, Diagnosis& answer);

  const Request& request_;
  const Progress& progress_;
  Library library_;
  BankCache cache_;
  unsigned threads_;
  std::vector<std::pair<std::string, SharedContent>> contents_;  ///< of the missions read, by file name
};

void Diagnosing::expect_other_content(const std::string& name, const Mission& mission) {
  SharedContent content(mission);
  for (const auto& [other, before] : contents_) {
    const double shared_s = content.shared_s(before);
    if (!(shared_s > 0)) continue;
    throw std::invalid_argument(fmt::format(
        "--holdout {}: {:.0f} s of it are in {} as well. An answer can only be checked on a recording of "
        "another mission.",
        name, std::max(shared_s, 1.0), other));
  }
  contents_.emplace_back(name, std::move(content));
}

std::unique_ptr<Prepared> Diagnosing::prepare(const std::filesystem::path& file, Diagnosis& answer) {
  auto prepared = std::make_unique<Prepared>();
  const std::string name = file.filename().string();
  prepared->mission = load_mission(file, [&](double done) { progress_("reading " + name, done); });
  expect_other_content(name, prepared->mission);
  if (request_.field_uT) prepared->mission.field.set_given(*request_.field_uT);
  if (!answer.field) answer.field = prepared->mission.field;
  for (const auto& remark : prepared->mission.remarks) answer.remarks.push_back(remark);
  const std::string doubt = doubt_of(prepared->mission.field);
  if (!doubt.empty()) answer.remarks.push_back(name + ": " + doubt);
  const std::string shortcoming = prepared->mission.shortcoming();
  if (!shortcoming.empty()) {
    answer.remarks.push_back(name + ": " + shortcoming);
    return nullptr;
  }
  if (prepared->mission.fixes.size() < 3) {
    answer.remarks.push_back(name +
                             ": hardly a GPS fix, so nothing can be said of declination, current, GPS and speed");
  }
  auto& orders_s = prepared->mission.order_times_s;
  if (!orders_s.empty()) {
    prepared->replay = std::make_unique<Replay>(prepared->mission, request_.vehicle);
    if (prepared->replay->actuators().orders().misfit() > kMostMisfit) {
      answer.remarks.push_back(name + ": the fins moved by other orders than those recorded");
      orders_s.clear();
    }
  }
  if (orders_s.empty()) {
    orders_s = likely_order_times_s(prepared->mission, request_.vehicle, library_, threads_);
    prepared->replay = std::make_unique<Replay>(prepared->mission, request_.vehicle);
  }
  if (prepared->replay->intervals() < 200) {
    answer.remarks.push_back(name + ": compass, inertial card and motor card have less than 20 s in common");
    return nullptr;
  }
  prepared->at = with_biases_found(*prepared->replay, library_, threads_);
  (void)prepared->replay->run(library_.model(prepared->at), &prepared->course);
  find_bank(*prepared, name, answer);
  if (prepared->bank.missions < 10) {
    answer.remarks.push_back(name +
                             ": no simulated vehicle could follow this mission, so nothing can be compared");
    return nullptr;
  }
  return prepared;
}

void Diagnosing::find_bank(Prepared& prepared, const std::string& name, Diagnosis& answer) {
  const BankOptions options{request_.bank_missions, request_.bank_seed, threads_};
  if (auto bank = cache_.find(*prepared.replay, prepared.course, options)) {
    prepared.bank = std::move(*bank);
    prepared.from_cache = true;
    return;
  }
  prepared.bank = make_null_bank(*prepared.replay, prepared.course, request_.vehicle, library_, prepared.at,
                                 options, [&](double done) { progress_("null bank of " + name, done); });
  const std::string refusal = cache_.keep(*prepared.replay, prepared.course, prepared.bank);
  if (!refusal.empty())
    answer.remarks.push_back("the simulated null missions could not be kept for next time: " + refusal);
}

SearchResult Diagnosing::search_by(const Priors& priors, const Prepared& a, const Linearised& nominal) const {
  return search(*a.replay, library_, a.bank.whitening, nominal, priors, threads_,
                [&](double done) { progress_("searching", done); });
}

Searched Diagnosing::searched_with_twins(const Prepared& a, const Linearised& nominal) const {
  const Priors priors = learnt_priors(library_, a.bank.gram, a.bank.scores);
  Searched result{search_by(priors, a, nominal), priors, {}, {}, {}};
  if (!has_play(library_, result.found.best.effects)) return result;
  progress_("vehicles with such a play", 0);
  PlayTwins twins = play_twins(*a.replay, a.course, request_.vehicle, library_, a.bank.whitening,
                               result.found.best, {kTwins, request_.bank_seed, threads_});
  if (twins.missions <= kTwins / 2) return result;
  // Once more: beside a play, others are recruited for what it leaves.
  const Priors wider = with_twins(priors, library_, result.found.best, twins);
  if (SearchResult again = search_by(wider, a, nominal); has_play(library_, again.best.effects)) {
    result.found = std::move(again);
    result.priors = wider;
  }
  result.twins = std::move(twins);
  return result;
}

std::vector<WhereEntry> Diagnosing::leftover_of(const Prepared& a, const Searched& result, const Comparison& here,
                                                bool seen) const {
  Innovations rest = rest_of(*a.replay, library_, result.found.best);
  const auto map_of = [&] { return followed(rest, here.course, here.fix_times_s); };
  if (result.twins) return clear_of_nulls(where_map(map_of(), result.twins->followed));
  auto leftover = clear_of_nulls(where_map(map_of(), a.bank.followed));
  // Nothing found and nothing seen is no gap: how well its tolerances were found makes none.
  if (result.found.best.effects.empty() && !seen) return leftover;
  // Rolling is no evidence, so that no search fits its gyro; where the vehicle was when the replay began is as
  // good as its first fixes, decimetres. Vehicles that are known have another rest in both.
  rest.grid.col(gyro_roll).setZero();
  rest.fixes.leftCols<2>().setZero();
  for (WhereEntry& entry : beyond_known(map_of(), a.bank.left, a.bank.followed)) {
    const bool is_there = std::any_of(leftover.begin(), leftover.end(), [&](const WhereEntry& other) {
      return other.channel == entry.channel && other.regime == entry.regime;
    });
    if (!is_there) leftover.push_back(std::move(entry));
  }
  return leftover;
}

Searched Diagnosing::searched(const Prepared& a) const {
  progress_("linearising", 0);
  const Linearised nominal = linearise(*a.replay, library_, a.bank.whitening, a.at, threads_);
  Searched result = searched_with_twins(a, nominal);
  if (is_chance(a, nominal, result)) {
    result.by_chance = result.found.best.effects;
    result.found = nothing_found(*a.replay, library_, a.bank.whitening, nominal, result.priors, threads_);
    result.twins.reset();
    return result;
  }
  // What this mission could not show may be there unnoticed, and takes what is not its own: it cannot be named,
  // but is allowed for, and the others are asked again. Twins of another play are not made.
  const CauseSet hidden = hidden_effects(result.found);
  if (hidden.empty()) return result;
  Searched again{{}, with_freed(result.priors, library_, hidden), result.twins, hidden, {}};
  again.found = search_by(again.priors, a, nominal);
  const bool can_be_told = !again.found.best.effects.empty() && hidden_effects(again.found).empty() &&
                           has_play(library_, again.found.best.effects) == result.twins.has_value();
  return can_be_told && !is_chance(a, nominal, again) ? again : result;
}

bool Diagnosing::is_seen(const Prepared& a) const {
  const Innovations nominal = a.replay->run(library_.model(a.at));
  const auto map = where_map(followed(nominal, a.course, a.mission.fix_times_s()), a.bank.followed);
  return !clear_of_nulls(map).empty();
}

bool Diagnosing::is_chance(const Prepared& a, const Linearised& nominal, const Searched& searched) const {
  const Explanation& best = searched.found.best;
  if (best.effects.empty() || best.log_odds > kBeyondChance_nats || is_seen(a)) return false;
  progress_("vehicles without a gap", 0);
  // As nulls are looked at: signatures taken anew at an estimate far off gain some nats that nothing is behind.
  const bool curved = std::any_of(best.effects.begin(), best.effects.end(),
                                  [&](std::size_t effect) { return library_.is_curved(effect); });
  const double gain = curved ? best.log_odds : gain_over_none(best.effects, nominal, library_, searched.priors);
  return !stands_out(
      gain, gains_among_nulls(best.effects, *a.replay, a.course, request_.vehicle, library_, a.bank.whitening,
                              nominal, searched.priors, {kTwins, request_.bank_seed, threads_}));
}

void Diagnosing::diagnose(const Prepared& a, const std::vector<std::unique_ptr<Prepared>>& holdouts,
                          Diagnosis& answer) {
  Searched result = searched(a);
  SearchResult& found = result.found;

  // Members alone go into the missions held out; all that was found, small as it is, is taken out of what is left.
  Eigen::VectorXd members = Eigen::VectorXd::Zero(found.best.mean.size());
  for (const Eigen::Index j : members_of(library_, found.best.effects)) members[j] = found.best.mean[j];
  progress_("missions held out", 0);
  Comparison here;
  std::vector<Comparison> compared(holdouts.size());
  std::vector<Foretold> foretellings(found.best.effects.empty() ? 0 : holdouts.size());
  in_parallel(threads_, holdouts.size() + 1, [&](std::size_t i) {
    if (i == holdouts.size()) {
      here = compare(*a.replay, library_, a.bank, a.at, members);
      return;
    }
    const Prepared& other = *holdouts[i];
    compared[i] = compare(*other.replay, library_, other.bank, other.at, members);
    // Vehicles are the same in all missions, tolerances too: what is compared is how well this mission foretells
    // the other with and without the effects, all that it says of the tolerances included.
    if (!foretellings.empty()) {
      foretellings[i] =
          foretold(*other.replay, library_, other.bank.whitening, found.mean_without_effects, found.best.mean);
    }
  });
  const Eigen::MatrixXd was = followed(here.nominal, a.course, here.fix_times_s);
  answer.map = where_map(was, a.bank.followed);
  answer.where = clear_of_nulls(answer.map);
  const auto leftover = leftover_of(a, result, here, !answer.where.empty());

  const bool blocks = compared.empty();
  std::vector<double> nats;
  PooledClosure closure_by_all;
  if (blocks) {
    nats = gains_of_blocks(found.best, library_, result.priors, layout_of(*a.replay));
    compared.push_back(here);
  } else if (!foretellings.empty()) {
    std::vector<Power> by_all;
    for (Foretold& each : foretellings) {
      nats.push_back(each.gain_nats);
      by_all.push_back(std::move(each.power));
    }
    closure_by_all = pooled_closure(compared, by_all);
  }
  const PooledClosure closure = pooled_closure(compared);
  const Judgement judgement =
      judge({found, library_, answer.where, leftover, nats, closure, closure_by_all, blocks});

  for (const std::size_t effect : result.by_chance) {
    answer.remarks.push_back(fmt::format(
        "{} was the best candidate, but simulated vehicles without a gap show as much on such a course",
        library_[effect].name));
  }
  for (const std::size_t effect : result.hidden) {
    answer.remarks.push_back(
        fmt::format("{} hardly shows in this mission: it was allowed for, not asked for", library_[effect].name));
  }
  answer.verdict = judgement.verdict;
  if (answer.where.empty() && answer.verdict != Verdict::no_gap && !found.best.effects.empty() &&
      !answer.map.empty()) {
    const Eigen::MatrixXd with_members = followed(here.improved, here.course, here.fix_times_s);
    answer.where.push_back(most_changed(answer.map, was, with_members, a.bank.followed));
  }
  answer.unexplained = judgement.reasons;
  answer.duration_s = a.mission.duration_s;
  for (Eigen::Index i = 0; i < Library::kBiases; ++i) {
    answer.gyro_bias_rad_s[static_cast<std::size_t>(i)] = found.best.mean[i];
  }
  answer.bank = {a.bank.missions, a.bank.seed, a.from_cache, a.bank.seconds};
  if (result.twins) correct(found.best, library_, *result.twins);
  write_findings(found, library_, result.priors, answer);
  write_gap(compared, closure, !blocks, answer);
  answer.changes = change_points(here.nominal, a.course, here.fix_times_s, a.bank.followed);
  answer.tracks = Tracks{track_of_fixes(a.mission), reckoned_track(a.course, a.mission),
                         found.best.effects.empty() ? Track{} : reckoned_track(here.course, a.mission)};
  answer.courses = courses(here.nominal, here.improved, here.course, here.fix_times_s);
  if (!answer.where.empty()) {
    answer.scatter = scatter(answer.where.front(), here.nominal, here.improved, here.course, here.fix_times_s);
  }
  write_words(answer);
}

/// No model can be held against the recording; its instruments may still be held against each other.
void Diagnosing::say_without_causes(const std::string& why, Diagnosis& answer) {
  answer.sentence = fmt::format("The causes of a gap cannot be found: {}.", why);
  calib::Report report =
      instruments_alone(request_.mission, answer.field.value_or(EarthField{}),
                        [&](double done) { progress_("comparing the instruments with each other", done); });
  if (!report.calibrators.empty()) answer.instruments_alone = std::move(report);
}

Diagnosis Diagnosing::run() {
  Diagnosis answer;
  const auto a = prepare(request_.mission, answer);
  const std::string why_not =
      answer.remarks.empty() ? std::string("the recording is empty") : answer.remarks.back();
  std::vector<std::unique_ptr<Prepared>> holdouts;
  for (const auto& file : request_.holdouts) {
    auto prepared = prepare(file, answer);
    if (prepared) holdouts.push_back(std::move(prepared));
  }
  const auto began = std::chrono::steady_clock::now();
  if (a) {
    diagnose(*a, holdouts, answer);
  } else {
    say_without_causes(why_not, answer);
  }
  if (a && request_.holdouts.empty()) {
    answer.remarks.emplace_back(
        "no mission was held out: blocks of this one had to do, which is weaker (--holdout OTHER.cap)");
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return answer;
}

}  // namespace

Diagnosis diagnose(const Request& request, const Progress& progress) {
  return Diagnosing(request, progress).run();
}

}  // namespace navcal::gap
