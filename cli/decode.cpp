// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "analysis/decode_describe.h"
#include "analysis/decode_fields.h"
#include "analysis/decode_stream.h"
#include "analysis/decode_summary.h"
#include "base/printable.h"
#include "base/progress.h"
#include "cli/decode_input.h"
#include "cli/live/commands.h"
#include "config/described/description_file.h"
#include "protocols/described/reading.h"
#include "protocols/described/scanner.h"
#include "protocols/device_types.h"

namespace navcal::cli {
namespace {

/// Decodes streams of a device that a file describes.
class DescribedDecoder {
 public:
  explicit DescribedDecoder(const protocols::described::Description& description);

  /// Runs the frames of a whole stream through `on_frame`. `next` gives the bytes, piece by piece, an empty piece
  /// at the end.
  analysis::DecodeSummary decode(const std::function<protocols::Bytes()>& next,
                                 const std::function<void(const protocols::Frame&)>& on_frame) const;
  /// Writes the numbers of a frame under the names of their fields, in the units of the description; one that is
  /// absent is null. A frame with a value that cannot be is marked.
  void describe(analysis::FieldWriter& fields, const protocols::Frame& frame);

 private:
  struct Kind {
    protocols::FrameId id;
    protocols::described::FrameReader reader;
    std::vector<std::string> names;
    std::vector<double> values;
  };

