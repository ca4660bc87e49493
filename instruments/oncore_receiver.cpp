// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/devices.h"
#include "instruments/units.h"
#include "protocols/oncore.h"
#include "protocols/oncore_command.h"
#include "protocols/oncore_messages.h"
#include "protocols/oncore_position.h"

namespace navcal::instruments {

namespace {

namespace oncore = protocols::oncore;

constexpr std::uint8_t kUsedForPosition = 8;  // channel mode (ICD section 2)

bool has_position(Fix fix) {
  return fix == Fix::fix_2d || fix == Fix::fix_3d || fix == Fix::propagated || fix == Fix::hold;
}

/// Motorola Oncore: positions, satellites in view, leap seconds. A receiver set to NMEA is read as NMEA.
class OncoreReceiver final : public Instrument {
 public:
  explicit OncoreReceiver(const config::PortSettings& settings)
      : settings_(settings.gps),
        pivot_(protocols::parse_iso_date(settings.gps.rollover_pivot).value_or(protocols::kRolloverPivot)),
        nmea_(make_nmea(settings)) {}

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
    if (!frame.bytes.empty() && frame.bytes[0] != '@') return nmea_->read(frame, receiver);
    if (frame.id == oncore::kBb) {
      const auto visible = oncore::decode_bb(frame.bytes);
      if (!visible || !visible->in_range) return Verdict::out_of_range;
      read_visible(*visible, receiver);
      return Verdict::used;
    }
    if (frame.id == oncore::kBo) {
      if (const auto utc = oncore::decode_bo(frame.bytes)) leap_known_ = utc->offset_s.has_value();
      return Verdict::used;
    }
    const auto position = oncore::decode_position(frame.bytes);
    if (!position) return Verdict::ignored;
    return position->in_range ? read_position(*position, receiver) : Verdict::out_of_range;
  }

 private:
  Verdict read_position(const oncore::Position& position, Receiver& receiver) {
    channels_ = position.channels;
    if (position.utc) leap_known_ = position.utc->enabled && position.utc->decoded;
    const auto date = protocols::correct_rollover(position.date, pivot_);

    GpsSample sample;
    sample.time_utc_ns = protocols::unix_ns(date.date, position.time);
    sample.time_corrected = date.corrected;
    sample.leap_known = leap_known_;
    sample.fix = position.fix;
    sample.visible = position.visible;
    sample.tracked = position.tracked;
    if (has_position(position.fix)) {
      sample.latitude_rad = position.filtered.latitude_deg * base::kRadiansPerDegree;
      sample.longitude_rad = position.filtered.longitude_deg * base::kRadiansPerDegree;
      sample.height_m = position.filtered.height_m;
      // Many receivers have no geoid and send exactly 0 (ICD section 2): that is no height.
      if (position.filtered.height_msl_m != 0) sample.height_msl_m = position.filtered.height_msl_m;
    }
    if (position.fix == Fix::fix_2d || position.fix == Fix::fix_3d || position.fix == Fix::propagated) {
      sample.speed_m_s = position.speed_m_s;
      if (position.speed_m_s >= settings_.course_gate_m_s)
        sample.course_rad = position.heading_deg * base::kRadiansPerDegree;
      sample.dop = position.dop;
    }

    receiver.on_measurement(
        {.value = sample,
         .stated_utc_ns = sample.time_utc_ns,
         .utc_is_known = leap_known_ && has_position(position.fix) && !protocols::is_start_of_count(position.date),
         .in_leap_second = position.time.second == 60});
    return Verdict::used;
  }

  void read_visible(const oncore::VisibleSatellites& visible, Receiver& receiver) const {
    SkySample sky;
    for (std::size_t i = 0; i < visible.count; ++i) {
      const auto& seen = visible.satellites[i];
      auto& satellite = sky.satellites[sky.count++];
      satellite.prn = seen.number;
      satellite.elevation_deg = seen.elevation_deg;
      satellite.azimuth_deg = seen.azimuth_deg;
      const auto channel = std::ranges::find_if(
          channels_, [&](const oncore::Channel& c) { return c.satellite != 0 && c.satellite == seen.number; });
      if (channel != channels_.end()) {
        satellite.cn0_dBHz = channel->cn0;
        satellite.used = channel->mode == kUsedForPosition;
      }
    }
    hand_over(sky, receiver, false);
  }

  config::GpsSettings settings_;
  protocols::Date pivot_;
  bool leap_known_ = false;
  std::array<protocols::oncore::Channel, 12>
      channels_{};  ///< of the newest position: strengths for the satellites
  std::unique_ptr<Instrument> nmea_;
};

}  // namespace

std::unique_ptr<Instrument> make_oncore(const config::PortSettings& settings) {
  return std::make_unique<OncoreReceiver>(settings);
}

namespace {

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
