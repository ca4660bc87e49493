// SPDX-License-Identifier: Apache-2.0
#include "link/vehicle.h"

#include <algorithm>
#include <cmath>

#include "link/fields.h"

namespace navcal::link {
namespace {

constexpr std::int64_t kBetweenRefusals_ns = 500'000'000;

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(std::llround(seconds * 1e9)); }

}  // namespace

void Vehicle::take_frame(std::int64_t now_ns, const FrameView& view) {
  switch (view.header.type) {
    case FrameType::hello: return take_hello(now_ns, view);
    case FrameType::bye:
    case FrameType::ping:
    case FrameType::command:
    case FrameType::segment:
    case FrameType::ack: break;
    default: return;  // an echo of this end's own frames
  }
  Session* const session = admit(now_ns, view);
  if (session == nullptr) return;
  if (!session->arrivals.take(view.header.counter)) {
    ++counters_.repeated;
    return;
  }
  ++counters_.frames;
  if (session == pending_.get()) activate();
  heard_ns_ = now_ns;
  if (peer_ == Peer::dead) events_.push_back({Event::Kind::returned, sessions_});
  peer_ = Peer::alive;
  take_from_operator(now_ns, view);
}

void Vehicle::take_hello(std::int64_t now_ns, const FrameView& view) {
  if (outside_) {
    if (!view.header.is_tagged) return refuse(now_ns, view, Refusal::untagged);
    if (!outside_->verifies(Direction::to_vehicle, view.covered, view.tag))
      return refuse(now_ns, view, Refusal::bad_tag);
  } else if (view.header.is_tagged) {
    return refuse(now_ns, view, Refusal::no_key);
  }
  Nonce host{};
  if (view.payload.size() != host.size()) return;
  std::ranges::copy(view.payload, host.begin());
  ++counters_.frames;
  if (active_ && active_->host == host) {
    welcome_ = active_.get();
    return;
  }
  // Whoever says hello has not proved anything yet, as an old hello can be sent again. So a session that stands
  // goes on until a frame of the new one has come, whose tag needs this end's new random number.
  if (!pending_ || pending_->host != host) pending_ = new_session(host);
  welcome_ = pending_.get();
}

std::unique_ptr<Session> Vehicle::new_session(const Nonce& host) const {
  const Nonce nonce = options_.nonce();
  auto id = static_cast<std::uint16_t>(nonce[0] << 8 | nonce[1]);
  while (id == 0 || (active_ && active_->id == id)) ++id;
  return std::make_unique<Session>(id, nonce, host, options_.key, Direction::to_operator);
}

Session* Vehicle::admit(std::int64_t now_ns, const FrameView& view) {
  Refusal why = Refusal::unknown_session;
  for (Session* const session : {active_.get(), pending_.get()}) {
    if (session == nullptr || session->id != view.header.session) continue;
    why = session->check(view);
    if (why == Refusal::none) return session;
  }
  if (options_.key && !view.header.is_tagged) why = Refusal::untagged;
  refuse(now_ns, view, why);
  return nullptr;
}

void Vehicle::refuse(std::int64_t now_ns, const FrameView& view, Refusal why) {
  ++counters_.refused;
  if (now_ns < refusal_allowed_ns_) return;
  refusal_allowed_ns_ = now_ns + kBetweenRefusals_ns;
  refusal_ = RefusalDue{why, view.header.session};
}

void Vehicle::activate() {
  if (active_) events_.push_back({Event::Kind::left, sessions_});
  end_session();
  active_ = std::move(pending_);
  events_.push_back({Event::Kind::came, ++sessions_});
  peer_ = Peer::alive;
}

void Vehicle::end_session() {
  if (welcome_ == active_.get()) welcome_ = nullptr;
  active_.reset();
  command_.reset();
  last_command_.reset();
  last_answer_.reset();
  answer_due_ = false;
  pong_.reset();
  peer_ = Peer::none;
}

void Vehicle::take_from_operator(std::int64_t now_ns, const FrameView& view) {
  switch (view.header.type) {
    case FrameType::bye: events_.push_back({Event::Kind::left, sessions_}); return end_session();
    case FrameType::ping: pong_ = Buffer(view.payload.begin(), view.payload.end()); return;
    case FrameType::command: return take_command_frame(view.payload);
    case FrameType::segment:
    case FrameType::ack: return take_of_stream(now_ns, view, *active_);
    default: return;
  }
}

