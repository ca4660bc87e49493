// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "base/durations.h"
#include "instruments/start_ups.h"
#include "protocols/oncore.h"
#include "protocols/oncore_command.h"

namespace navcal::instruments {
namespace {

namespace oncore = protocols::oncore;

/// The receiver reads its input once a second and answers within the second after the next; half a second is
/// for the wire.
constexpr std::int64_t kAnswer_ns = 3 * base::kSecond_ns + base::kSecond_ns / 2;
constexpr std::int64_t kOncoreStopped_ns = 3 * base::kSecond_ns;
constexpr std::int64_t kCycle_ns = 10 * base::kSecond_ns;
constexpr std::uint8_t kEverySecond = 1;

/// NMEA sentences have talker and type, at least five letters; the receiver's own messages have two.
bool is_nmea(protocols::FrameId id) { return id.view().size() >= 5; }

/// Motorola Oncore (ICD section 2): asks for position (Ha, then Ea), satellites (Bb) and the UTC offset (Bo) at
/// 1 Hz. Accepts NMEA when the receiver sends nothing else. Begins again when the positions stop.
class StartUpOncore final : public StartUp {
 public:
  void begin(std::int64_t now_ns) override;
  void on_frame(const protocols::Frame& frame, std::int64_t now_ns) override;
  std::optional<std::vector<std::uint8_t>> next(std::int64_t now_ns) override;
  [[nodiscard]] std::int64_t deadline_ns() const override;
  [[nodiscard]] bool in_service() const override { return phase_ == Phase::running; }
  [[nodiscard]] std::string state() const override;

 private:
  enum class Phase : std::uint8_t {
    idle,      ///< begin() has not been called
    asked_ha,  ///< 12-channel position asked for
    asked_ea,  ///< 8-channel position asked for
    resting,   ///< nothing came; all is repeated at due_ns_
    running,   ///< positions of the kind `source_` come
  };
  /// Source of the positions; a later one in this list is preferred to an earlier one.
  enum class Source : std::uint8_t { none, nmea, ea, ha };

  void ask_for(Phase phase, std::int64_t now_ns);
  void act(std::int64_t now_ns);
  void run_on(Source source, std::int64_t now_ns);

  Phase phase_ = Phase::idle;
  Source source_ = Source::none;
  std::int64_t asked_ns_ = 0;
  std::int64_t cycle_began_ns_ = 0;
  bool nmea_seen_ = false;                  ///< since Ha was asked for
  unsigned fruitless_ = 0;                  ///< cycles in a row without any position
  std::vector<protocols::FrameId> to_ask_;  ///< still to be sent, last first
};

}  // namespace

void StartUpOncore::begin(std::int64_t now_ns) {
  fruitless_ = 0;
  ask_for(Phase::asked_ha, now_ns);
}

void StartUpOncore::ask_for(Phase phase, std::int64_t now_ns) {
  phase_ = phase;
  source_ = Source::none;
  asked_ns_ = now_ns;
  due_ns_ = now_ns + kAnswer_ns;
  to_ask_ = {oncore::kBo, oncore::kBb, phase == Phase::asked_ha ? oncore::kHa : oncore::kEa};
  if (phase == Phase::asked_ha) {
    cycle_began_ns_ = now_ns;
    nmea_seen_ = false;
  }
}

void StartUpOncore::on_frame(const protocols::Frame& frame, std::int64_t now_ns) {
  if (phase_ == Phase::idle) return;
  if (frame.id == oncore::kHa) {
    run_on(Source::ha, now_ns);
  } else if (frame.id == oncore::kEa) {
    // While Ha may still come, an Ea is a leftover of an earlier request.
    if (phase_ != Phase::asked_ha) run_on(Source::ea, now_ns);
  } else if (is_nmea(frame.id)) {
    nmea_seen_ = true;
    if (phase_ == Phase::resting || phase_ == Phase::running) run_on(Source::nmea, now_ns);
  }
}

void StartUpOncore::run_on(Source source, std::int64_t now_ns) {
  if (source < source_) return;
  phase_ = Phase::running;
  source_ = source;
  due_ns_ = now_ns + kOncoreStopped_ns;
  fruitless_ = 0;
}

void StartUpOncore::act(std::int64_t now_ns) {
  switch (phase_) {
    case Phase::idle: break;
    case Phase::asked_ha: ask_for(Phase::asked_ea, now_ns); break;
    case Phase::asked_ea:
      if (nmea_seen_) {
        run_on(Source::nmea, now_ns);
      } else {
        ++fruitless_;
        phase_ = Phase::resting;
        due_ns_ = cycle_began_ns_ + kCycle_ns;
      }
      break;
    case Phase::resting:
    case Phase::running: ask_for(Phase::asked_ha, now_ns); break;
  }
}

std::optional<std::vector<std::uint8_t>> StartUpOncore::next(std::int64_t now_ns) {
  if (now_ns >= due_ns_) act(now_ns);
  if (to_ask_.empty()) return std::nullopt;
  const protocols::FrameId id = to_ask_.back();
  to_ask_.pop_back();
  return oncore::encode_poll(id, kEverySecond);
}

std::int64_t StartUpOncore::deadline_ns() const { return to_ask_.empty() ? due_ns_ : asked_ns_; }

std::string StartUpOncore::state() const {
  const std::string attempt = fruitless_ == 0 ? "" : ", attempt " + std::to_string(fruitless_ + 1);
  switch (phase_) {
    case Phase::idle: return "not begun";
    case Phase::asked_ha: return "asked for Ha" + attempt;
    case Phase::asked_ea: return "no answer to Ha: trying Ea" + attempt;
    case Phase::resting:
      return "no answer to Ha or Ea, and no NMEA: trying again every 10 s, " + std::to_string(fruitless_) +
             " so far";
    case Phase::running: break;
  }
  if (source_ == Source::nmea) return "running on NMEA: no answer to Ha or Ea";
  return source_ == Source::ha ? "running on Ha" : "running on Ea";
}

std::unique_ptr<StartUp> start_oncore(const config::PortSettings&) { return std::make_unique<StartUpOncore>(); }

}  // namespace navcal::instruments
