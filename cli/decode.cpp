// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "analysis/decode_describe.h"
#include "analysis/decode_stream.h"
#include "analysis/progress.h"
#include "cli/commands.h"
#include "cli/decode_input.h"
#include "cli/decode_port.h"
#include "protocols/imu_card.h"
#include "protocols/motor_card.h"
#include "protocols/nmea.h"
#include "protocols/oncore.h"
#include "protocols/tcm2.h"

namespace navcal::cli {
namespace {

using protocols::Date;
using protocols::Protocol;

struct DecodeArguments {
  std::string protocol;
  std::string port;
  std::string file;
  std::string pivot;
  bool json = false;
};

constexpr std::array kProtocols{Protocol::tcm2, Protocol::imu_card, Protocol::oncore, Protocol::motor_card,
                                Protocol::nmea};

// Oncore receivers are of an age that has seen the week counter roll over; a stream of NMEA may come from
// anything, so its dates are only touched when asked for.
std::optional<Date> pivot_of(const DecodeArguments& arguments, Protocol protocol) {
  if (!arguments.pivot.empty()) return protocols::parse_iso_date(arguments.pivot);
  return protocol == Protocol::oncore ? std::optional<Date>(protocols::kRolloverPivot) : std::nullopt;
}

template <protocols::Scanner S>
analysis::DecodeSummary decode_with(analysis::Describe describe, Protocol protocol,
                                    const std::optional<Date>& pivot, DecodeSource& input,
                                    analysis::FieldWriter& fields) {
  const std::string_view name = name_of(protocol);
  analysis::Progress progress("decode");
  return analysis::decode_stream<S>(
      [&] {
        const protocols::Bytes bytes = input.next();
        input.show(progress);
        return bytes;
      },
      [&](const protocols::Frame& frame) {
        fields.begin_frame(name, frame);
        describe(fields, frame, pivot);
        fields.end_frame();
      });
}

analysis::DecodeSummary decode(Protocol protocol, const std::optional<Date>& pivot, DecodeSource& input,
                               analysis::FieldWriter& fields) {
  switch (protocol) {
    case Protocol::tcm2:
      return decode_with<protocols::tcm2::Scanner>(analysis::describe_tcm2, protocol, pivot, input, fields);
    case Protocol::imu_card:
      return decode_with<protocols::imu_card::Scanner>(analysis::describe_imu_card, protocol, pivot, input,
                                                       fields);
    case Protocol::oncore:
      return decode_with<protocols::oncore::Scanner>(analysis::describe_oncore, protocol, pivot, input, fields);
    case Protocol::motor_card:
      return decode_with<protocols::motor_card::Scanner>(analysis::describe_motor_card, protocol, pivot, input,
                                                         fields);
    case Protocol::nmea:
      return decode_with<protocols::nmea::Scanner>(analysis::describe_nmea, protocol, pivot, input, fields);
  }
  throw analysis::Failure(analysis::Exit::usage, "unknown protocol");
}

void run(const DecodeArguments& arguments) {
  // A reader that goes away (head, less) is told as a failure of the write and not by a signal.
  std::signal(SIGPIPE, SIG_IGN);
  std::unique_ptr<PortBytes> port;
  std::unique_ptr<DecodeSource> file;
  if (!arguments.port.empty()) {
    port = std::make_unique<PortBytes>(arguments.file, arguments.port);
  } else {
    file = std::make_unique<Input>(arguments.file);
  }
  DecodeSource& input = port ? static_cast<DecodeSource&>(*port) : *file;
  const Protocol protocol =
      arguments.protocol.empty() ? port->protocol() : *protocols::protocol_named(arguments.protocol);
  analysis::Output output(STDOUT_FILENO, "standard output");
  analysis::FieldWriter fields(
      output, arguments.json ? analysis::FieldWriter::Format::json : analysis::FieldWriter::Format::text);
  const analysis::DecodeSummary summary = decode(protocol, pivot_of(arguments, protocol), input, fields);
  if (arguments.json) {
    analysis::write_json(output, summary);
  } else {
    analysis::write_text(output, summary);
  }
  output.flush();
  if (!port) return;
  for (const auto& remark : port->remarks()) std::fprintf(stderr, "navcal: %s\n", remark.c_str());
}

}  // namespace

void add_decode(CLI::App& app) {
  auto arguments = std::make_shared<DecodeArguments>();
  CLI::App* const command =
      app.add_subcommand("decode", "Decode the frames of a raw byte stream, and summarise it");
  std::vector<std::string> names;
  names.reserve(kProtocols.size());
  for (const Protocol protocol : kProtocols) names.emplace_back(name_of(protocol));

  command
      ->add_option("--protocol", arguments->protocol,
                   "Protocol of the device; with --port the default is the one in the recording")
      ->check(CLI::IsMember(names));
  command
      ->add_option("--port", arguments->port, "FILE is a capture or log; decode the bytes that this port received")
      ->type_name("NAME");
  command->add_flag("--json", arguments->json, "One JSON object a line, the last one the summary");
  command
      ->add_option("--pivot", arguments->pivot,
                   "Dates before this one are advanced by whole epochs of 1024 weeks (GPS week rollover); default "
                   "for oncore 2019-04-07, for nmea the dates as sent")
      ->type_name("YYYY-MM-DD")
      ->check([](const std::string& text) {
        return protocols::parse_iso_date(text) ? std::string{} : text + " is not a date, such as 2019-04-07";
      });
  command
      ->add_option("FILE", arguments->file,
                   "Bytes as the device sent them (- is standard input), or with --port a capture or log")
      ->required();
  command->footer(
      "Examples:\n"
      "  navcal decode --protocol oncore gps.bin\n"
      "  navcal decode --port compass --json dive.cap\n"
      "  navcal decode --protocol nmea --json - < /dev/ttyUSB0 | jq .heading_deg");
  command->callback([arguments] {
    if (arguments->protocol.empty() && arguments->port.empty()) throw CLI::RequiredError("--protocol or --port");
    run(*arguments);
  });
}

}  // namespace navcal::cli