void Vehicle::take_command_frame(Bytes payload) {
  const auto command = decode_command(payload);
  if (!command) return;
  const auto ahead = last_command_ ? static_cast<std::int16_t>(command->number - *last_command_) : std::int16_t{1};
  if (ahead < 0) return;  // a newer one has come
  if (ahead == 0) {
    answer_due_ = last_answer_.has_value();
    return;
  }
  last_command_ = command->number;
  last_answer_.reset();
  answer_due_ = false;
  command_ = command;
}

void Vehicle::answer(const CommandAnswer& answer) {
  if (last_command_ != answer.number) return;
  last_answer_ = answer;
  answer_due_ = true;
}

std::optional<std::string> Vehicle::take_request() {
  if (!active_ || active_->sender.queued_bytes() > kWaitingAnswers) return std::nullopt;
  return active_->receiver.pop();
}

bool Vehicle::respond(std::string_view response) { return !active_ || active_->sender.push(response); }

void Vehicle::advance(std::int64_t now_ns) {
  if (peer_ != Peer::alive || now_ns - heard_ns_ < nanoseconds(options_.dead_s)) return;
  peer_ = Peer::dead;
  events_.push_back({Event::Kind::silent, sessions_});
}

void Vehicle::report(std::int64_t now_ns, Buffer payload) {
  report_ = std::move(payload);
  // Without a drift; after a pause the rhythm begins anew.
  report_due_ns_ = now_ns - report_due_ns_ < kReport_ns ? report_due_ns_ + kReport_ns : now_ns + kReport_ns;
}

Buffer Vehicle::welcome(const Session& session) const {
  FieldWriter out;
  out.put_bytes(session.vehicle);
  out.put_bytes(session.host);
  const auto key =
      options_.key ? std::optional(options_.key->session(session.vehicle, session.host)) : std::nullopt;
  return make_frame({FrameType::welcome, false, session.id, 0}, std::move(out).take(), key,
                    Direction::to_operator);
}

std::optional<Buffer> Vehicle::next(std::int64_t now_ns) {
  wake_ns_ = report_due_ns_;
  if (peer_ == Peer::alive) wake(heard_ns_ + nanoseconds(options_.dead_s));
  if (active_ && answer_due_) {
    const Buffer payload = encode_answer(*last_answer_);
    if (!passes(now_ns, payload.size(), true)) return std::nullopt;
    answer_due_ = false;
    return counted(active_->frame(FrameType::answer, payload));
  }
  if (welcome_ != nullptr) {
    if (!passes(now_ns, 2 * sizeof(Nonce))) return std::nullopt;
    return counted(welcome(*std::exchange(welcome_, nullptr)));
  }
  if (refusal_) {
    if (!allows(now_ns, frame_length(1, false), false)) return std::nullopt;
    const Buffer payload{static_cast<std::uint8_t>(refusal_->why)};
    const Header header{FrameType::refusal, false, refusal_->session, ++outside_counter_};
    refusal_.reset();
    return counted(make_frame(header, payload, std::nullopt, Direction::to_operator));
  }
  return next_of_session(now_ns);
}

std::optional<Buffer> Vehicle::next_of_session(std::int64_t now_ns) {
  if (active_ && pong_) {
    if (!passes(now_ns, pong_->size() + 1)) return std::nullopt;
    Buffer payload = *std::exchange(pong_, std::nullopt);
    payload.push_back(static_cast<std::uint8_t>(std::lround(100 * loss())));
    return counted(active_->frame(FrameType::pong, payload));
  }
  if (report_) {
    if (!allows(now_ns, frame_length(report_->size(), active_ && options_.key), false)) return std::nullopt;
    const Buffer payload = *std::exchange(report_, std::nullopt);
    // Without an operator the reports go to whoever listens.
    if (!active_)
      return counted(make_frame({FrameType::report, false, 0, ++outside_counter_}, payload, std::nullopt,
                                Direction::to_operator));
    return counted(active_->frame(FrameType::report, payload));
  }
  // Answers wait while nobody hears them.
  return active_ ? next_of_stream(now_ns, *active_, peer_ != Peer::dead) : std::nullopt;
}

}  // namespace navcal::link