  std::shared_ptr<const protocols::described::Plan> plan_;
  std::vector<Kind> kinds_;
};

DescribedDecoder::DescribedDecoder(const protocols::described::Description& description)
    : plan_(protocols::described::compile(description)) {
  for (const auto& kind : description.kinds) {
    Kind& added =
        kinds_.emplace_back(Kind{kind.id, protocols::described::FrameReader(kind, description.is_text), {}, {}});
    for (const auto& field : kind.fields) added.names.push_back(field.name);
    added.values.resize(kind.fields.size());
  }
}

analysis::DecodeSummary DescribedDecoder::decode(
    const std::function<protocols::Bytes()>& next,
    const std::function<void(const protocols::Frame&)>& on_frame) const {
  return analysis::decode_stream(next, on_frame, protocols::described::Scanner(plan_));
}

void DescribedDecoder::describe(analysis::FieldWriter& fields, const protocols::Frame& frame) {
  const auto kind = std::ranges::find_if(kinds_, [&](const Kind& known) { return known.id == frame.id; });
  if (kind == kinds_.end()) return;
  const bool is_possible = kind->reader.read(frame.bytes, kind->values);
  kind->reader.read_plain(frame.bytes, kind->values);
  for (std::size_t i = 0; i < kind->values.size(); ++i) {
    if (std::isnan(kind->values[i])) {
      fields.null(kind->names[i]);
    } else {
      fields.number(kind->names[i], kind->values[i]);
    }
  }
  if (!is_possible) analysis::write_out_of_range(fields);
}

using protocols::Date;
using protocols::Protocol;

struct DecodeArguments {
  std::string protocol;
  std::string device;
  std::string port;
  std::string file;
  std::string pivot;
  bool json = false;
};

// Dates are only touched without being asked for when the device is known to send such as have rolled over.
std::optional<Date> pivot_of(const DecodeArguments& arguments, Protocol protocol) {
  if (!arguments.pivot.empty()) return protocols::parse_iso_date(arguments.pivot);
  return protocols::device_type(protocol).dates_roll_over ? std::optional<Date>(protocols::kRolloverPivot)
                                                          : std::nullopt;
}

/// Writes each frame that `decode(next, on_frame)` finds by `describe(frame)`.
template <class Decode, class DescribeFrame>
analysis::DecodeSummary write_frames(Protocol protocol, DecodeSource& input, analysis::FieldWriter& fields,
                                     const Decode& decode, const DescribeFrame& describe) {
  base::Progress progress("decode");
  return decode(
      [&] {
        const protocols::Bytes bytes = input.next();
        input.show(progress);
        return bytes;
      },
      [&](const protocols::Frame& frame) {
        fields.begin_frame(name_of(protocol), frame);
        describe(frame);
        fields.end_frame();
      });
}

analysis::DecodeSummary decode(Protocol protocol, DecodeSource& input, analysis::FieldWriter& fields) {
  const auto frames = [&](const auto& next, const auto& on_frame) {
    return analysis::decode_frames(protocol, next, on_frame);
  };
  const analysis::Describe describe = analysis::description_of(protocol);
  pipeline::UnusedFrames undecoded;
  auto summary = write_frames(protocol, input, fields, frames, [&](const auto& frame) {
    describe(fields, frame);
    if (!fields.has_fields()) undecoded.add(frame.id);
  });
  summary.undecoded = undecoded;
  return summary;
}

analysis::DecodeSummary decode_described(const protocols::described::Description& description, DecodeSource& input,
                                         analysis::FieldWriter& fields) {
  DescribedDecoder decoder(description);
  const auto frames = [&](const auto& next, const auto& on_frame) { return decoder.decode(next, on_frame); };
  return write_frames(Protocol::described, input, fields, frames,
                      [&](const auto& frame) { decoder.describe(fields, frame); });
}

/// The description that applies: the file's, else that of the recording's port; nullopt: the device has a driver.
std::optional<protocols::described::Description> description_for(const DecodeArguments& arguments,
                                                                 const PortBytes* port) {
  if (arguments.device.empty())
    return port != nullptr && arguments.protocol.empty() ? port->settings().described : std::nullopt;
  return config::load_description(arguments.device);
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
  const auto description = description_for(arguments, port.get());
  const Protocol protocol = description                  ? Protocol::described
                            : arguments.protocol.empty() ? port->protocol()
                                                         : *protocols::protocol_named(arguments.protocol);
  if (protocol == Protocol::described && !description)
    throw base::Failure(base::Exit::usage, "a described device is decoded with --device FILE.toml");
  base::Output output(STDOUT_FILENO, "standard output");
  using Format = analysis::FieldWriter::Format;
  analysis::FieldWriter fields(output, arguments.json ? Format::json : Format::text,
                               pivot_of(arguments, protocol));
  const analysis::DecodeSummary summary =
      description ? decode_described(*description, input, fields) : decode(protocol, input, fields);
  if (arguments.json) {
    analysis::write_json(output, summary);
  } else {
    analysis::write_text(output, summary);
  }
  output.flush();
  if (!port) return;
  for (const auto& remark : port->remarks()) std::fprintf(stderr, "navcal: %s\n", base::printable(remark).c_str());
}

}  // namespace

void add_decode(CLI::App& app) {
  auto arguments = std::make_shared<DecodeArguments>();
  CLI::App* const command =
      app.add_subcommand("decode", "Decode the frames of a raw byte stream, and summarise it");
  std::vector<std::string> names, listed;
  names.reserve(protocols::kDeviceCount);
  for (const auto& device : protocols::kDeviceTypes) {
    names.emplace_back(device.name);
    // Described devices have an option of their own.
    if (device.protocol != Protocol::described) listed.emplace_back(device.name);
  }

  add_valued(command, "--protocol", "NAME", arguments->protocol,
             fmt::format("Protocol of the device: {}; with --port the default is the one in the recording",
                         fmt::join(listed, ", ")))
      ->check(CLI::IsMember(names));
  command->add_option("--device", arguments->device)->type_name("FILE.toml")->excludes("--protocol");
  command->add_option("--port", arguments->port)->type_name("NAME");
  command->add_flag("--json", arguments->json);
  command->add_option("--pivot", arguments->pivot)->type_name("YYYY-MM-DD")->check([](const std::string& text) {
    return protocols::parse_iso_date(text) ? std::string{} : text + " is not a date, such as 2019-04-07";
  });
  command->add_option("FILE", arguments->file)->required();
  command->callback([arguments] {
    if (arguments->protocol.empty() && arguments->port.empty() && arguments->device.empty())
      throw CLI::RequiredError("--protocol, --device or --port");
    run(*arguments);
  });
}

}  // namespace navcal::cli
