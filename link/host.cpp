// SPDX-License-Identifier: Apache-2.0
#include "link/host.h"

#include <algorithm>

#include "link/fields.h"

namespace navcal::link {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kBetweenByes_ns = kSecond_ns / 10;
/// Times for which a command is sent again while no answer comes.
constexpr std::int64_t kOrderHolds_ns = 3 * kSecond_ns;
constexpr std::int64_t kLeaseHolds_ns = 15 * kSecond_ns;
constexpr double kShortestAgain_s = 0.25;
constexpr double kLongestAgain_s = 0.5;
constexpr double kRoundTripWeight = 0.25;

std::uint32_t milliseconds(std::int64_t now_ns) { return static_cast<std::uint32_t>(now_ns / 1'000'000); }

}  // namespace

Host::Host(EndOptions options) : End(std::move(options)) { hello_ = options_.nonce(); }

void Host::take_frame(std::int64_t now_ns, const FrameView& view) {
  switch (view.header.type) {
    case FrameType::welcome: return take_welcome(now_ns, view);
    case FrameType::refusal:
      if (view.payload.size() != 1 || view.payload[0] > static_cast<std::uint8_t>(Refusal::unknown_session))
        return;
      if (has_begun_to_leave()) {
        // The vehicle has forgotten the session, as it should.
        if (session_ && view.header.session == session_->id) byes_ = 0;
        return;
      }
      refusal_ = static_cast<Refusal>(view.payload[0]);
      // Anybody can send a refusal. A new HELLO costs nothing, and the session goes on until it is answered.
      if (session_ && refusal_ == Refusal::unknown_session && view.header.session == session_->id && !hello_)
        hello_ = options_.nonce();
      return;
    case FrameType::pong:
    case FrameType::report:
    case FrameType::answer:
    case FrameType::segment:
    case FrameType::ack: break;
    default: return;  // an echo of this end's own frames
  }
  if (!session_ || session_->id != view.header.session) return take_stray(view);
  if (session_->check(view) != Refusal::none) {
    ++counters_.refused;
    return;
  }
  if (!session_->arrivals.take(view.header.counter)) {
    ++counters_.repeated;
    return;
  }
  ++counters_.frames;
  heard_ns_ = now_ns;
  take_from_vehicle(now_ns, view);
}

/// Reports outside the own session: shown by an end that cannot check tags.
void Host::take_stray(const FrameView& view) {
  if (view.header.type != FrameType::report || options_.key) {
    ++counters_.refused;
    return;
  }
  const bool is_newer = view.header.session != report_session_ || view.header.counter > report_counter_;
  auto report = decode_report(view.payload);
  if (!is_newer || !report) return;
  ++counters_.frames;
  report_session_ = view.header.session;
  report_counter_ = view.header.counter;
  report_ = NewReport{std::move(*report), false};
}

void Host::take_welcome(std::int64_t now_ns, const FrameView& view) {
  if (!hello_ || view.payload.size() != 2 * sizeof(Nonce) || view.header.session == 0) return;
  Nonce vehicle{}, host{};
  std::copy_n(view.payload.begin(), vehicle.size(), vehicle.begin());
  std::copy_n(view.payload.begin() + static_cast<std::ptrdiff_t>(vehicle.size()), host.size(), host.begin());
  if (host != *hello_) return;
  auto session =
      std::make_unique<Session>(view.header.session, vehicle, host, options_.key, Direction::to_vehicle);
  if (session->check(view) != Refusal::none) {
    ++counters_.refused;
    return;
  }
  ++counters_.frames;
  hello_.reset();
  session_ = std::move(session);
  ++sessions_;
  heard_ns_ = now_ns;
  ping_due_ns_ = now_ns;  // the first frame of the session proves that this end has the key
  pending_.reset();
  answer_.reset();
  report_counter_ = 0;
  report_session_ = session_->id;
  refusal_ = Refusal::none;
}

void Host::take_from_vehicle(std::int64_t now_ns, const FrameView& view) {
  switch (view.header.type) {
    case FrameType::pong: return take_pong(now_ns, view.payload);
    case FrameType::report: {
      auto report = decode_report(view.payload);
      if (!report || view.header.counter <= report_counter_) return;
      report_counter_ = view.header.counter;
      report_ = NewReport{std::move(*report), options_.key.has_value()};
      return;
    }
    case FrameType::answer: {
      const auto answer = decode_answer(view.payload);
      if (!answer || !pending_ || pending_->command.number != answer->number) return;
      pending_.reset();
      answer_ = answer;
      return;
    }
    case FrameType::segment:
    case FrameType::ack: return take_of_stream(now_ns, view, *session_);
    default: return;
  }
}

