// SPDX-License-Identifier: Apache-2.0
#include "instruments/devices.h"
#include "protocols/decimal.h"
#include "protocols/paroscientific.h"

namespace navcal::instruments {
namespace {

namespace paroscientific = protocols::paroscientific;

constexpr int kPsi = 1;

/// Paroscientific Digiquartz gauge for absolute pressure (ICD section 14). A number does not name its unit: it
/// counts from the answer on that states it (UN), which the start-up dialogue asks for. Without the dialogue the
/// unit is the one of delivery, psi.
class ParoscientificGauge final : public Instrument {
 public:
  explicit ParoscientificGauge(const config::PortSettings& settings) {
    if (!settings.start_up) unit_Pa_ = paroscientific::unit_Pa(kPsi);
  }

  Verdict read(const protocols::Frame& frame, Receiver& receiver) override {
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

 private:
  std::optional<double> unit_Pa_;
};

}  // namespace

std::unique_ptr<Instrument> make_paroscientific(const config::PortSettings& settings) {
  return std::make_unique<ParoscientificGauge>(settings);
}

}  // namespace navcal::instruments
