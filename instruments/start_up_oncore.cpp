// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "base/durations.h"
#include "instruments/devices.h"
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
 private:
  /// Source of the positions; a later one in this list is preferred to an earlier one.
  enum class Source : std::uint8_t { none, nmea, ea, ha };

  Script script() override {
    const auto poll = [](protocols::FrameId id) { return oncore::encode_poll(id, kEverySecond); };
    for (;;) {
      const std::int64_t began_ns = now_ns();
      const std::string attempt = fruitless_ == 0 ? "" : ", attempt " + std::to_string(fruitless_ + 1);
      source_ = Source::none;
      nmea_seen_ = false;
      for (const Source wanted : {Source::ha, Source::ea}) {
        enter((wanted == Source::ha ? "asked for Ha" : "no answer to Ha: trying Ea") + attempt);
        co_await send(poll(wanted == Source::ha ? oncore::kHa : oncore::kEa), 0);
        co_await send(poll(oncore::kBb), 0);
        // While Ha may still come, an Ea is a leftover of an earlier request.
        if (co_await ask(poll(oncore::kBo), 1, kAnswer_ns, positions_from(wanted))) break;
      }
      if (source_ == Source::none && nmea_seen_) source_ = Source::nmea;
      if (source_ == Source::none) {
        ++fruitless_;
        enter("no answer to Ha or Ea, and no NMEA: trying again every 10 s, " + std::to_string(fruitless_) +
              " so far");
        if (!co_await wait(began_ns + kCycle_ns - now_ns(), positions_from(Source::nmea))) continue;
      }
      fruitless_ = 0;
      do {
        enter(source_ == Source::nmea ? "running on NMEA: no answer to Ha or Ea"
              : source_ == Source::ha ? "running on Ha"
                                      : "running on Ea",
              true);
      } while (co_await wait(kOncoreStopped_ns, positions_from(source_)));
    }
  }
  void on_any_frame(const protocols::Frame& frame) override { nmea_seen_ = nmea_seen_ || is_nmea(frame.id); }

  Answers positions_from(Source least) {
    return [this, least](const protocols::Frame& frame) {
      const Source source = frame.id == oncore::kHa   ? Source::ha
                            : frame.id == oncore::kEa ? Source::ea
                            : is_nmea(frame.id)       ? Source::nmea
                                                      : Source::none;
      if (source < least) return false;
      source_ = source;
      return true;
    };
  }

  Source source_ = Source::none;
  bool nmea_seen_ = false;  ///< since Ha was asked for
};

}  // namespace

std::unique_ptr<StartUp> start_oncore(const config::PortSettings&) { return std::make_unique<StartUpOncore>(); }

}  // namespace navcal::instruments