void Host::take_pong(std::int64_t now_ns, Bytes payload) {
  FieldReader in(payload);
  const double trip_s = static_cast<double>(milliseconds(now_ns) - in.get<std::uint32_t>()) * 1e-3;
  loss_out_ = in.get<std::uint8_t>() / 100.0;
  round_trip_s_ = round_trip_s_ ? *round_trip_s_ + kRoundTripWeight * (trip_s - *round_trip_s_) : trip_s;
}

std::optional<std::uint16_t> Host::command(std::int64_t now_ns, Command command) {
  if (!session_) return std::nullopt;
  const bool is_order = command.kind == Command::Kind::order;
  if (is_order && pending_ && pending_->command.kind != Command::Kind::order && now_ns < pending_->until_ns)
    return std::nullopt;
  command.number = ++last_command_;
  const std::int64_t holds_ns = is_order ? kOrderHolds_ns : kLeaseHolds_ns;
  pending_ = Pending{std::move(command), now_ns, now_ns + holds_ns};
  return last_command_;
}

bool Host::request(std::string_view line) { return session_ && session_->sender.push(line); }

std::optional<std::string> Host::take_response() { return session_ ? session_->receiver.pop() : std::nullopt; }

bool Host::is_alive(std::int64_t now_ns) const {
  return session_ && static_cast<double>(now_ns - heard_ns_) * 1e-9 < options_.dead_s;
}

Host::Quality Host::quality() const {
  Quality quality;
  if (!session_) return quality;
  quality.loss_in = session_->arrivals.loss();
  quality.loss_out = loss_out_;
  quality.round_trip_s = round_trip_s_;
  quality.stream_bytes = session_->receiver.bytes();
  return quality;
}

std::int64_t Host::again_ns() const {
  const double again_s =
      std::clamp(1.25 * round_trip_s_.value_or(kLongestAgain_s), kShortestAgain_s, kLongestAgain_s);
  return static_cast<std::int64_t>(again_s * 1e9);
}

std::optional<Buffer> Host::next(std::int64_t now_ns) {
  wake_ns_ = kNoDeadline;
  if (session_) {
    if (auto frame = next_command(now_ns)) return frame;
  }
  if (hello_) {
    if (auto frame = next_hello(now_ns)) return frame;
  }
  if (!session_) return std::nullopt;
  if (byes_ > 0) {
    if (now_ns < bye_due_ns_) {
      wake(bye_due_ns_);
    } else if (passes(now_ns, 0, true)) {
      --byes_;
      bye_due_ns_ = now_ns + kBetweenByes_ns;
      return counted(session_->frame(FrameType::bye, {}));
    }
    return std::nullopt;
  }
  if (byes_ == 0) return std::nullopt;
  if (now_ns >= ping_due_ns_) {
    if (!passes(now_ns, 4)) return std::nullopt;
    ping_due_ns_ = now_ns + kSecond_ns;
    FieldWriter out;
    out.put(milliseconds(now_ns));
    return counted(session_->frame(FrameType::ping, std::move(out).take()));
  }
  wake(ping_due_ns_);
  return next_of_stream(now_ns, *session_);
}

std::optional<Buffer> Host::next_command(std::int64_t now_ns) {
  if (!pending_ || now_ns >= pending_->until_ns) return std::nullopt;
  if (now_ns < pending_->due_ns) {
    wake(pending_->due_ns);
    return std::nullopt;
  }
  const Buffer payload = encode_command(pending_->command);
  if (!passes(now_ns, payload.size(), true)) return std::nullopt;
  pending_->due_ns = now_ns + again_ns();
  return counted(session_->frame(FrameType::command, payload));
}

std::optional<Buffer> Host::next_hello(std::int64_t now_ns) {
  if (now_ns < hello_due_ns_) {
    wake(hello_due_ns_);
    return std::nullopt;
  }
  if (!passes(now_ns, sizeof(Nonce))) return std::nullopt;
  hello_due_ns_ = now_ns + kSecond_ns;
  return counted(
      make_frame({FrameType::hello, false, 0, ++outside_counter_}, *hello_, outside_, Direction::to_vehicle));
}

}  // namespace navcal::link
