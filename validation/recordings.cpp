// SPDX-License-Identifier: Apache-2.0
#include "validation/recordings.h"

#include <fmt/format.h>

#include <future>
#include <string>

#include "analysis/failure.h"
#include "base/interruptible.h"
#include "config/load.h"
#include "record/capture/capture_writer.h"
#include "record/whole_file.h"
#include "validation/missions.h"
#include "validation/reference/sink.h"

namespace navcal::validation {
namespace {

std::vector<config::PortSettings> trial_ports() {
  std::vector<config::PortSettings> ports;
  ports.reserve(reference::kFinnedPorts.size());
  for (const reference::Port port : reference::kFinnedPorts) {
    const reference::PortFacts& facts = reference::facts_of(port);
    ports.push_back(config::default_port(std::string(facts.name),
                                         protocols::protocol_named(facts.protocol).value(), facts.baud));
  }
  return ports;
}

class Recording final : public reference::Sink {
 public:
  explicit Recording(const std::filesystem::path& file) : file_(file), writer_(trial_ports()) {
    writer_.begin(text_);
  }
  void transfer(const reference::Transfer& transfer) override {
    constexpr std::size_t kEnough = std::size_t{1} << 20;
    const auto direction = transfer.sent ? record::Direction::sent : record::Direction::received;
    writer_.bytes(text_, static_cast<std::uint16_t>(transfer.port), direction, transfer.time_ns, transfer.bytes);
    if (text_.size() > kEnough) flush();
  }
  void truth(const reference::Snapshot& /*snapshot*/) override {
    if (base::Interruptible::interrupted()) throw analysis::Failure(analysis::Exit::failed, "interrupted");
  }
  void finish() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.write(text_);
    text_.clear();
  }
  record::WholeFile file_;
  record::CaptureWriter writer_;
  std::string text_;
};

}  // namespace

void write_recording(const reference::Mission& mission, const reference::VehicleUnderTest& vehicle,
                     std::uint64_t seed, const std::filesystem::path& file) {
  Recording recording(file);
  if (const auto lost = reference::run(mission, vehicle, seed, recording)) {
    throw analysis::Failure(
        analysis::Exit::failed,
        fmt::format("no recording: the vehicle was lost {:.1f} s into the mission", lost->time_s));
  }
  recording.finish();
}

std::array<std::filesystem::path, 3> write_recordings(const TrialCase& drawn,
                                                      const std::filesystem::path& folder) {
  const auto missions = trial_missions(facts_of(drawn.arm).missions, drawn.minutes);
  std::array<std::filesystem::path, 3> files{folder / "a.cap", folder / "b.cap", folder / "c.cap"};
  std::array<std::future<void>, 3> written;
  for (std::size_t i = 0; i < files.size(); ++i) {
    written[i] = std::async(std::launch::async, [&, i] {
      write_recording(at_place(missions[i], drawn.place), drawn.vehicle, drawn.mission_seeds[i], files[i]);
    });
  }
  for (auto& one : written) one.get();
  return files;
}

}  // namespace navcal::validation
