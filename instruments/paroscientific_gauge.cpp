// SPDX-License-Identifier: Apache-2.0
#include "instruments/paroscientific_gauge.h"

#include "protocols/decimal.h"
#include "protocols/paroscientific.h"

namespace navcal::instruments {
namespace {

namespace paroscientific = protocols::paroscientific;

constexpr int kPsi = 1;

}  // namespace

ParoscientificGauge::ParoscientificGauge(const config::PortSettings& settings) {
  if (!settings.start_up) unit_Pa_ = paroscientific::unit_Pa(kPsi);
}

Instrument::Verdict ParoscientificGauge::read(const protocols::Frame& frame, Receiver& receiver) {
  if (paroscientific::address_of(frame.bytes).to != paroscientific::kHost) return Verdict::ignored;
  if (frame.id == paroscientific::kUnits) {
    const auto code = protocols::integer<int>(paroscientific::parameter_of(frame.bytes));
    if (!code) return Verdict::out_of_range;
    unit_Pa_ = paroscientific::unit_Pa(*code);
    return Verdict::used;
  }
  if (frame.id != paroscientific::kValue || !unit_Pa_) return Verdict::ignored;
  const auto value = paroscientific::decode_value(frame.bytes);
  if (!value) return Verdict::ignored;
  DepthSample sample;
  sample.pressure_Pa = *value * *unit_Pa_;
  hand_over(sample, receiver);
  return Verdict::used;
}

}  // namespace navcal::instruments
