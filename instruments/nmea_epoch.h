// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "config/settings.h"
#include "instruments/samples.h"
#include "protocols/nmea.h"
#include "protocols/nmea_position.h"

namespace navcal::instruments {

/// Joins the sentences (RMC, GGA, GNS, GLL, VTG, GSA) over which receivers spread one position. An epoch begins
/// with another time, or with a sentence that the open one has already: some receivers state whole seconds at any
/// rate, and a time that repeats is left out of the sample. The sample is complete with the type of sentence that
/// closed the epoch before, so it does not wait for the next one.
class NmeaEpoch {
 public:
  explicit NmeaEpoch(const config::GpsSettings& settings);

  struct Outcome {
    bool in_range = true;
    bool begins = false;              ///< the sentence is the first one of its epoch
    std::optional<GpsSample> closed;  ///< an epoch whose closing sentence never came
    std::optional<GpsSample> sample;  ///< the epoch of this sentence
    bool in_leap_second = false;      ///< `sample` is
  };
  Outcome add(const protocols::nmea::Sentence& sentence, protocols::nmea::Type type);

 private:
  using Type = protocols::nmea::Type;

  void begin(const protocols::TimeOfDay& time, std::string_view address, Outcome& outcome);
  bool merge(const protocols::nmea::Sentence& sentence, Type type, Outcome& outcome);
  void finish(Type type, Outcome& outcome);
  void set_date(const protocols::Date& date);
  void set_place(const std::optional<protocols::nmea::LatLon>& place);
  void set_motion(const std::optional<protocols::nmea::Decimal>& speed_kn,
                  const std::optional<protocols::nmea::Decimal>& course_deg);
  [[nodiscard]] GpsSample complete() const;

  double course_gate_m_s_;
  protocols::Date pivot_;
  std::optional<protocols::Date> date_;
  bool date_corrected_ = false;
  bool past_midnight_ = false;                ///< since the date was stated
  std::optional<protocols::TimeOfDay> time_;  ///< of the epoch that is open
  bool time_repeats_ = false;                 ///< that of the epoch before, sent without decimals
  std::vector<protocols::FrameId> seen_;      ///< sentences of the open epoch that state the time
  GpsSample open_;
  bool emitted_ = false;
  Type newest_ = Type::other;                ///< latest sentence of the open epoch
  std::optional<Type> closer_;               ///< sentence that closed the epoch before
  std::optional<protocols::nmea::Gsa> gsa_;  ///< the best of the newest epoch that had one
  bool gsa_of_epoch_ = false;                ///< of the open one
};

}  // namespace navcal::instruments
