// SPDX-License-Identifier: Apache-2.0
#include "instruments/nmea_epoch.h"

#include <algorithm>

#include "base/angles.h"
#include "base/durations.h"
#include "instruments/units.h"

namespace navcal::instruments {

namespace nmea = protocols::nmea;

NmeaEpoch::NmeaEpoch(const config::GpsSettings& settings)
    : course_gate_m_s_(settings.course_gate_m_s),
      pivot_(protocols::parse_iso_date(settings.rollover_pivot).value_or(protocols::kRolloverPivot)) {}

NmeaEpoch::Outcome NmeaEpoch::add(const nmea::Sentence& sentence, Type type) {
  Outcome outcome;
  outcome.in_range = merge(sentence, type, outcome);
  if (outcome.in_range) finish(type, outcome);
  return outcome;
}

bool NmeaEpoch::merge(const nmea::Sentence& sentence, Type type, Outcome& outcome) {
  switch (type) {
    case Type::rmc: {
      const auto rmc = nmea::decode_rmc(sentence);
      if (!rmc) return false;
      if (rmc->time) begin(*rmc->time, sentence.address(), outcome);
      if (rmc->date) set_date(*rmc->date);
      if (open_.fix == Fix::none) open_.fix = rmc->fix();
      set_place(rmc->valid ? rmc->place : std::nullopt);
      if (rmc->valid) set_motion(rmc->speed_kn, rmc->course_deg);
      return true;
    }
    case Type::gga:
    case Type::gns: {
      const auto gga = type == Type::gns ? nmea::decode_gns(sentence) : nmea::decode_gga(sentence);
      if (!gga) return false;
      if (gga->time) begin(*gga->time, sentence.address(), outcome);
      if (gga->fix() != Fix::none) {
        open_.fix = gga->fix();
        set_place(gga->place);
        if (gga->altitude_m) open_.height_msl_m = gga->altitude_m->value();
        if (gga->altitude_m && gga->geoid_separation_m) {
          open_.height_m = gga->altitude_m->value() + gga->geoid_separation_m->value();
        }
      }
      if (gga->satellites && (gga->place || !open_.tracked)) open_.tracked = gga->satellites;
      if (gga->hdop) open_.dop = gga->hdop->value();
      return true;
    }
    case Type::gll: {
      const auto gll = nmea::decode_gll(sentence);
      if (!gll) return false;
      if (gll->time) begin(*gll->time, sentence.address(), outcome);
      if (open_.fix == Fix::none) open_.fix = gll->fix();
      set_place(gll->valid ? gll->place : std::nullopt);
      return true;
    }
    case Type::vtg: {
      const auto vtg = nmea::decode_vtg(sentence);
      if (!vtg) return false;
      if (!open_.speed_m_s) set_motion(vtg->speed_kn, vtg->course_true_deg);
      return true;
    }
    case Type::zda: {
      const auto zda = nmea::decode_zda(sentence);
      if (!zda) return false;
      if (zda->date) set_date(*zda->date);
      return true;
    }
    case Type::gsa: {
      const auto gsa = nmea::decode_gsa(sentence);
      if (!gsa) return false;
      if (!gsa_of_epoch_ || gsa->fix > gsa_->fix) gsa_ = gsa;
      gsa_of_epoch_ = true;
      return true;
    }
    default: return true;
  }
}

void NmeaEpoch::begin(const protocols::TimeOfDay& time, std::string_view address, Outcome& outcome) {
  const protocols::FrameId name(address);
  const bool repeats = time_ == time;
  if (repeats && std::find(seen_.begin(), seen_.end(), name) == seen_.end()) {
    seen_.push_back(name);
    return;
  }
  if (time_) {
    closer_ = newest_;
    if (!emitted_ && open_.latitude_rad) outcome.closed = complete();
    if (time.hour + 12 < time_->hour) past_midnight_ = true;
  }
  outcome.begins = true;
  time_ = time;
  time_repeats_ = repeats;
  open_ = {};
  emitted_ = false;
  newest_ = Type::other;
  seen_.assign(1, name);
  gsa_of_epoch_ = false;
}

void NmeaEpoch::finish(Type type, Outcome& outcome) {
  if (type == Type::gsa || type == Type::zda || !time_) return;
  newest_ = type;
  // Before the first whole epoch, the first sentence with a position makes the sample.
  const bool closes = closer_ ? type == *closer_ : open_.latitude_rad.has_value() || type == Type::rmc;
  if (!closes || emitted_) return;
  emitted_ = true;
  outcome.sample = complete();
  outcome.in_leap_second = time_->second == 60;
}

void NmeaEpoch::set_date(const protocols::Date& date) {
  date_.reset();
  if (protocols::is_start_of_count(date)) return;
  const auto corrected = protocols::correct_rollover(date, pivot_);
  date_ = corrected.date;
  past_midnight_ = false;
  date_corrected_ = corrected.corrected;
}

void NmeaEpoch::set_place(const std::optional<nmea::LatLon>& place) {
  if (!place) return;
  open_.latitude_rad = place->latitude_deg * base::kRadiansPerDegree;
  open_.longitude_rad = place->longitude_deg * base::kRadiansPerDegree;
}

void NmeaEpoch::set_motion(const std::optional<protocols::nmea::Decimal>& speed_kn,
                           const std::optional<protocols::nmea::Decimal>& course_deg) {
  if (!speed_kn) return;
  open_.speed_m_s = speed_kn->value() * protocols::kMetresPerSecondPerKnot;
  if (course_deg && *open_.speed_m_s >= course_gate_m_s_)
    open_.course_rad = course_deg->value() * base::kRadiansPerDegree;
}

GpsSample NmeaEpoch::complete() const {
  GpsSample sample = open_;
  if (date_ && time_ && !time_repeats_) {
    sample.time_utc_ns = protocols::unix_ns(*date_, *time_) + (past_midnight_ ? 86'400 * base::kSecond_ns : 0);
    sample.time_corrected = date_corrected_;
  }
  // GGA, GNS and RMC state the fix of the whole receiver, GSA of one system; GSA alone tells 2D from 3D.
  const bool has_place = sample.fix == Fix::fix_2d || sample.fix == Fix::fix_3d;
  if (gsa_ && gsa_->fix != Fix::none && has_place) {
    sample.fix = gsa_->fix;
    const auto& dop = gsa_->fix == Fix::fix_3d ? gsa_->pdop : gsa_->hdop;
    if (dop) sample.dop = dop->value();
  }
  return sample;
}

}  // namespace navcal::instruments
